#include "stepping/step_control.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pigment;

// Local error of a first-order method goes with dt^2: an error of 1 (the tolerance) keeps a tenth in hand, an error of 4 asks
// for half the step; never more than 1.5 times, never less than 0.3 times.
TEST(StepControl, NextStepFollowsTheSquareRootOfTheError) {
  EXPECT_DOUBLE_EQ(stepping::next_step(2, 1), 1.8);
  EXPECT_DOUBLE_EQ(stepping::next_step(2, 4), 0.9);
  EXPECT_DOUBLE_EQ(stepping::next_step(2, 0.01), 3);
  EXPECT_DOUBLE_EQ(stepping::next_step(2, 0), 3);
  EXPECT_DOUBLE_EQ(stepping::next_step(2, 1e6), 0.6);
}

TEST(StepControl, GapScaleIsTheDebyeLengthOrAMolecule) {
  assembly::Interactions interactions;
  const Liquid liquid = liquid_at({}, 298.15);
  EXPECT_DOUBLE_EQ(stepping::gap_scale(interactions, liquid), 5e-4);
  auto document = config::Document::from_text("colloidal: {van_der_waals: {}, electrostatic: {debye_length: 7 nm}}");
  interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  EXPECT_NEAR(stepping::gap_scale(interactions, liquid), 7e-3, 1e-15);
}

// The smallest free sphere diffuses by three times the root of two Debye lengths a component: sqrt(2 D dt), D = kT/(6 pi mu a), in SI by hand.
TEST(StepControl, BrownianStepIsThreeRootTwoDebyeLengthsOfTheSmallestSphere) {
  Particles particles;
  particles.radius = {0.8, 0.2, 0.5};
  LiquidParameters parameters;
  parameters.viscosity = 1;
  const double dt = 1e-3 * stepping::brownian_step(particles, liquid_at(parameters, 298.15), 0.005);  // s
  const double diffusivity = 1.380649e-23 * 298.15 / (6 * M_PI * 1e-3 * 0.2e-6);
  EXPECT_NEAR(std::sqrt(diffusivity * dt), 15e-9, 1e-9 * 15e-9);
}
