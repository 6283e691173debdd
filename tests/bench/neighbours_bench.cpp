#include <benchmark/benchmark.h>

#include "bench/drying_layer.h"
#include "neighbours/pair_search.h"

namespace {
using namespace pigment;

void find_pairs(benchmark::State& state) {
  const Layer& layer = bench::drying_layer(static_cast<int>(state.range(0)));
  std::size_t pairs = 0;
  for (auto _ : state)
    pairs = neighbours::find_pairs(layer.cell, layer.position, layer.particles.radius, {1, 0.2, 0.05}).size();
  state.counters["pairs"] = static_cast<double>(pairs);
}
BENCHMARK(find_pairs)->ArgName("thousands")->Arg(1)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace
