#include "assembly/rough_substrate.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <random>

#include "assembly/step_assembly.h"
#include "model/layer_measures.h"
#include "resistance/scene_resistance.h"
#include "resistance/source_forms.h"
#include "solve/conjugate_gradients.h"
#include "support/first_step.h"

using namespace pigment;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const Cell cell{4, 4, 20};

// Spheres over a rough substrate and the system of their first step.
struct FirstStep : test::FirstStep {
  explicit FirstStep(const HeightMap& map) {
    cell = ::cell;
    interactions.substrate.emplace();
    interactions.height_field = std::make_shared<const HeightField>(map, cell);
  }
  const HeightField& field() const { return *interactions.height_field; }
  MatrixXd matrix() const {
    const int n = static_cast<int>(system.right_hand_side.size());
    MatrixXd a(n, n);
    for (int q = 0; q < n; ++q) {
      std::vector<double> x(n, 0.0), y;
      x[q] = 1;
      solve::apply(system, x, y);
      a.col(q) = Eigen::Map<VectorXd>(y.data(), n);
    }
    return a;
  }
};

// F = -(perpendicular n n + parallel (1 - n n)) U - coupling (W x n), T = -(twist n n + rolling (1 - n n)) W - coupling (n x U).
MatrixXd tilted(const resistance::BoundaryScalars& w, const Vec3& n) {
  const MatrixXd I = MatrixXd::Identity(3, 3), N = n * n.transpose();
  MatrixXd cross(3, 3), m(6, 6);  // n x
  cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  m << w.perpendicular * N + w.parallel * (I - N), -w.coupling * cross, w.coupling * cross, w.twist * N + w.rolling * (I - N);
  return m;
}
MatrixXd isolated(double a) {
  VectorXd d(6);
  d << VectorXd::Constant(3, resistance::stokes_drag(a)), VectorXd::Constant(3, resistance::stokes_torque(a));
  return d.asDiagonal();
}

// Above a point of the surface, along its normal.
Vec3 above(const HeightField& field, double x, double y, double distance) {
  const double e = 1e-6, gx = (field.height(x + e, y) - field.height(x - e, y)) / (2 * e), gy = (field.height(x, y + e) - field.height(x, y - e)) / (2 * e);
  return Vec3(x, y, field.height(x, y)) + distance * Vec3(-gx, -gy, 1).normalized();
}

}  // namespace

// Near one point of a gentle slope the matrix is the plane's, turned: assembled here densely from the wall's scalars.
TEST(RoughSubstrate, OnASlopeTheResistanceIsThatOfTheTangentPlane) {
  FirstStep layer(height_map({0.6, 4, {}}));
  const double a = 0.2, gap = 0.01;
  const Vec3 at = above(layer.field(), 0.7, 1.2, a + gap);
  layer.add(a, at);
  layer.build();
  const auto feet = layer.field().feet(at, 2 * a);
  ASSERT_EQ(feet.size(), 1u);
  EXPECT_NEAR(feet[0].distance, a + gap, 1e-9);
  EXPECT_GT(std::abs(feet[0].normal.x()), 0.1);
  // The slope is curved by 1 % of the sphere's own curvature: 12 pi mu/(h sqrt(k1 k2) (k1 + k2)) for 6 pi mu a^2/h.
  resistance::BoundaryScalars wall = resistance::wall_term(layer.interactions.hydrodynamics, a, gap);
  const double k1 = 1 / a + feet[0].curvature, k2 = 1 / a + feet[0].least_curvature;
  wall.perpendicular += 12 * std::numbers::pi / (gap * std::sqrt(k1 * k2) * (k1 + k2)) - 6 * std::numbers::pi * a * a / gap;
  const MatrixXd expected = isolated(a) + tilted(wall, feet[0].normal);
  // The foot is found to some 1e-9 um of a gap of 0.01.
  EXPECT_LT((layer.matrix() - expected).norm(), 1e-6 * expected.norm());
}

TEST(RoughSubstrate, ResistanceIsSymmetricAndPositiveDefiniteEverywhere) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> along(0, 4), gap(1e-4, 1.5), size(0.1, 0.6);
  for (const auto model : {resistance::HydrodynamicsParameters::Model::Exact, resistance::HydrodynamicsParameters::Model::Thesis}) {
    int several = 0;
    for (int k = 0; k < 200; ++k) {
      FirstStep layer(height_map({0.9, 1.3, {}}));
      layer.interactions.hydrodynamics.model = model;
      const double a = size(random);
      const Vec3 at = above(layer.field(), along(random), along(random), a * (1 + gap(random)));
      if (!(layer.field().gap(at, a, a) > 0)) continue;
      layer.add(a, at);
      layer.build();
      several += layer.field().feet(at, 2.5 * a).size() > 1;
      const MatrixXd m = layer.matrix();
      EXPECT_LT((m - m.transpose()).cwiseAbs().maxCoeff(), 1e-12 * m.cwiseAbs().maxCoeff());
      // Never less than the drag and torque of the sphere alone; rounding of the largest entry.
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(m - isolated(a)).eigenvalues().minCoeff(), -1e-12 * m.cwiseAbs().maxCoeff());
    }
    EXPECT_GT(several, 20);
  }
}

// Far above, and with an amplitude that vanishes, there is the plane at the mean height.
TEST(RoughSubstrate, VanishingAmplitudeIsThePlane) {
  for (const double gap : {0.002, 0.1, 0.3, 0.6, 2.0}) {
    FirstStep rough(height_map({1e-9, 2, {}}));
    FirstStep plane(height_map({1e-9, 2, {}}));
    plane.interactions.height_field = nullptr;
    for (FirstStep* layer : {&rough, &plane}) {
      layer->colloidal("{electrostatic: {debye_length: 5 nm}, van_der_waals: {}, born: {}}");
      layer->interactions.gravity.emplace();
      layer->film.absorption = 0.02;
      layer->interactions.substrate->suction = forces::SubstrateParameters::Suction::Uniform;
      layer->add(0.5, {1.3, 2.2, 0.5 + gap});
      layer->build();
    }
    const MatrixXd expected = plane.matrix();
    // 1e-9 um of a gap of 2e-3.
    EXPECT_LT((rough.matrix() - expected).norm(), 2e-6 * expected.norm()) << gap;
    const VectorXd f = Eigen::Map<VectorXd>(rough.system.right_hand_side.data(), 6), g = Eigen::Map<VectorXd>(plane.system.right_hand_side.data(), 6);
    EXPECT_LT((f - g).norm(), 2e-6 * g.norm()) << gap;
  }
}

// A sphere wedged between two walls of a groove touches both; what pulls it sideways cancels, what lifts it adds.
TEST(RoughSubstrate, InAValleyBothWallsPush) {
  HeightMap groove{12, 1, 1, 1, {}};
  for (int i = 0; i < 12; ++i) groove.height.push_back(0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / 12));
  FirstStep layer(groove);
  layer.colloidal("{electrostatic: {debye_length: 5 nm}}");
  layer.interactions.hydrodynamics.model = resistance::HydrodynamicsParameters::Model::Drag;
  const double a = 0.4;
  double z = 1.2;  // lowered into the groove until 6 nm are left
  for (int k = 0; k < 100; ++k) z -= 0.5 * (layer.field().gap({2, 2, z}, a, 1) - 0.006);
  const auto feet = layer.field().feet({2, 2, z}, a + 0.05);
  ASSERT_EQ(feet.size(), 2u);
  EXPECT_NEAR(feet[0].normal.x(), -feet[1].normal.x(), 1e-6);
  layer.treatment = assembly::Treatment::Explicit;
  layer.add(a, {2, 2, z});
  layer.build();
  // -dV/dh of (17) at 6 nm between a sphere and a plane, R = a: once a wall.
  const double e = std::exp(-6.0 / 5), force = 4 * std::numbers::pi * 80 * 8.8541878128e-12 * a * 1e-6 * 0.025 * 0.025 / 5e-9 * e / (1 + e) * 1e12;
  EXPECT_NEAR(layer.system.right_hand_side[0], 0, 1e-6 * force);
  EXPECT_NEAR(layer.system.right_hand_side[1], 0, 1e-6 * force);
  // A wall curved across the groove alone: Derjaguin's 1/sqrt(k1 k2) for a.
  const double curved = 1 / std::sqrt(1 + a * (feet[0].curvature + feet[0].least_curvature));
  EXPECT_NEAR(feet[0].curvature * feet[0].least_curvature, 0, 1e-9);
  EXPECT_NEAR(layer.system.right_hand_side[2], 2 * curved * force * feet[0].normal.z(), 1e-6 * force);
}

// A round hill is a sphere: near contact the squeeze is that of two spheres by their exact functions, the force their law's.
TEST(RoughSubstrate, OnAHillTheContactIsThatOfTwoSpheres) {
  const double a = 0.3;
  for (const double gap : {0.0003, 0.003}) {
    FirstStep layer(height_map({0.6, 1, {}}));
    const auto foot = layer.field().feet({2, 2, 0.8}, 0.3).at(0);
    const double b = 1 / foot.curvature;
    EXPECT_NEAR(foot.least_curvature * b, 1, 1e-6);
    layer.colloidal("{electrostatic: {debye_length: 5 nm}, van_der_waals: {}}");
    layer.treatment = assembly::Treatment::Explicit;
    layer.add(a, {2, 2, 0.6 + a + gap});
    layer.build();
    const double pair = resistance::pair_term(layer.interactions.hydrodynamics, a, b, gap).squeeze;
    const double hill = layer.matrix()(2, 2) - resistance::stokes_drag(a);
    // The terms beside the singular one stay the plane's: some 6 pi a of 6 pi R^2/h.
    EXPECT_NEAR(hill, pair, 0.02 * pair + 6 * std::numbers::pi * a);
    const Liquid liquid = liquid_at(layer.interactions.liquid, 298.15);
    double force = 0;
    for (const auto& [name, law] : layer.interactions.colloidal) force += law->prepare(liquid)->switched({gap, a, b, -25, -25}).force;
    EXPECT_NEAR(layer.system.right_hand_side[2], force, 1e-6 * std::abs(force));
  }
}

// Section 3.2.3: a wall is a virtual sphere of 100 a, a corner one of a/10, that touches the boundary.
TEST(RoughSubstrate, TheSourcesRidgeIsACornerAndItsValleyAWall) {
  const Roughness rough{0.6, 1, {}};  // curvature on the crests and in the valleys 6/um
  for (const bool crest : {true, false}) {
    FirstStep layer(height_map(rough));
    layer.interactions.hydrodynamics.model = resistance::HydrodynamicsParameters::Model::Thesis;
    const double a = crest ? 0.3 : 0.1, gap = 0.005, x = crest ? 2 : 1.5;
    layer.add(a, {x, x, layer.field().height(x, x) + a + gap});
    layer.build();
    const auto& taper = layer.interactions.hydrodynamics.taper;
    const resistance::BoundaryScalars w =
        crest ? resistance::source_corner_increment(a, gap, taper) : resistance::source_wall_increment(a, gap, taper);
    const MatrixXd expected = isolated(a) + tilted(w, {0, 0, 1});
    EXPECT_LT((layer.matrix() - expected).norm(), 1e-6 * expected.norm());
    if (crest) {
      const double pair = resistance::source_pair_scalars(a, a / 10, gap, taper).squeeze;
      EXPECT_NEAR(layer.matrix()(2, 2), resistance::stokes_drag(a) + pair, 1e-6 * pair);
      EXPECT_LT(pair, 0.1 * resistance::source_wall_increment(a, gap, taper).perpendicular);  // a corner hardly resists
    }
  }
}

namespace {

// Sixty spheres in 3 um of liquid over waves, absorbed and evaporated, and the velocities that the step comes to.
struct Drained {
  FirstStep layer{height_map({0.8, 1.3, {}})};
  std::vector<double> u;
  explicit Drained(forces::SubstrateParameters::Suction suction, resistance::HydrodynamicsParameters::Drag drag) {
    layer.interactions.substrate->suction = suction;
    layer.interactions.hydrodynamics.drag = drag;
    layer.colloidal("{electrostatic: {debye_length: 5 nm}, van_der_waals: {}, born: {}}");
    layer.interactions.free_surface.emplace();
    layer.film = {3.0, 2.999, 0, 0.05, 0.05};
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> along(0, 4), up(0.3, 2.7);
    while (layer.position.size() < 60) {
      const Vec3 p(along(random), along(random), up(random));
      bool free = layer.field().gap(p, 0.25, 0.1) > 0.003;
      for (const Vec3& q : layer.position) free = free && cell.minimum_image(p - q).norm() > 0.503;
      if (free) layer.add(0.25, p);
    }
    layer.dt = 1e-3;
    layer.build();
    for (int pass = 0; pass < 25; ++pass) {
      EXPECT_TRUE(solve::conjugate_gradients(layer.system, u, {1e-13, 5000}).converged);
      if (!layer.step->refine(layer.system, u).refine) break;
      layer.step->build(layer.system);
    }
  }
};

}  // namespace

// What substrate and liquid push up with is what the surface and gravity push down with, whatever the accuracy of the contacts.
TEST(RoughSubstrate, BoundaryPressuresBalanceTheForces) {
  for (const auto suction : {forces::SubstrateParameters::Suction::Impermeable, forces::SubstrateParameters::Suction::Uniform}) {
    const Drained drained(suction, resistance::HydrodynamicsParameters::Drag::Stokes);
    const assembly::BoundaryPressures p = drained.layer.step->boundary_pressures(drained.u);
    // The solve's residual, and the cancellation of terms a thousand times the sum.
    EXPECT_NEAR(p.surface, p.substrate + p.liquid, 1e-8 * (std::abs(p.surface) + std::abs(p.substrate) + std::abs(p.liquid)));
    EXPECT_GT(std::abs(p.substrate), 0.01 * std::abs(p.liquid));
  }
}

// With hindered drag a slice is what lies above the surface: solids over that space, volume conserved there, and the pressure drop
// acts on its part of the area.
TEST(RoughSubstrate, SlicesOfHinderedDragHoldTheSpaceAboveTheSurface) {
  const Drained drained(forces::SubstrateParameters::Suction::Impermeable, resistance::HydrodynamicsParameters::Drag::Hindered);
  const FirstStep& layer = drained.layer;
  const auto slices = layer.step->slice_states(drained.u);
  const std::vector<double> edges = equal_slices(3.0, static_cast<int>(slices.size()));
  ASSERT_GT(slices.size(), 3u);
  const std::vector<double> solids = slice_volumes(edges, layer.position, layer.particles.radius);
  double carried = 0;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    double space = 0;  // by midpoints over the surface, which the field's own sum is 1 % off at most
    const int n = 400;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double h = layer.field().height(4.0 * (i + 0.5) / n, 4.0 * (j + 0.5) / n);
        space += 16.0 / (n * n) * (std::max(0.0, edges[s + 1] - h) - std::max(0.0, edges[s] - h));
      }
    EXPECT_NEAR(slices[s].solids_fraction, solids[s] / space, 0.01 * solids[s] / space);
    EXPECT_NEAR(slices[s].solids_flux + (1 - slices[s].solids_fraction) * slices[s].liquid_velocity, -0.05, 1e-12);
    carried += slices[s].pressure_drop * 16.0 * (layer.field().space_below(edges[s + 1]) - layer.field().space_below(edges[s])) / (edges[s + 1] - edges[s]);
  }
  const assembly::BoundaryPressures p = layer.step->boundary_pressures(drained.u);
  EXPECT_NEAR(p.surface, p.substrate + carried / 16.0, 1e-8 * (std::abs(p.surface) + std::abs(p.substrate) + std::abs(carried)));
}
