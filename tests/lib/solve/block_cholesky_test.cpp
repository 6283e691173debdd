#include "solve/block_cholesky.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <random>

using namespace pigment::solve;

namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

struct Matrix {
  int nodes;
  Pairs pairs;
  std::vector<double> diagonal, between;  // of each node, of each pair
};

// Of a grid of `edge` nodes a side with bonds to the nearest and some others, of random stiffness over six decades; blocks are not symmetric.
Matrix lattice(int edge, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Matrix m{edge * edge * edge, {}, {}, {}};
  m.diagonal.assign(9 * static_cast<std::size_t>(m.nodes), 0.0);
  for (int k = 0; k < m.nodes; ++k)
    for (int d = 0; d < 3; ++d) m.diagonal[9 * k + 4 * d] = 1;
  const auto bond = [&](int i, int j) {
    if (random() % 2) std::swap(i, j);
    m.pairs.emplace_back(i, j);
    // [a; b] [a; b]^T is never negative, whatever a and b are.
    double a[3], b[3];
    const double stiffness = std::pow(1000.0, uniform(random));
    for (int d = 0; d < 3; ++d) a[d] = stiffness * uniform(random), b[d] = stiffness * uniform(random);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        m.diagonal[9 * i + 3 * r + c] += a[r] * a[c];
        m.diagonal[9 * j + 3 * r + c] += b[r] * b[c];
        m.between.push_back(b[r] * a[c]);
      }
  };
  for (int z = 0; z < edge; ++z)
    for (int y = 0; y < edge; ++y)
      for (int x = 0; x < edge; ++x) {
        const int k = x + edge * (y + edge * z);
        if (x + 1 < edge) bond(k, k + 1);
        if (y + 1 < edge) bond(k, k + edge);
        if (z + 1 < edge && (x + y) % 3) bond(k, k + edge * edge);
        if (x + 1 < edge && y + 1 < edge && random() % 4 == 0) bond(k, k + edge + 1);
      }
  return m;
}

std::vector<double> by_place(const BlockCholesky& factor, const std::vector<double>& of_node, int numbers) {
  std::vector<double> result(of_node.size());
  for (std::size_t k = 0; k < factor.place().size(); ++k) std::copy_n(&of_node[numbers * k], numbers, &result[numbers * factor.place()[k]]);
  return result;
}

std::vector<double> solve(BlockCholesky& factor, const std::vector<double>& b) {
  std::vector<double> x = by_place(factor, b, 3), result(b.size());
#pragma omp parallel
  factor.solve(x.data());
  for (std::size_t k = 0; k < factor.place().size(); ++k) std::copy_n(&x[3 * static_cast<std::size_t>(factor.place()[k])], 3, &result[3 * k]);
  return result;
}

std::vector<double> right_hand_side(int nodes) {
  std::vector<double> b(3 * static_cast<std::size_t>(nodes));
  for (std::size_t q = 0; q < b.size(); ++q) b[q] = std::sin(1.0 + static_cast<double>(q));
  return b;
}

Eigen::SparseMatrix<double> sparse(const Matrix& m) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < m.nodes; ++k)
    for (int d = 0; d < 9; ++d) entries.emplace_back(3 * k + d / 3, 3 * k + d % 3, m.diagonal[9 * k + d]);
  for (std::size_t q = 0; q < m.pairs.size(); ++q)
    for (int d = 0; d < 9; ++d) {
      const int row = 3 * m.pairs[q].second + d / 3, column = 3 * m.pairs[q].first + d % 3;
      entries.emplace_back(row, column, m.between[9 * q + d]);
      entries.emplace_back(column, row, m.between[9 * q + d]);
    }
  Eigen::SparseMatrix<double> a(3 * m.nodes, 3 * m.nodes);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

}  // namespace

// Against Eigen's factor of the same matrix: one node, a few that are one supernode, and enough for a top that threads share. What is
// kept is of single precision, 6e-8 of a stiffness that is up to 1e6 times the diagonal's one: each correction must be right to 1e-3 at
// least, to a twenty-fifth where it is computed in single precision too, and corrections of what is left lead to Eigen's solution.
TEST(BlockCholesky, SolvesAsEigenDoes) {
  for (const Precision precision : {Precision::Double, Precision::Single})
    for (const int edge : {1, 2, 3, 7, 14}) {
      const Matrix m = lattice(edge, 5 + edge);
      BlockCholesky factor;
      ASSERT_TRUE(factor.analyze(m.nodes, m.pairs));
      ASSERT_TRUE(factor.factorize(by_place(factor, m.diagonal, 9), m.between, precision));
      const double right = precision == Precision::Single ? 0.04 : 1e-3;
      const std::vector<double> b = right_hand_side(m.nodes);
      const Eigen::SparseMatrix<double> a = sparse(m);
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> eigen(a);
      ASSERT_EQ(eigen.info(), Eigen::Success);
      const Eigen::VectorXd exact = eigen.solve(Eigen::Map<const Eigen::VectorXd>(b.data(), b.size()));
      std::vector<double> left = b;
      Eigen::VectorXd x = Eigen::VectorXd::Zero(exact.size());
      for (int round = 1; round <= 3; ++round) {
        const std::vector<double> correction = solve(factor, left);
        x += Eigen::Map<const Eigen::VectorXd>(correction.data(), correction.size());
        EXPECT_LT((x - exact).norm(), std::max(std::pow(right, round), 1e-9) * exact.norm()) << edge << ", round " << round;
        Eigen::Map<Eigen::VectorXd>(left.data(), left.size()) = Eigen::Map<const Eigen::VectorXd>(b.data(), b.size()) - a * x;
      }
    }
}

TEST(BlockCholesky, SameBytesAtAnyNumberOfThreads) {
  const Matrix m = lattice(13, 3);
  const std::vector<double> b = right_hand_side(m.nodes);
  std::vector<double> first[2];
  const int most = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    BlockCholesky factor;
    ASSERT_TRUE(factor.analyze(m.nodes, m.pairs));
    for (const Precision precision : {Precision::Double, Precision::Single})
      for (int again = 0; again < 3; ++again) {
        ASSERT_TRUE(factor.factorize(by_place(factor, m.diagonal, 9), m.between, precision));
        const std::vector<double> x = solve(factor, b);
        std::vector<double>& mine = first[precision == Precision::Single];
        if (mine.empty()) mine = x;
        EXPECT_EQ(x, mine) << threads << " threads";
      }
  }
  omp_set_num_threads(most);
}

// One pattern, another matrix; then one that has a negative direction, wherever it is, and one with a number that is none.
TEST(BlockCholesky, SolvesForTwoRightHandSidesAsForEachAlone) {
  for (const int edge : {2, 13}) {
    const Matrix m = lattice(edge, 3);
    BlockCholesky factor;
    ASSERT_TRUE(factor.analyze(m.nodes, m.pairs));
    ASSERT_TRUE(factor.factorize(by_place(factor, m.diagonal, 9), m.between));
    std::vector<double> one = right_hand_side(m.nodes), other(one.rbegin(), one.rend()), both = one;
    both.insert(both.end(), other.begin(), other.end());
#pragma omp parallel
    {
      factor.solve(one.data());
      factor.solve(other.data());
      factor.solve(both.data(), 2);
    }
    EXPECT_TRUE(std::equal(one.begin(), one.end(), both.begin()));
    EXPECT_TRUE(std::equal(other.begin(), other.end(), both.begin() + one.size()));
  }
}

TEST(BlockCholesky, FactorisesAgainAndRefusesWhatIsNotPositiveDefinite) {
  Matrix m = lattice(10, 11);
  BlockCholesky factor;
  ASSERT_TRUE(factor.analyze(m.nodes, m.pairs));
  ASSERT_TRUE(factor.factorize(by_place(factor, m.diagonal, 9), m.between));
  const std::vector<double> b = right_hand_side(m.nodes), before = solve(factor, b);
  for (double& v : m.diagonal) v *= 4;
  for (double& v : m.between) v *= 4;
  ASSERT_TRUE(factor.factorize(by_place(factor, m.diagonal, 9), m.between));
  const std::vector<double> after = solve(factor, b);
  for (std::size_t q = 0; q < b.size(); ++q) EXPECT_EQ(4 * after[q], before[q]);
  for (const int node : {0, 317, 555, m.nodes - 1})
    for (const double bad : {-1e9, std::nan("")}) {
      Matrix worse = m;
      worse.diagonal[9 * node + 4] = bad;
      EXPECT_FALSE(factor.factorize(by_place(factor, worse.diagonal, 9), m.between)) << node;
    }
  EXPECT_TRUE(factor.factorize(by_place(factor, m.diagonal, 9), m.between));
  EXPECT_EQ(solve(factor, b), after);
}

// Nodes without pairs, and none at all.
TEST(BlockCholesky, TakesLooseNodes) {
  BlockCholesky factor;
  ASSERT_TRUE(factor.analyze(0, {}));
  EXPECT_TRUE(factor.factorize({}, {}));
  ASSERT_TRUE(factor.analyze(3, {}));
  std::vector<double> diagonal(27, 0.0);
  for (int k = 0; k < 3; ++k)
    for (int d = 0; d < 3; ++d) diagonal[9 * k + 4 * d] = 4;
  ASSERT_TRUE(factor.factorize(diagonal, {}));
  EXPECT_EQ(solve(factor, {4, 8, 12, 16, 20, 24, 28, 32, 36}), (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}
