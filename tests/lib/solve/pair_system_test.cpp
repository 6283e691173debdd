#include "solve/pair_system.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Dense>
#include <random>

#include "solve/conjugate_gradients.h"

using namespace pigment::solve;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

// A random system of n spheres strung along indices; positions only serve to check rigid motion.
struct Example {
  PairTopology topology;
  PairSystem system;
  std::vector<Vector3d> position;
};

// A random positive definite block, its lower triangle row by row.
OwnBlock own_block(int k, int D, unsigned seed) {
  std::srand(seed);
  const MatrixXd root = MatrixXd::Random(D, D), full = root * root.transpose();
  OwnBlock block{k, {}};
  for (int r = 0; r < D; ++r)
    for (int c = 0; c <= r; ++c) block.entry[r * (r + 1) / 2 + c] = full(r, c);
  return block;
}
MatrixXd full_matrix(const OwnBlock& block, int D) {
  MatrixXd m(D, D);
  for (int r = 0; r < D; ++r)
    for (int c = 0; c <= r; ++c) m(r, c) = m(c, r) = block.entry[r * (r + 1) / 2 + c];
  return m;
}

void make(Example& e, int n, bool rotation, unsigned seed, double drag) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.1, 1);
  std::vector<std::int32_t> pi, pj;
  for (int i = 0; i < n; ++i)
    for (int j : {i + 1, i + 2, i + 7, i + 40})
      if (j < n) {
        pi.push_back(i);
        pj.push_back(j);
      }
  for (int k = 0; k < n; ++k) e.position.emplace_back(normal(random) * 9, normal(random) * 9, normal(random) * 9);
  e.topology = PairTopology(n, pi, pj);
  e.system.rotation = rotation;
  e.system.topology = &e.topology;
  e.system.particle.assign(n, {drag, 1.2 * drag, 0.3 * drag, 0.9 * drag, 0.8 * drag});
  e.system.full.resize(e.topology.chunks().count());
  e.system.squeeze.resize(e.topology.chunks().count());
  e.system.own.resize(e.topology.chunks().count());
  for (int c = 0; c < e.topology.chunks().count(); ++c)
    for (int k = e.topology.chunks().begin[c]; k < e.topology.chunks().begin[c + 1]; ++k)
      if (k % 3 == 1) e.system.own[c].push_back(own_block(k, rotation ? 6 : 3, seed + k));
  for (int c = 0; c < e.topology.chunks().count(); ++c)
    for (std::size_t p = e.topology.pair_begin(c); p < e.topology.pair_begin(c + 1); ++p) {
      const Vector3d d = e.position[pj[p]] - e.position[pi[p]], n3 = d.normalized();
      const double split = uniform(random), a = uniform(random), cc = uniform(random), b = 0.9 * std::sqrt(a * cc) * (split - 0.5);
      if (p % 3 == 0) e.system.squeeze[c].push_back({pi[p], pj[p], e.topology.target(p), {n3[0], n3[1], n3[2]}, 5 * uniform(random)});
      else e.system.full[c].push_back({pi[p], pj[p], e.topology.target(p), {n3[0], n3[1], n3[2]}, split * d.norm(), (1 - split) * d.norm(),
                                       5 * uniform(random), uniform(random), a, b, cc});
    }
  const int D = e.system.unknowns_per_particle();
  for (int q = 0; q < n * D; ++q) e.system.right_hand_side.push_back(normal(random));
}

MatrixXd dense(const PairSystem& s, int n) {
  const int D = s.unknowns_per_particle();
  MatrixXd a(n * D, n * D);
  for (int q = 0; q < n * D; ++q) {
    std::vector<double> x(n * D, 0.0), y;
    x[q] = 1;
    apply(s, x, y);
    a.col(q) = Eigen::Map<VectorXd>(y.data(), n * D);
  }
  return a;
}

// The pair's matrix from its dissipation, with cross products as matrices: an assembly that shares nothing with the kernel.
MatrixXd skew(const Vector3d& v) {
  MatrixXd m(3, 3);
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}
MatrixXd pair_matrix(const FullPair& p) {
  const Vector3d n(p.n[0], p.n[1], p.n[2]);
  const MatrixXd I = MatrixXd::Identity(3, 3), P = I - n * n.transpose(), N = skew(n);
  MatrixXd V(3, 12), W(3, 12);
  // v = u_i - u_j + w_i x (l_i n) + w_j x (l_j n); a x n = -N a
  V << I, -p.l_i * N, -I, -p.l_j * N;
  W << 0 * I, I, 0 * I, -I;
  const MatrixXd S = N * V, Q = P * W;
  return p.squeeze * (V.transpose() * n) * (n.transpose() * V) + p.twist * (W.transpose() * n) * (n.transpose() * W) + p.a * S.transpose() * S +
         p.b * (S.transpose() * Q + Q.transpose() * S) + p.c * Q.transpose() * Q;
}

}  // namespace

TEST(PairSystem, EqualsTheDissipationOfItsPairsAndTheParticlesOwnBlocks) {
  Example e;
  make(e, 12, true, 3, 0);
  MatrixXd expected = MatrixXd::Zero(72, 72);
  for (const auto& chunk : e.system.own)
    for (const OwnBlock& block : chunk) expected.block(block.particle * 6, block.particle * 6, 6, 6) += full_matrix(block, 6);
  for (const auto& chunk : e.system.full)
    for (const FullPair& p : chunk) {
      const MatrixXd m = pair_matrix(p);
      for (int r = 0; r < 12; ++r)
        for (int c = 0; c < 12; ++c) expected((r < 6 ? p.i : p.j) * 6 + r % 6, (c < 6 ? p.i : p.j) * 6 + c % 6) += m(r, c);
    }
  for (const auto& chunk : e.system.squeeze)
    for (const SqueezePair& p : chunk) {
      const Vector3d n(p.n[0], p.n[1], p.n[2]);
      const MatrixXd m = p.squeeze * n * n.transpose();
      expected.block(p.i * 6, p.i * 6, 3, 3) += m;
      expected.block(p.j * 6, p.j * 6, 3, 3) += m;
      expected.block(p.i * 6, p.j * 6, 3, 3) -= m;
      expected.block(p.j * 6, p.i * 6, 3, 3) -= m;
    }
  EXPECT_LT((dense(e.system, 12) - expected).norm() / expected.norm(), 1e-14);
}

TEST(PairSystem, IsSymmetricPositiveDefiniteAndFreeOfRigidMotion) {
  for (bool rotation : {true, false}) {
    Example e;
    const int n = 60;
    make(e, n, rotation, 5, 0.1);
    const MatrixXd a = dense(e.system, n);
    EXPECT_LT((a - a.transpose()).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(a).eigenvalues().minCoeff(), 0);
  }
  Example e;
  const int n = 60;
  make(e, n, true, 6, 0);
  e.system.own.clear();  // they resist rigid motion
  const Vector3d U(0.3, -1, 2), W(1, 0.2, -0.7);
  std::vector<double> x(n * 6), y;
  for (int k = 0; k < n; ++k) {
    const Vector3d u = U + W.cross(e.position[k]);
    for (int d = 0; d < 3; ++d) {
      x[k * 6 + d] = u[d];
      x[k * 6 + 3 + d] = W[d];
    }
  }
  apply(e.system, x, y);
  double largest = 0;
  for (double v : y) largest = std::max(largest, std::abs(v));
  EXPECT_LT(largest, 1e-12 * 40);  // velocities are of the order of 40, scalars of one
}

TEST(PairSystem, DiagonalBlocksAreThoseOfTheMatrix) {
  for (bool rotation : {true, false}) {
    Example e;
    make(e, 50, rotation, 7, 0.2);
    const int D = e.system.unknowns_per_particle();
    const MatrixXd a = dense(e.system, 50);
    const pigment::Scratch blocks = diagonal_blocks(e.system);
    for (int k = 0; k < 50; ++k)
      for (int r = 0; r < D; ++r)
        for (int c = 0; c <= r; ++c) EXPECT_NEAR(blocks[k * D * (D + 1) / 2 + r * (r + 1) / 2 + c], a(k * D + r, k * D + c), 1e-12);  // entries reach 100
  }
}

TEST(ConjugateGradients, SolvesToTheToleranceAskedFor) {
  for (bool rotation : {true, false}) {
    Example e;
    const int n = 80;
    make(e, n, rotation, 8, 0.05);
    const MatrixXd a = dense(e.system, n);
    const VectorXd exact = a.ldlt().solve(Eigen::Map<const VectorXd>(e.system.right_hand_side.data(), a.rows()));
    std::vector<double> x;
    const SolveReport report = conjugate_gradients(e.system, x, {1e-12, 5000});
    ASSERT_TRUE(report.converged);
    EXPECT_LT((Eigen::Map<VectorXd>(x.data(), a.rows()) - exact).norm() / exact.norm(), 1e-9);
    // The solution as a guess costs no more than the two iterations that show how little there is to gain.
    EXPECT_LE(conjugate_gradients(e.system, x, {1e-10, 5000}).iterations, 2);
  }
}

// A cluster of 60 bonded in a row, each of drag 1: a force of 60 on the first moves all with velocity 1. Beside the bonds' stiffness of
// 1e6 the force is nothing, and the preconditioned residual is small from the beginning; the error's energy is not.
TEST(ConjugateGradients, MovesABondedClusterAsAWhole) {
  constexpr int n = 60;
  std::vector<std::int32_t> i, j;
  for (int k = 0; k + 1 < n; ++k) {
    i.push_back(k);
    j.push_back(k + 1);
  }
  const PairTopology topology(n, i, j);
  ASSERT_EQ(topology.chunks().count(), 1);
  PairSystem system;
  system.rotation = false;
  system.topology = &topology;
  system.particle.assign(n, {1, 1, 0, 1, 1});
  system.full.resize(1);
  system.squeeze.resize(1);
  for (int k = 0; k + 1 < n; ++k) system.squeeze[0].push_back({k, k + 1, k + 1, {1, 0, 0}, 1e6});
  system.right_hand_side.assign(3 * n, 0.0);
  system.right_hand_side[0] = n;
  // An unrelated particle's force across gives the residual its scale.
  system.right_hand_side[3 * (n - 1) + 1] = 100;
  std::vector<double> x;
  ASSERT_TRUE(conjugate_gradients(system, x, {1e-3, 5000}).converged);
  for (int k = 0; k < n; ++k) EXPECT_NEAR(x[3 * k], 1, 0.02) << k;
  // All its pairs are stiff, and there is nothing else: the network is the matrix.
  StiffNetwork network;
  ASSERT_EQ(network.factorize(system, 10), "");
  x.clear();
  const SolveReport report = conjugate_gradients(system, x, {1e-6, 5000}, &network);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 2);
  for (int k = 0; k < n; ++k) EXPECT_NEAR(x[3 * k], 1, 2e-3) << k;  // the chain stretches by 60 x 30 / 1e6
}

TEST(ConjugateGradients, HeldParticlesKeepTheirVelocityAndTheRestBalances) {
  for (bool with_network : {false, true}) {
    Example e;
    const int n = 80;
    make(e, n, true, 9, 0.05);
    e.system.held.assign(n, 0);
    e.system.held_velocity.assign(n, 0.0);
    for (int k : {7, 30}) {
      e.system.held[k] = 1;
      e.system.held_velocity[k] = 3 + k;
    }
    // The rows and columns of the given velocities are taken out by hand.
    MatrixXd a = dense(e.system, n);
    VectorXd b = Eigen::Map<const VectorXd>(e.system.right_hand_side.data(), a.rows());
    for (int k : {7, 30}) b -= a.col(k * 6 + 2) * (3 + k);
    for (int k : {7, 30}) {
      a.row(k * 6 + 2).setZero();
      a.col(k * 6 + 2).setZero();
      a(k * 6 + 2, k * 6 + 2) = 1;
      b(k * 6 + 2) = 3 + k;
    }
    const VectorXd exact = a.ldlt().solve(b);
    StiffNetwork network;
    if (with_network) {
      ASSERT_EQ(network.factorize(e.system, 10), "");
    }
    std::vector<double> x;
    const SolveReport report = conjugate_gradients(e.system, x, {1e-12, 5000}, with_network ? &network : nullptr);
    ASSERT_TRUE(report.converged);
    EXPECT_LT((Eigen::Map<VectorXd>(x.data(), a.rows()) - exact).norm() / exact.norm(), 1e-9);
    EXPECT_EQ(x[7 * 6 + 2], 10);
  }
}

TEST(ConjugateGradients, SameBytesAtAnyThreadCount) {
  std::vector<std::vector<double>> results;
  for (int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Example e;
    make(e, 1000, true, 10, 0.05);
    std::vector<double> x;
    conjugate_gradients(e.system, x, {1e-6, 5000});
    results.push_back(x);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}
