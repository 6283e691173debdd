#include <benchmark/benchmark.h>

#include "bench/drying_layer.h"

namespace {
using namespace pigment;

void pack_layer(benchmark::State& state) {
  const packing::Recipe recipe = bench::drying_recipe(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(packing::pack_layer(recipe).layer.position.data());
}
BENCHMARK(pack_layer)->ArgName("thousands")->Arg(1)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace
