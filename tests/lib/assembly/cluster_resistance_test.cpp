// The resistance matrix that a step assembles, on random clusters of unequal spheres nearly in contact.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <random>

#include "assembly/step_assembly.h"
#include "model/liquid.h"
#include "support/first_step.h"

using namespace pigment;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Cluster = test::Spheres;  // about its middle, so that rigid motions are of the order of its size

// n spheres of radii between 1/ratio and 1, evenly in the logarithm; each new one beside a random one that is there, at a gap
// between smallest and 0.3 of the smaller radius, again evenly in the logarithm, and overlapping none.
Cluster random_cluster(int n, double ratio, double smallest, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  Cluster c;
  c.add(1, Vec3::Zero());
  while (static_cast<int>(c.position.size()) < n) {
    const auto k = static_cast<std::size_t>(uniform(random) * static_cast<double>(c.position.size()));
    const double a = std::pow(ratio, -uniform(random)), b = c.particles.radius[k];
    const double gap = std::min(a, b) * smallest * std::pow(0.3 / smallest, uniform(random));
    const Vec3 at = c.position[k] + (a + b + gap) * Vec3(normal(random), normal(random), normal(random)).normalized();
    bool free = true;
    for (std::size_t j = 0; j < c.position.size() && free; ++j)
      free = j == k || (c.position[j] - at).norm() - a - c.particles.radius[j] > smallest * std::min(a, c.particles.radius[j]);
    if (free) c.add(a, at);
  }
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : c.position) middle += x / n;
  for (Vec3& x : c.position) x -= middle;
  return c;
}

struct Assembled {
  assembly::Interactions interactions;
  neighbours::NeighbourList list;
  std::unique_ptr<assembly::StepAssembly> step;
  solve::PairSystem system;

  explicit Assembled(const Cluster& cluster) {
    interactions.surface_potential = {0};
    interactions.liquid.viscosity = 1;
    const Cell cell{400, 400, 400};
    const Liquid liquid = liquid_at(interactions.liquid, 298.15);
    const Vec3Array& position = cluster.position;
    neighbours::PairRange range = assembly::pair_range(interactions, liquid);
    range.skin = 0;
    list = neighbours::make_neighbour_list(cell, position, cluster.particles.radius, range);
    step = std::make_unique<assembly::StepAssembly>(interactions, cluster.particles, cell, list);
    step->begin(position, {400, 400, 0, 0}, liquid, 0.01, assembly::Treatment::Explicit, {}, std::vector<double>(position.size(), 0.0));
    step->build(system);
  }
  // R, rows and columns in the order of the file.
  MatrixXd matrix() const {
    const auto n = static_cast<Eigen::Index>(list.order.size());
    MatrixXd R(6 * n, 6 * n);
    std::vector<double> x(static_cast<std::size_t>(6 * n), 0.0), y;
    for (Eigen::Index k = 0; k < n; ++k)
      for (int d = 0; d < 6; ++d) {
        x[static_cast<std::size_t>(6 * k + d)] = 1;
        solve::apply(system, x, y);
        x[static_cast<std::size_t>(6 * k + d)] = 0;
        for (Eigen::Index i = 0; i < n; ++i)
          for (int e = 0; e < 6; ++e)
            R(6 * list.order[static_cast<std::size_t>(i)] + e, 6 * list.order[static_cast<std::size_t>(k)] + d) =
                y[static_cast<std::size_t>(6 * i + e)];
      }
    return R;
  }
};

}  // namespace

TEST(ClusterResistance, IsSymmetricPositiveDefiniteAndFreeOfRigidMotion) {
  for (double ratio : {1.0, 8.0, 100.0})
    for (unsigned seed : {1u, 2u, 3u}) {
      const Cluster cluster = random_cluster(50, ratio, 1e-5, seed);
      Assembled assembled(cluster);
      ASSERT_GE(assembled.step->pair_count(), 49u);
      const MatrixXd R = assembled.matrix();
      EXPECT_LE((R - R.transpose()).cwiseAbs().maxCoeff(), 1e-14 * R.cwiseAbs().maxCoeff()) << ratio << " " << seed;

      // Over isolated drag no motion dissipates less than alone: the eigenvalues of D^-1/2 R D^-1/2 are one and more. They
      // reach 1e8, so that rounding leaves 1e-8 of one.
      VectorXd drag(R.rows());
      for (std::size_t k = 0; k < cluster.position.size(); ++k)
        for (int d = 0; d < 6; ++d) {
          const double a = cluster.particles.radius[k];
          drag[static_cast<Eigen::Index>(6 * k) + d] = d < 3 ? 6 * EIGEN_PI * a : 8 * EIGEN_PI * a * a * a;
        }
      const VectorXd scale = drag.cwiseSqrt().cwiseInverse();
      const MatrixXd scaled = scale.asDiagonal() * R * scale.asDiagonal();
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[0], 1 - 1e-6);

      // Rigid motion of the cluster without isolated drag.
      const MatrixXd pairs = R - MatrixXd(drag.asDiagonal());
      for (int mode = 0; mode < 6; ++mode) {
        VectorXd u(R.rows());
        for (std::size_t k = 0; k < cluster.position.size(); ++k) {
          const Vec3 turn = mode < 3 ? Vec3::Zero() : Vec3(Vec3::Unit(mode - 3));
          const Vec3 move = mode < 3 ? Vec3(Vec3::Unit(mode)) : turn.cross(cluster.position[k]);
          u.segment<3>(static_cast<Eigen::Index>(6 * k)) = move;
          u.segment<3>(static_cast<Eigen::Index>(6 * k) + 3) = turn;
        }
        // Sums of terms of size |R| |u| that cancel: rounding, times the few pairs of a particle.
        EXPECT_LT((pairs * u).cwiseAbs().maxCoeff(), 1e-13 * R.cwiseAbs().maxCoeff() * u.cwiseAbs().maxCoeff())
            << ratio << " " << seed << " " << mode;
      }
    }
}

// Turned as a whole, the cluster has the turned matrix. Gaps from a hundredth of the radius: nearer ones change by rounding of
// the positions (1e-15 of 10 um) more than the tolerance allows.
TEST(ClusterResistance, TurnsWithTheCluster) {
  for (unsigned seed : {1u, 2u}) {
    const Cluster cluster = random_cluster(50, 8, 1e-2, seed);
    const Eigen::Matrix3d Q = Eigen::AngleAxisd(0.7 + seed, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
    Cluster turned = cluster;
    for (Vec3& x : turned.position) x = Q * x;
    const MatrixXd R = Assembled(cluster).matrix(), S = Assembled(turned).matrix();
    MatrixXd expected(R.rows(), R.cols());
    for (Eigen::Index i = 0; i < R.rows(); i += 3)
      for (Eigen::Index j = 0; j < R.cols(); j += 3)
        expected.block<3, 3>(i, j) = Q * R.block<3, 3>(i, j) * Q.transpose();
    EXPECT_LT((S - expected).cwiseAbs().maxCoeff(), 1e-12 * R.cwiseAbs().maxCoeff()) << seed;
  }
}

// Renumbered, it has the renumbered matrix: who is first in a pair does not matter.
TEST(ClusterResistance, ExchangesWithTheParticles) {
  const Cluster cluster = random_cluster(50, 8, 1e-3, 5);
  Cluster reversed;
  const std::size_t n = cluster.position.size();
  for (std::size_t k = n; k-- > 0;) reversed.add(cluster.particles.radius[k], cluster.position[k]);
  const MatrixXd R = Assembled(cluster).matrix(), S = Assembled(reversed).matrix();
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      worst = std::max(worst, (R.block<6, 6>(static_cast<Eigen::Index>(6 * i), static_cast<Eigen::Index>(6 * j)) -
                               S.block<6, 6>(static_cast<Eigen::Index>(6 * (n - 1 - i)), static_cast<Eigen::Index>(6 * (n - 1 - j))))
                                  .cwiseAbs()
                                  .maxCoeff());
  EXPECT_LT(worst, 1e-12 * R.cwiseAbs().maxCoeff());
}

// Species have potentials of their own: each pair, and each particle over the substrate, has the force of its two potentials.
TEST(SpeciesPotentials, EveryPairHasTheForceOfItsTwo) {
  assembly::Interactions interactions;
  interactions.surface_potential = {-25, -60};
  interactions.liquid.viscosity = 1;
  interactions.liquid.relative_permittivity = 80;
  auto document = config::Document::from_text("colloidal: {electrostatic: {debye_length: 5 nm}}");
  interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  Cluster three;
  const double a = 0.5, b = 0.25, gap = 0.004;
  three.add(a, {10, 10, 10});
  three.add(b, {10 + a + b + gap, 10, 10});
  three.add(a, {10 + 2 * a + 2 * b + 2 * gap, 10, 10});
  three.particles.species = {0, 1, 1};
  const Cell cell{20, 20, 20};
  const Liquid liquid = liquid_at(interactions.liquid, 298.15);
  const auto list =
      neighbours::make_neighbour_list(cell, three.position, three.particles.radius, assembly::pair_range(interactions, liquid));
  assembly::StepAssembly step(interactions, three.particles, cell, list);
  solve::PairSystem system;
  step.begin(three.position, {20, 20, 0, 0}, liquid, 0.01, assembly::Treatment::Explicit, {}, std::vector<double>(3, 0.0));
  step.build(system);
  // [hogg1966]: f = pi eps R kappa [ (p1 + p2)^2 e/(1 + e) - (p1 - p2)^2 e/(1 - e) ], e = exp(-kappa h), in SI and then pN.
  const auto expected = [&](double p1, double p2) {
    const double kappa = 1 / 5e-9, e = std::exp(-kappa * gap * 1e-6), R = a * b / (a + b) * 1e-6;
    const double plus = (p1 + p2) * (p1 + p2), minus = (p1 - p2) * (p1 - p2);
    return EIGEN_PI * 80 * 8.8541878128e-12 * R * kappa * (plus * e / (1 + e) - minus * e / (1 - e)) * 1e12;
  };
  int found = 0;
  for (std::size_t p = 0; p < step.pair_count(); ++p) {
    auto [i, j] = step.pair(p);
    i = list.order[static_cast<std::size_t>(i)];
    j = list.order[static_cast<std::size_t>(j)];
    if (std::abs(i - j) != 1) continue;
    ++found;
    const double wanted = i + j == 1 ? expected(-0.025, -0.060) : expected(-0.060, -0.060);
    EXPECT_NEAR(step.pair_force(p), wanted, 1e-9 * std::abs(wanted));
  }
  EXPECT_EQ(found, 2);
}
