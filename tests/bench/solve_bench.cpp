// Assembly, matrix-vector product and solve of the resistance of a wide mixture, without walls; arguments: particles, vol%, and
// threads where they are compared. ns_per_pair counts the pairs that resist.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <Eigen/SparseCholesky>
#include <memory>

#include "assembly/step_assembly.h"
#include "base/random.h"
#include "bench/assembled_product.h"
#include "bench/wide_mixture.h"
#include "solve/block_cholesky.h"
#include "solve/conjugate_gradients.h"
#include "solve/pair_product.h"

namespace {
using namespace pigment;

struct Case {
  assembly::Interactions interactions;
  neighbours::NeighbourList list;
  std::unique_ptr<assembly::StepAssembly> step;
  solve::PairSystem system;
  Vec3Array force;
  std::size_t pairs = 0;

  void begin(const Vec3Array& position) {
    const Liquid liquid = liquid_at(interactions.liquid, 298.15);
    step->begin(position, {}, liquid, 1e-2, assembly::Treatment::Explicit, force, std::vector<double>(position.size(), 0.0));
  }
};

Case& resistance_of(int particles, int percent) {
  static std::map<std::pair<int, int>, std::unique_ptr<Case>> cases;
  auto& slot = cases[{particles, percent}];
  if (slot) return *slot;
  slot = std::make_unique<Case>();
  Case& c = *slot;
  const Layer& layer = bench::wide_mixture(particles, percent);
  c.interactions.surface_potential = {0};
  neighbours::PairRange range = assembly::pair_range(c.interactions, liquid_at(c.interactions.liquid, 298.15));
  range.skin = 0.05;
  c.list = neighbours::make_neighbour_list(layer.cell, layer.position, layer.particles.radius, range);
  c.step = std::make_unique<assembly::StepAssembly>(c.interactions, layer.particles, layer.cell, c.list);
  // Forces in random directions, as large as the drag at 1 um/ms.
  for (std::size_t k = 0; k < layer.position.size(); ++k) {
    const auto u = random_uniforms({1, Stream::BrownianForce}, 0, k);
    c.force.push_back(20 * layer.particles.radius[k] * (Vec3(u[0], u[1], u[2]) - Vec3::Constant(0.5)));
  }
  c.begin(layer.position);
  c.step->build(c.system);
  for (const auto& chunk : c.system.full) c.pairs += chunk.size();
  for (const auto& chunk : c.system.squeeze) c.pairs += chunk.size();
  return c;
}

void per_pair(benchmark::State& state, const Case& c, double products = 1) {
  state.counters["ns_per_pair"] = benchmark::Counter(1e-9 * products * static_cast<double>(c.pairs),
                                                     benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["pairs"] = static_cast<double>(c.pairs);
}

void assembly_of_a_step(benchmark::State& state) {
  Case& c = resistance_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const Layer& layer = bench::wide_mixture(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) {
    c.begin(layer.position);
    c.step->build(c.system);
  }
  per_pair(state, c);
}

// The product as the solver runs it, five scalars a pair. In cache: the first chunk over and over, which says what arithmetic
// alone allows.
void product(benchmark::State& state) {
  Case& c = resistance_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  omp_set_num_threads(static_cast<int>(state.range(2)));
  const solve::PairTopology& t = *c.system.topology;
  std::vector<double> x(solve::input_size<6>(t), 1.0), y(solve::output_size<6>(t));
  solve::MeanFlowSums sums(c.system.mean_flow, t.chunks().count());
  for (auto _ : state) {
#pragma omp parallel
    {
#pragma omp for schedule(static)
      for (int k = 0; k < t.chunks().count(); ++k) solve::apply_chunk<6>(c.system, k, x.data(), y.data(), sums);
#pragma omp for schedule(static)
      for (int k = 0; k < t.chunks().count(); ++k) benchmark::DoNotOptimize(solve::finish_chunk<6>(c.system, k, false, x.data(), y.data(), sums));
    }
    benchmark::ClobberMemory();
  }
  per_pair(state, c);
  std::size_t bytes = 0;
  for (const auto& chunk : c.system.full) bytes += chunk.blocks().size() * sizeof(solve::FullBlock);
  for (const auto& chunk : c.system.squeeze) bytes += chunk.blocks().size() * sizeof(solve::SqueezeBlock);
  bytes += t.particles() * (sizeof(solve::ParticleTerm) + 3 * 8 * sizeof(double)) + t.halo_count() * 2 * 8 * sizeof(double);
  state.counters["bytes"] = benchmark::Counter(static_cast<double>(bytes), benchmark::Counter::kIsIterationInvariantRate, benchmark::Counter::kIs1000);
  omp_set_num_threads(omp_get_num_procs());
}
void product_in_cache(benchmark::State& state) {
  Case& c = resistance_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const solve::PairTopology& t = *c.system.topology;
  std::vector<double> x(solve::input_size<6>(t), 1.0), y(solve::output_size<6>(t));
  solve::MeanFlowSums sums(c.system.mean_flow, t.chunks().count());
  for (auto _ : state) {
    solve::apply_chunk<6>(c.system, 0, x.data(), y.data(), sums);
    benchmark::DoNotOptimize(solve::finish_chunk<6>(c.system, 0, false, x.data(), y.data(), sums));
    benchmark::ClobberMemory();
  }
  const double pairs = static_cast<double>(c.system.full[0].size() + c.system.squeeze[0].size());
  state.counters["ns_per_pair"] = benchmark::Counter(1e-9 * pairs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
// The same matrix as 6 x 6 blocks.
void assembled_product(benchmark::State& state) {
  Case& c = resistance_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  omp_set_num_threads(static_cast<int>(state.range(2)));
  const bench::AssembledSystem matrix(c.system);
  const std::size_t size = solve::output_size<6>(*c.system.topology);
  std::vector<double> x(size, 1.0), y(size);
  for (auto _ : state) {
    matrix.apply(x.data(), y.data());
    benchmark::ClobberMemory();
  }
  per_pair(state, c);
  omp_set_num_threads(omp_get_num_procs());
}
// a = b + s c over arrays far larger than any cache: what the memory brings.
void memory_bandwidth(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(0)));
  const std::size_t n = 20'000'000;
  std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  for (auto _ : state) {
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < n; ++k) a[k] = b[k] + 3 * c[k];
    benchmark::ClobberMemory();
  }
  state.counters["bytes"] = benchmark::Counter(3.0 * 8 * n, benchmark::Counter::kIsIterationInvariantRate, benchmark::Counter::kIs1000);
  omp_set_num_threads(omp_get_num_procs());
}

// The argument is the tolerance's exponent.
void solve_cold(benchmark::State& state) {
  Case& c = resistance_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  solve::SolveReport report;
  for (auto _ : state) {
    std::vector<double> x;
    report = solve::conjugate_gradients(c.system, x, {std::pow(10.0, -static_cast<double>(state.range(2))), 5000});
  }
  state.counters["iterations"] = report.iterations;
}
// From the solution of a system whose forces were a hundredth different.
void solve_warm(benchmark::State& state) {
  Case& c = resistance_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  solve::PairSystem before = c.system;
  for (std::size_t q = 0; q < before.right_hand_side.size(); ++q) before.right_hand_side[q] *= q % 2 ? 1.01 : 0.99;
  std::vector<double> start;
  solve::conjugate_gradients(before, start, {1e-8, 5000});
  solve::SolveReport report;
  for (auto _ : state) {
    std::vector<double> x = start;
    report = solve::conjugate_gradients(c.system, x, {std::pow(10.0, -static_cast<double>(state.range(2))), 5000});
  }
  state.counters["iterations"] = report.iterations;
}

// What the preconditioner of bonded layers factorises: each particle's drag and the squeeze of the pairs whose is larger, by our factor and by
// Eigen's on the same matrix (its own order of least fill).
struct Network {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  std::vector<double> diagonal, between;  // 9 numbers a particle, a pair
};
Network network_of(const Case& c) {
  Network n;
  n.diagonal.assign(9 * c.force.size(), 0.0);
  for (std::size_t k = 0; k < c.force.size(); ++k)
    for (int d = 0; d < 3; ++d) n.diagonal[9 * k + 4 * d] = c.system.particle[k].across;
  for (const auto& chunk : c.system.full)
    for (const auto& p : chunk) {
      if (p.squeeze < std::min(c.system.particle[p.i].across, c.system.particle[p.j].across)) continue;
      n.pairs.emplace_back(p.i, p.j);
      for (int r = 0; r < 3; ++r)
        for (int s = 0; s < 3; ++s) {
          const double value = p.squeeze * p.n[r] * p.n[s];
          n.diagonal[9 * static_cast<std::size_t>(p.i) + 3 * r + s] += value;
          n.diagonal[9 * static_cast<std::size_t>(p.j) + 3 * r + s] += value;
          n.between.push_back(-value);
        }
    }
  return n;
}
// The diagonal by place in the factor's order.
std::vector<double> analyzed(const Network& n, solve::BlockCholesky& factor) {
  factor.analyze(static_cast<int>(n.diagonal.size() / 9), n.pairs);
  std::vector<double> diagonal(n.diagonal.size());
  for (std::size_t k = 0; k < factor.place().size(); ++k) std::copy_n(&n.diagonal[9 * k], 9, &diagonal[9 * static_cast<std::size_t>(factor.place()[k])]);
  return diagonal;
}
void network_factor(benchmark::State& state) {
  const Case& c = resistance_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  omp_set_num_threads(static_cast<int>(state.range(2)));
  const Network n = network_of(c);
  solve::BlockCholesky factor;
  const std::vector<double> diagonal = analyzed(n, factor);
  for (auto _ : state)
    if (!factor.factorize(diagonal, n.between)) state.SkipWithError("not positive definite");
  state.counters["pairs"] = static_cast<double>(n.pairs.size());
  omp_set_num_threads(omp_get_num_procs());
}
// What one iteration pays for the factor.
void network_solve(benchmark::State& state) {
  const Case& c = resistance_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  omp_set_num_threads(static_cast<int>(state.range(2)));
  const Network n = network_of(c);
  solve::BlockCholesky factor;
  const std::vector<double> diagonal = analyzed(n, factor);
  if (!factor.factorize(diagonal, n.between)) state.SkipWithError("not positive definite");
  const std::vector<double> b(3 * c.force.size(), 1.0);
  std::vector<double> x;
  for (auto _ : state) {
    x = b;
#pragma omp parallel
    factor.solve(x.data());
  }
  state.counters["bytes_of_factor"] = static_cast<double>(factor.bytes());
  omp_set_num_threads(omp_get_num_procs());
}
void network_factor_by_eigen(benchmark::State& state) {
  const Case& c = resistance_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const Network n = network_of(c);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t q = 0; q < n.diagonal.size(); ++q) entries.emplace_back(q / 9 * 3 + q % 9 / 3, q / 9 * 3 + q % 3, n.diagonal[q]);
  for (std::size_t q = 0; q < n.between.size(); ++q) {
    const int row = 3 * n.pairs[q / 9].second + static_cast<int>(q % 9 / 3), column = 3 * n.pairs[q / 9].first + static_cast<int>(q % 3);
    entries.emplace_back(row, column, n.between[q]);
    entries.emplace_back(column, row, n.between[q]);
  }
  const auto size = static_cast<Eigen::Index>(n.diagonal.size() / 3);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor;
  factor.analyzePattern(matrix);
  for (auto _ : state) factor.factorize(matrix);
}

void sizes(benchmark::internal::Benchmark* b) {
  for (int particles : {1000, 10000, 100000})
    for (int percent : {41, 60}) b->Args({particles, percent});
}
template <int First, int Second>
void sizes_and(benchmark::internal::Benchmark* b) {
  for (int particles : {1000, 10000, 100000})
    for (int percent : {41, 60})
      for (int third : {First, Second}) b->Args({particles, percent, third});
}
BENCHMARK(memory_bandwidth)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(assembly_of_a_step)->ArgNames({"particles", "vol%"})->Apply(sizes)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(product)->ArgNames({"particles", "vol%", "threads"})->Apply(sizes_and<1, 2>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(product_in_cache)->ArgNames({"particles", "vol%"})->Args({10000, 41})->Args({10000, 60})->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK(assembled_product)->ArgNames({"particles", "vol%", "threads"})->Apply(sizes_and<1, 2>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(network_factor)->ArgNames({"particles", "vol%", "threads"})->Args({10000, 60, 1})->Args({10000, 60, 2})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(network_solve)->ArgNames({"particles", "vol%", "threads"})->Args({10000, 60, 1})->Args({10000, 60, 2})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(network_factor_by_eigen)->ArgNames({"particles", "vol%"})->Args({10000, 60})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(solve_cold)->ArgNames({"particles", "vol%", "digits"})->Apply(sizes_and<3, 6>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(solve_warm)->ArgNames({"particles", "vol%", "digits"})->Apply(sizes_and<3, 6>)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
