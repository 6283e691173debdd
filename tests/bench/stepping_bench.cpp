#include <benchmark/benchmark.h>

#include "bench/drying_layer.h"
#include "dewatering/profile.h"
#include "scene/problem.h"
#include "stepping/stepper.h"

namespace {
using namespace pigment;

// The first steps of the drying study, at the step that the controller takes.
void advance(benchmark::State& state) {
  const int thousands = static_cast<int>(state.range(0));
  config::Document document = bench::drying_scene(thousands);
  const scene::Scene scene = scene::read_scene(document);
  const Layer& layer = bench::drying_layer(thousands);
  io::write_packing("bench_packing.h5", layer, {"pigment"}, {}, {});
  stepping::Problem problem = scene::problem_of(scene, io::ParticleFile("bench_packing.h5"));
  problem.dewatering = dewatering::make_profile(*scene.dewatering, scene::coating_of(scene)).curve;
  stepping::RunState run = stepping::initial_state(problem, layer.position);
  stepping::Stepper stepper(problem, run);
  double iterations = 0, time = 0;
  for (auto _ : state) {
    const stepping::StepReport report = stepper.advance(run, 5);
    iterations += report.iterations;
    time += report.step;
  }
  state.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
  state.counters["step_ms"] = benchmark::Counter(time, benchmark::Counter::kAvgIterations);
}
BENCHMARK(advance)->ArgName("thousands")->Arg(1)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace
