// One step's linear system from the positions of a packing, assembled and solved from rest to 1e-3: what a peer's implicit
// lubrication does twice a step. PIGMENT_PACKING names the file; workflows/peers/compare.sh runs both on it.
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "assembly/step_assembly.h"
#include "base/random.h"
#include "io/particle_file.h"
#include "solve/conjugate_gradients.h"

namespace {
using namespace pigment;

void assemble_and_solve(benchmark::State& state) {
  const char* path = std::getenv("PIGMENT_PACKING");
  if (!path) {
    state.SkipWithError("PIGMENT_PACKING names no file; make bench-peers sets it");
    return;
  }
  const Layer layer = io::ParticleFile(path).layer(0);
  assembly::Interactions interactions;
  interactions.surface_potential.assign(16, 0);
  const Liquid liquid = liquid_at(interactions.liquid, 298.15);
  const auto list = neighbours::make_neighbour_list(layer.cell, layer.position, layer.particles.radius, assembly::pair_range(interactions, liquid));
  Particles particles = layer.particles;
  particles.mass.assign(particles.size(), 1e-3);
  assembly::StepAssembly step(interactions, particles, layer.cell, list);
  Vec3Array force;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const auto u = random_uniforms({1, Stream::BrownianForce}, 0, k);
    force.push_back(20 * particles.radius[k] * (Vec3(u[0], u[1], u[2]) - Vec3::Constant(0.5)));
  }
  solve::PairSystem system;
  solve::SolveReport report;
  for (auto _ : state) {
    step.begin(layer.position, {}, liquid, 1e-2, assembly::Treatment::Explicit, force, std::vector<double>(particles.size(), 0.0));
    step.build(system);
    std::vector<double> x;
    report = solve::conjugate_gradients(system, x, {1e-3, 5000});
  }
  state.counters["iterations"] = report.iterations;
  state.counters["particles"] = static_cast<double>(particles.size());
}
BENCHMARK(assemble_and_solve)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
