#include "stepping/stationary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "model/dewatering_curve.h"
#include "support/one_layer.h"
#include "stepping/consolidate.h"

using namespace pigment;

namespace {

// A mass centre that relaxes from 2 to 1 um with the given time, and noise, both in frames and um.
std::deque<double> relaxing(double time, double noise, int frames, std::uint64_t seed) {
  std::deque<double> height;
  for (int k = 0; k < frames; ++k)
    height.push_back(1 + std::exp(-k / time) + noise * random_normals({seed, Stream::Tests}, static_cast<std::uint64_t>(k))[0]);
  return height;
}

}  // namespace

TEST(Stationary, WhatStillDriftsIsNot) {
  // Means of windows of 50 frames 0.2 apart, then less than e^-10.
  EXPECT_FALSE(stepping::is_stationary(relaxing(100, 0.01, 100, 1), 50, 0.02));
  EXPECT_TRUE(stepping::is_stationary(relaxing(100, 0.01, 1200, 1), 50, 0.02));
}

TEST(Stationary, WhatNoiseHidesIsNot) {
  // No drift, but blocks of 10 frames whose means scatter by 0.3/sqrt(10): the difference of two windows has a standard error of 0.06.
  EXPECT_FALSE(stepping::is_stationary(relaxing(1, 0.3, 1000, 2), 50, 0.02));
}

TEST(Stationary, NeedsTwoWindows) {
  EXPECT_FALSE(stepping::is_stationary(std::deque<double>(9, 1.0), 5, 0.02));
  EXPECT_TRUE(stepping::is_stationary(std::deque<double>(10, 1.0), 5, 0.02));
}

// At the limit itself, a drift of just the tolerance, it says yes in at most 5 % of cases (2.3 % by Gauss's law; eight degrees
// of freedom make it 4 %): of 400, more than 35 have a chance of 1e-4.
TEST(Stationary, FalseAlarmsAreFew) {
  int yes = 0;
  for (std::uint64_t s = 0; s < 400; ++s) {
    std::deque<double> height;
    for (int k = 0; k < 100; ++k) height.push_back((k < 50 ? 1 / 1.02 : 1.0) + 0.02 * random_normals({s, Stream::Tests}, static_cast<std::uint64_t>(k))[0]);
    yes += stepping::is_stationary(height, 50, 1 - 1 / 1.02);
  }
  EXPECT_LE(yes, 35);
}

TEST(DewateringCurve, SteadyFromItsLastChangeOn) {
  DewateringCurve curve;
  EXPECT_EQ(curve.steady_from(), 0);
  curve.time = {0, 10, 10, 50, 300};
  curve.absorption_flux = {0.1, 0.1, 0.01, 0.01, 0.01};
  curve.evaporation_flux = {0, 0, 0, 0, 0};
  EXPECT_EQ(curve.steady_from(), 10);
  curve.temperature = {293, 293, 293, 313, 313};
  EXPECT_EQ(curve.steady_from(), 50);
  curve.evaporation_flux = {0, 0, 0, 0, 1};
  EXPECT_EQ(curve.steady_from(), 300);
}

// A sphere that hangs in resting liquid: stationary after two windows from the end of the flow on, not before.
TEST(Stationary, EndsARunAfterTheFlowHasChanged) {
  stepping::Problem problem = test::empty_problem();
  problem.cell = {4, 4, 4};
  Vec3Array position;
  test::add_particle(problem, position, 0.5, Vec3(2, 2, 3));
  problem.dewatering.time = {0, 20, 20, 400};
  problem.dewatering.absorption_flux = {0.01, 0.01, 0, 0};
  problem.dewatering.evaporation_flux = {0, 0, 0, 0};
  problem.stepping.stop_when = stepping::SteppingParameters::StopWhen::Stationary;
  problem.stepping.stationary_window = 10;
  problem.stepping.time_step = 1;
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::RunCallbacks callbacks;
  callbacks.on_frame = [](const stepping::RunState&, double, const std::vector<double>&) {};
  EXPECT_EQ(stepping::consolidate(problem, {1, 400}, state, callbacks), "stationary");
  EXPECT_EQ(state.time, 39);  // frames at 20..39
}
