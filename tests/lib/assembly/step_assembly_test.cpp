#include "assembly/step_assembly.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "resistance/boundary_resistance.h"
#include "support/first_step.h"

using namespace pigment;
using assembly::StepAssembly;

namespace {

constexpr double pi = 3.14159265358979323846;

struct FirstStep : test::FirstStep {
  // Right-hand side on a particle, file order.
  Vec3 rhs(std::size_t particle) const {
    const std::size_t D = system.unknowns_per_particle();
    for (std::size_t k = 0; k < list.order.size(); ++k)
      if (list.order[k] == static_cast<std::int32_t>(particle))
        return {system.right_hand_side[k * D], system.right_hand_side[k * D + 1], system.right_hand_side[k * D + 2]};
    return Vec3::Constant(NAN);
  }
};

}  // namespace

// (10), (11), buoyant weight and the absorbing liquid, by hand.
TEST(StepAssembly, LoneSphereHasStokesDragItsWeightAndTheLiquidsPull) {
  FirstStep layer;
  layer.add(0.5, {3, 4, 10});
  layer.interactions.gravity.emplace();
  layer.film.absorption = 0.02;
  layer.force = {{0.3, -0.2, 0.1}};
  layer.build();
  const double drag = 6 * pi * 0.5, torque = 8 * pi * 0.125;
  const solve::ParticleTerm& t = layer.system.particle[0];
  EXPECT_NEAR(t.across, drag, 1e-14 * drag);
  EXPECT_NEAR(t.along, drag, 1e-14 * drag);
  EXPECT_NEAR(t.spin_across, torque, 1e-14 * torque);
  EXPECT_NEAR(t.spin_along, torque, 1e-14 * torque);
  EXPECT_EQ(t.coupling, 0);
  const double weight = (2.7e-3 - 1e-3) * 4.0 / 3.0 * pi * 0.125 * 9.81;
  const Vec3 expected(0.3, -0.2, 0.1 - drag * 0.02 - weight);
  EXPECT_LT((layer.rhs(0) - expected).norm(), 1e-14 * expected.norm());
}

TEST(StepAssembly, PairForceIsTheLawsAndActsBothWays) {
  FirstStep layer;
  layer.colloidal("{electrostatic: {debye_length: 5 nm}}");
  const double gap = 0.006, a = 0.5, b = 0.25;
  const Vec3 n = Vec3(1, -2, 2) / 3;
  // Across the periodic corner: the nearest image counts.
  layer.add(a, {19.9, 0.1, 10});
  layer.add(b, Vec3(19.9, 0.1, 10) + (a + b + gap) * n + Vec3(-20, 20, 0));
  layer.build();
  ASSERT_EQ(layer.step->pair_count(), 1u);
  // -dV/dh of (17): 4 pi eps R psi^2 kappa e/(1 + e), e = exp(-kappa h), SI and then pN.
  const double kappa = 1 / 5e-9, e = std::exp(-kappa * 6e-9), R = a * b / (a + b) * 1e-6;
  const double f = 4 * pi * 80 * 8.8541878128e-12 * R * 0.025 * 0.025 * kappa * e / (1 + e) * 1e12;
  EXPECT_LT((layer.rhs(0) + f * n).norm(), 1e-9 * f);
  EXPECT_LT((layer.rhs(1) - f * n).norm(), 1e-9 * f);
  EXPECT_NEAR(layer.step->pair_force(0), f, 1e-9 * f);
  EXPECT_NEAR(layer.step->gaps()[0], gap, 1e-14);
}

// The implicit system holds dt k besides the squeeze resistance, k = -df/dh by differences of the law's own force.
TEST(StepAssembly, ImplicitStepAddsTheStiffnessOfRepulsion) {
  const auto squeeze = [](double dt, assembly::Treatment treatment, const std::string& laws) {
    FirstStep layer;
    layer.colloidal(laws);
    layer.dt = dt;
    layer.treatment = treatment;
    layer.add(0.5, {10, 10, 10});
    layer.add(0.5, {10, 10, 11.006});
    layer.build();
    return layer.system.full.at(0)[0].squeeze;
  };
  const std::string repulsion = "{electrostatic: {debye_length: 5 nm}}", attraction = "{van_der_waals: {hamaker_constant: 1e-20 J}}";
  const auto force = [](double gap) {
    FirstStep layer;
    layer.colloidal("{electrostatic: {debye_length: 5 nm}}");
    layer.add(0.5, {10, 10, 10});
    layer.add(0.5, {10, 10, 11 + gap});
    layer.build();
    return layer.rhs(1).z();
  };
  const double stiffness = -(force(0.00601) - force(0.00599)) / 2e-5;
  const double viscous = squeeze(0.01, assembly::Treatment::Explicit, repulsion);
  EXPECT_NEAR(squeeze(0.01, assembly::Treatment::Newton, repulsion) - viscous, 0.01 * stiffness, 1e-5 * 0.01 * stiffness);
  EXPECT_NEAR(squeeze(0.05, assembly::Treatment::Newton, repulsion) - viscous, 0.05 * stiffness, 1e-5 * 0.05 * stiffness);
  // Attraction has the other sign: it stays explicit, so that the matrix stays positive definite.
  EXPECT_EQ(squeeze(0.05, assembly::Treatment::Newton, attraction), viscous);
}

TEST(StepAssembly, GapVelocitiesAndRefinementFollowTheSolution) {
  FirstStep layer;
  layer.add(0.5, {10, 10, 10});
  layer.add(0.5, {10, 10, 11.01});
  layer.build();
  // 0.5 um/ms towards each other along z for 0.01 ms: 5 of the 10 nm are left; twice as fast: contact.
  std::vector<double> u(12, 0.0), rate;
  const int lower = layer.list.order[0] == 0 ? 0 : 6, upper = 6 - lower;
  u[lower + 2] = 0.25;
  u[upper + 2] = -0.25;
  layer.step->gap_velocities(u, rate);
  ASSERT_EQ(rate.size(), 1u);
  EXPECT_NEAR(rate[0], -0.5, 1e-14);
  assembly::GapCheck check = layer.step->refine(layer.system, u);
  EXPECT_NEAR(check.smallest_gap, 0.005, 1e-12);
  u[lower + 2] = 2;
  check = layer.step->refine(layer.system, u);
  EXPECT_LT(check.smallest_gap, 0);
  EXPECT_TRUE(check.refine);
  // Solved anew with the averaged resistance, which grows without bound as the end of the step nears contact.
  double before = layer.system.full.at(0)[0].squeeze;
  for (int pass = 0; pass < 3; ++pass) {
    layer.step->build(layer.system);
    const double now = layer.system.full.at(0)[0].squeeze;
    EXPECT_GT(now, 1.2 * before) << pass;
    before = now;
    layer.step->refine(layer.system, u);
  }
}

// Whatever the mean over all particles is: one gap far inside its guess has a force that the linear law knows nothing of.
TEST(StepAssembly, SaysThatAGapCameOutDeep) {
  FirstStep layer;
  layer.add(0.5, {10, 10, 10});
  layer.add(0.5, {10, 10, 11.01});
  for (int k = 0; k < 100; ++k) layer.add(0.05, {0.2 + 0.19 * k, 1, 1});
  layer.build();
  const auto refined_at = [&](double gap) {  // nm at the step's end, 0.01 ms from 10 nm
    std::vector<double> u(6 * layer.position.size(), 0.0);
    for (std::size_t k = 0; k < layer.position.size(); ++k)
      if (layer.list.order[k] < 2) u[6 * k + 2] = (layer.list.order[k] == 0 ? 0.05 : -0.05) * (10 - gap);
    return layer.step->refine(layer.system, u);
  };
  EXPECT_FALSE(refined_at(9).deep);
  EXPECT_TRUE(refined_at(3).deep);
  bool still = true;
  for (int pass = 0; still && pass < 20; ++pass) {
    layer.step->build(layer.system);
    still = refined_at(3).deep;
  }
  EXPECT_FALSE(still);  // the guess has come there
  EXPECT_FALSE(refined_at(20).deep);  // wide open pushes nothing
  layer.step->build(layer.system);
  EXPECT_TRUE(refined_at(1).deep);
}

// A scene without a term has none of its entries.
TEST(StepAssembly, WhatASceneLeavesOutIsNotThere) {
  FirstStep layer;
  layer.interactions.hydrodynamics.model = resistance::HydrodynamicsParameters::Model::Drag;
  layer.add(0.5, {10, 10, 10});
  layer.add(0.5, {10, 10, 11.01});
  layer.build();
  EXPECT_EQ(layer.system.unknowns_per_particle(), 3);
  EXPECT_TRUE(layer.system.full.at(0).empty());
  EXPECT_TRUE(layer.system.squeeze.at(0).empty());
  for (double f : layer.system.right_hand_side) EXPECT_EQ(f, 0);
}

// Above the substrate the resistance is that of the wall functions; with uniform suction it acts relative to the liquid.
TEST(StepAssembly, SubstrateAddsTheWallsResistance) {
  for (bool uniform : {false, true}) {
    FirstStep layer;
    layer.interactions.substrate.emplace();
    if (uniform) layer.interactions.substrate->suction = forces::SubstrateParameters::Suction::Uniform;
    layer.film.absorption = 0.02;
    layer.add(0.5, {3, 4, 0.55});
    layer.build();
    const double drag = 6 * pi * 0.5;
    const resistance::BoundaryScalars wall = resistance::wall_increment(0.5, 0.05);
    const solve::ParticleTerm& t = layer.system.particle[0];
    EXPECT_NEAR(t.along, drag + wall.perpendicular, 1e-12 * t.along);
    EXPECT_NEAR(t.across, drag + wall.parallel, 1e-12 * t.across);
    EXPECT_NEAR(layer.rhs(0).z(), -0.02 * (uniform ? t.along : drag), 1e-12 * t.along);
  }
}
