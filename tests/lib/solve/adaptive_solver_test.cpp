#include "solve/adaptive_solver.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>

using namespace pigment::solve;

namespace {

// A long chain of spheres, each bound stiffly to the next two and hardly to the liquid: block Jacobi passes a message from end
// to end by two particles an iteration.
struct Chain {
  PairTopology topology;
  PairSystem system;
  std::vector<double> exact;
};

void make(Chain& chain, int n, bool rotation, double drag, unsigned seed, double stiffness = 1) {
  std::vector<std::int32_t> i, j;
  for (int k = 0; k < n; ++k)
    for (int step : {1, 2})
      if (k + step < n) {
        i.push_back(k);
        j.push_back(k + step);
      }
  chain.topology = PairTopology(n, i, j);
  PairSystem& s = chain.system;
  s.rotation = rotation;
  s.topology = &chain.topology;
  s.particle.assign(n, {drag, drag, 0, drag, drag});
  const int chunks = chain.topology.chunks().count();
  s.full.resize(chunks);
  s.squeeze.resize(chunks);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (int c = 0; c < chunks; ++c)
    for (std::size_t p = chain.topology.pair_begin(c); p < chain.topology.pair_begin(c + 1); ++p) {
      double d[3] = {normal(random), normal(random), normal(random)};
      const double r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      for (double& x : d) x /= r;
      if (rotation)
        s.full[c].push_back({i[p], j[p], chain.topology.target(p), {d[0], d[1], d[2]}, 0.4, 0.6, stiffness, 0.2 * stiffness,
                             0.5 * stiffness, 0.1 * stiffness, 0.3 * stiffness});
      else
        s.squeeze[c].push_back({i[p], j[p], chain.topology.target(p), {d[0], d[1], d[2]}, stiffness});
    }
  // The right-hand side of a solution that is known: smooth along the chain, so that block Jacobi has the most to do.
  const int D = s.unknowns_per_particle();
  chain.exact.resize(static_cast<std::size_t>(n) * D);
  for (std::size_t q = 0; q < chain.exact.size(); ++q) chain.exact[q] = std::cos(2e-3 * static_cast<double>(q)) + 0.1 * normal(random);
  apply(s, chain.exact, s.right_hand_side);
}

// Ties some particles to the rest frame, as contacts with a tilted wall do.
void tie(Chain& chain, double stiffness) {
  PairSystem& s = chain.system;
  s.own.resize(chain.topology.chunks().count());
  for (int c = 0; c < chain.topology.chunks().count(); ++c)
    for (int k = chain.topology.chunks().begin[c]; k < chain.topology.chunks().begin[c + 1]; k += 97) {
      OwnBlock block{k, {}};
      for (int r = 0; r < 6; ++r) block.entry[r * (r + 1) / 2 + r] = stiffness * (1 + r);
      block.entry[1] = 0.5 * stiffness;
      s.own[c].push_back(block);
    }
}

double error(const std::vector<double>& x, const std::vector<double>& exact) {
  double sum = 0, norm = 0;
  for (std::size_t q = 0; q < x.size(); ++q) {
    sum += (x[q] - exact[q]) * (x[q] - exact[q]);
    norm += exact[q] * exact[q];
  }
  return std::sqrt(sum / norm);
}

const ConjugateGradientOptions options{1e-10, 20000};

}  // namespace

TEST(AdaptiveSolver, SolvesExactlyWhereBlockJacobiIsTooSlow) {
  for (bool rotation : {false, true}) {
    Chain chain;
    make(chain, 2000, rotation, 1e-5, 1);
    std::vector<double> x;
    ASSERT_FALSE(conjugate_gradients(chain.system, x, {1e-10, 300}).converged) << "the example is too easy";
    x.clear();
    AdaptiveSolver solver;
    const SolveReport report = solver.solve(chain.system, x, options);
    EXPECT_TRUE(report.converged);
    EXPECT_FALSE(solver.packed_factor().empty());
    // Condition 1e6 times a residual of 1e-10 relative, at worst.
    EXPECT_LT(error(x, chain.exact), 1e-5);
    // The next system is much the same: the kept factor makes it quick, and is kept.
    Chain next;
    make(next, 2000, rotation, 1.001e-5, 1, 1.01);
    next.system.topology = &chain.topology;
    const long revision = solver.revision();
    x.clear();
    const SolveReport again = solver.solve(next.system, x, options);
    EXPECT_TRUE(again.converged);
    EXPECT_LT(again.iterations, 15);
    EXPECT_EQ(solver.revision(), revision);
    EXPECT_LT(error(x, next.exact), 1e-5);
  }
}

TEST(AdaptiveSolver, TakesNoFactorWhereBlockJacobiIsQuick) {
  Chain chain;
  make(chain, 500, true, 1, 2);
  std::vector<double> x;
  AdaptiveSolver solver;
  EXPECT_TRUE(solver.solve(chain.system, x, options).converged);
  EXPECT_LT(error(x, chain.exact), 1e-8);
  EXPECT_TRUE(solver.packed_factor().empty());
}

// A solver that got the factor's matrix from another one goes on with the same bytes, at any number of threads.
TEST(AdaptiveSolver, RestoredFactorGivesTheSameBytes) {
  Chain first, second, third;
  make(first, 900, true, 1e-5, 3);
  make(second, 900, true, 1.2e-5, 3, 1.1);
  make(third, 900, true, 1e-4, 3, 30);  // far enough for a new factor
  tie(first, 1e-4);
  tie(second, 1.2e-4);
  tie(third, 1e-4);
  AdaptiveSolver solver;
  std::vector<double> x;
  solver.solve(first.system, x, options);
  ASSERT_FALSE(solver.packed_factor().empty());
  const std::vector<std::int64_t> packed = solver.packed_factor();
  const std::vector<double> guess;  // zero
  std::vector<double> second_x = guess, third_x = guess;
  solver.solve(second.system, second_x, options);
  solver.solve(third.system, third_x, options);
  for (int threads : {1, 2}) {
    omp_set_num_threads(threads);
    AdaptiveSolver other;
    other.restore_factor(packed, second.topology);
    EXPECT_EQ(other.packed_factor(), packed);
    std::vector<double> y = guess, z = guess;
    other.solve(second.system, y, options);
    EXPECT_EQ(y, second_x);
    other.solve(third.system, z, options);
    EXPECT_EQ(z, third_x);
    EXPECT_EQ(other.packed_factor(), solver.packed_factor());
  }
  // Without it the bytes are others: the factor is part of a run's state.
  AdaptiveSolver fresh;
  std::vector<double> y = guess;
  fresh.solve(second.system, y, options);
  EXPECT_NE(y, second_x);
}

TEST(AdaptiveSolver, ForgetsItsFactor) {
  Chain chain;
  make(chain, 2000, false, 1e-5, 1);
  AdaptiveSolver solver;
  std::vector<double> x;
  solver.solve(chain.system, x, options);
  const long revision = solver.revision();
  solver.forget_factor();
  EXPECT_TRUE(solver.packed_factor().empty());
  EXPECT_NE(solver.revision(), revision);
  solver.restore_factor({}, chain.topology);
  EXPECT_TRUE(solver.packed_factor().empty());
}
