#include "solve/adaptive_solver.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>
#include <utility>

using namespace pigment::solve;

namespace {

// A long chain of spheres, each bound stiffly to the next two and hardly to the liquid, shear of the order of the drag as lubrication has it:
// block Jacobi passes a message from end to end by two particles an iteration.
struct Chain {
  PairTopology topology;
  PairSystem system;
  std::vector<double> exact;
};

void make_of(Chain& chain, int n, const std::vector<std::int32_t>& i, const std::vector<std::int32_t>& j, bool rotation, double drag, unsigned seed,
             double stiffness) {
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
        s.full[c].push_back({i[p], j[p], chain.topology.target(p), {d[0], d[1], d[2]}, 0.4, 0.6, stiffness, drag,
                             2.5 * drag, 0.5 * drag, 1.5 * drag});
      else
        s.squeeze[c].push_back({i[p], j[p], chain.topology.target(p), {d[0], d[1], d[2]}, stiffness});
    }
  // The right-hand side of a solution that is known: smooth along the chain, so that block Jacobi has the most to do.
  const int D = s.unknowns_per_particle();
  chain.exact.resize(static_cast<std::size_t>(n) * D);
  for (std::size_t q = 0; q < chain.exact.size(); ++q) chain.exact[q] = std::cos(2e-3 * static_cast<double>(q)) + 0.1 * normal(random);
  apply(s, chain.exact, s.right_hand_side);
}

void make(Chain& chain, int n, bool rotation, double drag, unsigned seed, double stiffness = 1) {
  std::vector<std::int32_t> i, j;
  for (int k = 0; k < n; ++k)
    for (int step : {1, 2})
      if (k + step < n) {
        i.push_back(k);
        j.push_back(k + step);
      }
  make_of(chain, n, i, j, rotation, drag, seed, stiffness);
}

// A cube of so many particles an edge, each bound to those at its faces, edges and corners.
void make_jam(Chain& jam, int edge, double drag, double stiffness) {
  std::vector<std::int32_t> i, j;
  const auto inside = [edge](int c) { return c >= 0 && c < edge; };
  for (int k = 0; k < edge * edge * edge; ++k)
    for (int dz : {0, 1})
      for (int dy : {-1, 0, 1})
        for (int dx : {-1, 0, 1}) {
          const int x = k % edge + dx, y = k / edge % edge + dy, z = k / (edge * edge) + dz, other = x + edge * (y + edge * z);
          if (other <= k || !inside(x) || !inside(y) || !inside(z)) continue;
          i.push_back(k);
          j.push_back(other);
        }
  make_of(jam, edge * edge * edge, i, j, true, drag, 5, stiffness);
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
    solver.begin_step({});
    const SolveReport report = solver.solve(chain.system, x, options);
    EXPECT_TRUE(report.converged);
    EXPECT_TRUE(solver.has_network());
    // Condition 1e6 times a residual of 1e-9 relative, at worst.
    EXPECT_LT(error(x, chain.exact), 1e-5);
    // The next system is much the same, and the network that there is serves it; pairs that are much stiffer get their own.
    for (const auto& [drag, stiffness] : {std::pair{1.001e-5, 1.01}, std::pair{1e-5, 30.0}}) {
      Chain next;
      make(next, 2000, rotation, drag, 1, stiffness);
      next.system.topology = &chain.topology;
      x.clear();
      const SolveReport again = solver.solve(next.system, x, options);
      EXPECT_TRUE(again.converged);
      EXPECT_LT(again.iterations, 60);  // block Jacobi did not do it in 300
      EXPECT_LT(error(x, next.exact), 1e-5);
    }
  }
}

// Pairs come and go between the solves of a step, where a law stiffens some only.
TEST(AdaptiveSolver, NetworkKnowsItsPairsWhenOthersComeAndGo) {
  Chain chain;
  make(chain, 2000, false, 1e-5, 4);
  StiffNetwork network;
  ASSERT_EQ(network.factorize(chain.system, 10), "");
  EXPECT_EQ(network.changed(chain.system, 3), 0);
  Chain fewer;
  make(fewer, 2000, false, 1e-5, 4);
  SqueezePairs without;
  without.restart(fewer.system.squeeze[0].size());
  std::size_t place = 0;
  for (const SqueezePair& p : fewer.system.squeeze[0])
    if (const std::size_t k = place++; k != 0 && k != 7) without.push_back(p);
  std::swap(fewer.system.squeeze[0], without);
  // Two stiff pairs are gone, which no solve sees but by its right-hand side; all others are as they were.
  EXPECT_EQ(network.changed(fewer.system, 3), 0);
  ASSERT_EQ(network.factorize(fewer.system, 10), "");
  apply(fewer.system, fewer.exact, fewer.system.right_hand_side);
  std::vector<double> x;
  EXPECT_LT(conjugate_gradients(fewer.system, x, options, &network).iterations, 10);  // the network is the whole matrix
  EXPECT_LT(error(x, fewer.exact), 1e-5);
  // Back again they are two that the factor lacks.
  EXPECT_EQ(network.changed(chain.system, 3), 2);
  ASSERT_EQ(network.factorize(chain.system, 10), "");
  x.clear();
  EXPECT_LT(conjugate_gradients(chain.system, x, options, &network).iterations, 40);
  EXPECT_LT(error(x, chain.exact), 1e-5);
}

TEST(AdaptiveSolver, TakesNoNetworkWhereBlockJacobiIsQuick) {
  Chain chain;
  make(chain, 500, true, 1, 2);
  std::vector<double> x;
  AdaptiveSolver solver;
  solver.begin_step({});
  EXPECT_TRUE(solver.solve(chain.system, x, options).converged);
  EXPECT_LT(error(x, chain.exact), 1e-8);
  EXPECT_FALSE(solver.has_network());
}

// Whether the solves that follow begin with networks of their own is a matter of what those cost.
TEST(AdaptiveSolver, OneSolveGoneAstrayMakesAChainStiffAndNoJam) {
  Chain chain, jam, easy;
  make(chain, 2000, true, 1e-5, 1);
  make_jam(jam, 12, 1e-4, 1);
  make_jam(easy, 12, 1, 12);
  easy.system.topology = &jam.topology;
  std::vector<double> x;
  AdaptiveSolver solver;
  solver.begin_step({});
  EXPECT_TRUE(solver.solve(chain.system, x, options).converged);
  EXPECT_TRUE(solver.memory().stiff);
  x.clear();
  solver.begin_step({});
  EXPECT_TRUE(solver.solve(jam.system, x, options).converged);
  EXPECT_TRUE(solver.has_network()) << "the example is too easy";
  EXPECT_FALSE(solver.memory().stiff);
  EXPECT_LT(error(x, jam.exact), 1e-5);
  x.clear();
  EXPECT_TRUE(solver.solve(easy.system, x, {1e-4, 20000}).converged);
  EXPECT_FALSE(solver.has_network()) << "it does not fit the easy one";
  EXPECT_LT(error(x, easy.exact), 1e-2);
  // Where block Jacobi fails again and again, though it has as long as a network takes, the network is what is left.
  Chain stiffer;
  make(stiffer, 2000, true, 1e-5, 1, 30);
  stiffer.system.topology = &chain.topology;
  x.clear();
  solver.begin_step({});
  EXPECT_TRUE(solver.solve(chain.system, x, options).converged);
  solver.begin_step({false, solver.memory().network_cost});
  x.clear();
  EXPECT_TRUE(solver.solve(chain.system, x, options).converged);
  EXPECT_FALSE(solver.memory().stiff);
  x.clear();
  EXPECT_TRUE(solver.solve(stiffer.system, x, options).converged);
  EXPECT_TRUE(solver.memory().stiff);
  // A layer that was stiff at the last step's end begins with a network, whatever it costs.
  x.clear();
  solver.begin_step({true});
  EXPECT_TRUE(solver.solve(jam.system, x, options).converged);
  EXPECT_TRUE(solver.memory().stiff);
}

// Block Jacobi goes on for as long as the last network took.
TEST(AdaptiveSolver, IsAsPatientAsANetworkCosts) {
  Chain jam;
  make_jam(jam, 12, 1e-4, 1);
  const int needed = [&] {
    std::vector<double> x;
    return conjugate_gradients(jam.system, x, options).iterations;
  }();
  ASSERT_GT(needed, 60) << "the example is too easy";
  for (const int cost : {0, needed - 1, needed + 1}) {
    AdaptiveSolver solver;
    std::vector<double> x;
    solver.begin_step({false, cost});
    EXPECT_TRUE(solver.solve(jam.system, x, options).converged);
    EXPECT_EQ(solver.has_network(), cost <= needed) << cost;
    if (solver.has_network()) {
      EXPECT_GT(solver.memory().network_cost, 0);
      EXPECT_NE(solver.memory().network_cost, cost);
    } else {
      EXPECT_EQ(solver.memory().network_cost, cost);
    }
  }
}

// What a solver did in steps before leaves no trace, nor does the number of threads: a resumed run has neither.
TEST(AdaptiveSolver, BeginsEveryStepAnew) {
  Chain first, second;
  make(first, 900, true, 1e-5, 3);
  make(second, 900, true, 1.2e-5, 3, 1.1);
  tie(first, 1e-4);
  tie(second, 1.2e-4);
  second.system.topology = &first.topology;
  std::vector<double> expected;
  for (int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    for (const bool before : {true, false}) {
      AdaptiveSolver solver;
      std::vector<double> x;
      if (before) {
        solver.begin_step({});
        solver.solve(first.system, x, options);
        ASSERT_TRUE(solver.has_network());
      }
      solver.begin_step({true});
      x.clear();
      EXPECT_TRUE(solver.solve(second.system, x, options).converged);
      EXPECT_TRUE(solver.has_network());
      if (expected.empty()) expected = x;
      EXPECT_EQ(x, expected);
    }
  }
}

// The surface takes hold of some particles and lets others go between the solves of a step, for all of which one network may serve.
TEST(AdaptiveSolver, ServesOtherHeldParticlesThanItsNetworkWasMadeWith) {
  Chain chain;
  make(chain, 900, true, 1e-5, 4);
  PairSystem& s = chain.system;
  s.held.assign(900, 0);
  s.held_velocity.assign(900, 0.0);
  const auto hold = [&](std::initializer_list<int> particles) {
    std::fill(s.held.begin(), s.held.end(), 0);
    for (int k : particles) {
      s.held[k] = 1;
      s.held_velocity[k] = 0.1 * (k % 7);
    }
  };
  AdaptiveSolver solver;
  solver.begin_step({true});
  std::vector<double> x;
  hold({7, 30, 400});
  ASSERT_TRUE(solver.solve(s, x, options).converged);
  hold({30, 500, 800});
  ASSERT_TRUE(solver.solve(s, x, options).converged);
  for (int k : {30, 500, 800}) EXPECT_EQ(x[k * 6 + 2], s.held_velocity[k]);
  // Every row but those of the held balances.
  std::vector<double> y;
  apply(s, x, y);
  double left = 0, norm = 0;
  for (std::size_t q = 0; q < y.size(); ++q) {
    norm += s.right_hand_side[q] * s.right_hand_side[q];
    if (q % 6 == 2 && s.held[q / 6]) continue;
    left += (s.right_hand_side[q] - y[q]) * (s.right_hand_side[q] - y[q]);
  }
  EXPECT_LT(std::sqrt(left / norm), 1e-6);
}
