// One sphere in moving liquid: in the open, and above the substrate.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/one_layer.h"
#include "support/table.h"

using namespace pigment;

// (10) alone: the sphere is carried by the liquid, whatever the step. 1e-10 relative is the rounding of 1,000 steps.
TEST(LoneSphere, MovesWithTheAbsorbingLiquid) {
  stepping::Problem problem = test::empty_problem();
  Vec3Array position;
  test::add_particle(problem, position, 0.5, Vec3(50, 50, 90));
  const double q = 0.010;  // 10 um/s
  problem.dewatering = test::steady_absorption(q);
  problem.stepping.time_step = 1.0;
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper stepper(problem, state);
  for (int s = 0; s < 1000; ++s) stepper.advance(state, 1.0);
  EXPECT_NEAR(state.position[0].z(), 90 - q * 1000, 1e-10 * 10);
  EXPECT_EQ(state.position[0].x(), 50);
  EXPECT_NEAR(state.velocity[0].z(), -q, 1e-10 * q);
}

// Ten steps of 0.1 ms make a millisecond, though 0.1 is no binary number and ten of them fall short of it by rounding.
TEST(LoneSphere, TakesAsManyFixedStepsAsFitIntoAnInterval) {
  stepping::Problem problem = test::empty_problem();
  Vec3Array position;
  test::add_particle(problem, position, 0.5, Vec3(50, 50, 90));
  problem.stepping.time_step = 0.1;
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper stepper(problem, state);
  for (int frame = 1; frame <= 5; ++frame)
    while (state.time < frame) EXPECT_NEAR(stepper.advance(state, frame - state.time).step, 0.1, 1e-12);
  EXPECT_EQ(state.step, 50);
}

// Above the substrate it moves at q/f(h): the exact f of the table (bispherical coordinates), 0.2 % asked for.
TEST(LoneSphere, SlowsDownAboveTheSubstrateAsTheExactSolutionSays) {
  const auto table = test::read_table("wall_resistance.csv");
  for (std::size_t k = 0; k < table.at("gap_over_a").size(); ++k) {
    stepping::Problem problem = test::empty_problem();
    problem.interactions.substrate.emplace();
    Vec3Array position;
    const double a = 0.5, gap = table.at("gap_over_a")[k] * a;
    test::add_particle(problem, position, a, Vec3(50, 50, a + gap));
    const double q = 0.010;
    problem.dewatering = test::steady_absorption(q);
    problem.stepping.time_step = 1e-4 * gap / q;  // so short that the gap does not change
    stepping::RunState state = stepping::initial_state(problem, position);
    stepping::Stepper(problem, state).advance(state, 1.0);
    EXPECT_NEAR(-state.velocity[0].z(), q / table.at("F_perp")[k], 0.002 * q / table.at("F_perp")[k]) << "gap/a " << gap / a;
  }
}

TEST(LoneSphere, UniformSuctionDrawsItOntoTheSubstrateAtTheLiquidsSpeed) {
  stepping::Problem problem = test::empty_problem();
  problem.interactions.substrate.emplace();
  problem.interactions.substrate->suction = forces::SubstrateParameters::Suction::Uniform;
  Vec3Array position;
  test::add_particle(problem, position, 0.5, Vec3(50, 50, 0.51));
  problem.dewatering = test::steady_absorption(0.010);
  problem.stepping.time_step = 1e-3;
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper(problem, state).advance(state, 1.0);
  EXPECT_NEAR(state.velocity[0].z(), -0.010, 1e-12);
}

TEST(LoneSphere, SettlesAtStokesSpeed) {
  stepping::Problem problem = test::empty_problem();
  problem.interactions.gravity.emplace();
  Vec3Array position;
  test::add_particle(problem, position, 1.0, Vec3(50, 50, 50));
  problem.stepping.time_step = 1.0;
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper(problem, state).advance(state, 1.0);
  // 2 a^2 (rho_s - rho_l) g/(9 mu), by hand in SI at 25 degC: 2 * 1e-12 * 1700 * 9.81/(9 * 8.900e-4) = 4.164e-6 m/s.
  EXPECT_NEAR(-state.velocity[0].z(), 4.164e-3, 0.002e-3);
}
