// Two spheres without charge attract each other and stay in the primary minimum of van der Waals attraction and Born
// repulsion: at default steps they never overlap, however the steps fall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/one_layer.h"

using namespace pigment;

namespace {

struct Pair {
  stepping::Problem problem;
  Vec3Array position;
};

Pair attracting_pair(const std::string& colloidal, double gap) {
  Pair pair;
  pair.problem = test::empty_problem();
  pair.problem.stepping = {};  // default steps and tolerances
  pair.problem.interactions.surface_potential = {0};
  auto document = config::Document::from_text("colloidal: " + colloidal);
  pair.problem.interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  test::add_particle(pair.problem, pair.position, 0.5, Vec3(50, 50, 50));
  const Vec3 direction = Vec3(1, 2, -0.5).normalized();  // off the axes
  test::add_particle(pair.problem, pair.position, 0.25, Vec3(50, 50, 50) + (0.75 + gap) * direction);
  return pair;
}

double gap_of(const stepping::RunState& state) { return (state.position[1] - state.position[0]).norm() - 0.75; }

// Where attraction (19) and repulsion A sigma^6 R/(180 h^8) are equal, A and R cancelling: bisection in h, um.
double primary_minimum(double collision_diameter, double wavelength) {
  double low = 0.1 * collision_diameter, high = collision_diameter;
  for (int k = 0; k < 200; ++k) {
    const double h = 0.5 * (low + high), c = 11.116;
    const double attraction = wavelength * (wavelength + 2 * c * h) / (6 * h * h * std::pow(wavelength + c * h, 2));
    const double repulsion = std::pow(collision_diameter, 6) / (180 * std::pow(h, 8));
    (repulsion > attraction ? low : high) = h;
  }
  return 0.5 * (low + high);
}

}  // namespace

TEST(Aggregate, SettlesInThePrimaryMinimumWithoutOverlap) {
  const double minimum = primary_minimum(5e-4, 0.1);
  EXPECT_NEAR(minimum, 5e-4 / std::pow(30, 1.0 / 6), 0.01 * minimum);  // unretarded, by hand
  for (const std::string colloidal : {"{van_der_waals: {hamaker_constant: 1e-20 J}, born: {}}",
                                       "{electrostatic: {debye_length: 5 nm}, van_der_waals: {hamaker_constant: 1e-20 J}, born: {}}",
                                       "{electrostatic: {debye_length: 1 nm}, van_der_waals: {hamaker_constant: 1e-19 J}, born: {}}"}) {
    for (double start : {0.02, 0.003}) {
      Pair pair = attracting_pair(colloidal, start);
      stepping::RunState state = stepping::initial_state(pair.problem, pair.position);
      stepping::Stepper stepper(pair.problem, state);
      double smallest = start;
      while (state.time < 500) {
        stepper.advance(state, 500 - state.time);
        smallest = std::min(smallest, gap_of(state));
      }
      EXPECT_GT(smallest, 0) << colloidal << " from " << start;
      EXPECT_NEAR(gap_of(state), minimum, 0.05 * minimum) << colloidal << " from " << start;
    }
  }
}

// Fixed steps, far longer than the last of the approach takes: the averaged resistance still keeps the gap open.
TEST(Aggregate, DoesNotOverlapAtLongFixedSteps) {
  const double minimum = primary_minimum(5e-4, 0.1);
  for (double step : {0.1, 1.0}) {
    Pair pair = attracting_pair("{van_der_waals: {hamaker_constant: 1e-20 J}, born: {}}", 0.01);
    pair.problem.stepping.time_step = step;
    stepping::RunState state = stepping::initial_state(pair.problem, pair.position);
    stepping::Stepper stepper(pair.problem, state);
    while (state.time < 500) {
      stepper.advance(state, step);
      ASSERT_GT(gap_of(state), 0) << "step " << step << " at " << state.time;
    }
    EXPECT_NEAR(gap_of(state), minimum, 0.05 * minimum) << "step " << step;
  }
}

// A heap of attracting spheres shaken by noise: steps as long as the noise allows fail where bonds tear. The step that follows one that failed is
// hardly longer than what came of it, or a quarter of the longest, before its own noise is drawn; and they grow back.
TEST(Aggregate, NoisyStepsRememberThatLongOnesFailed) {
  Pair heap = attracting_pair("{electrostatic: {debye_length: 10 nm}, van_der_waals: {hamaker_constant: 1e-20 J}, born: {}}", 0.01);
  heap.position.clear();
  heap.problem.particles = {};
  for (int k = 0; k < 64; ++k)
    test::add_particle(heap.problem, heap.position, 0.12, Vec3(50 + 0.2402 * (k % 4), 50 + 0.2402 * (k / 4 % 4) + 0.001 * (k % 3), 50 + 0.2402 * (k / 16)));
  heap.problem.interactions.brownian = forces::BrownianParameters{};
  heap.problem.interactions.brownian->model = forces::BrownianParameters::Model::KBrown;
  stepping::RunState state = stepping::initial_state(heap.problem, heap.position);
  stepping::Stepper stepper(heap.problem, state);
  const double longest = stepping::Stepper::first_step(heap.problem);
  int failed = 0, grown = 0;
  double allowed = longest, before = 0;
  for (int step = 0; step < 150; ++step) {
    const stepping::StepReport report = stepper.advance(state, 1e3);
    EXPECT_LE(report.step, allowed * (1 + 1e-12));
    failed += report.rejected > 0;
    grown += report.rejected == 0 && report.step > 1.01 * allowed / 1.02 && allowed < longest;
    // A quarter of the longest at least, but after two steps that came out shorter.
    allowed = std::clamp(1.02 * report.step, std::min(0.25 * longest, std::max(report.step, before)), longest);
    before = report.step;
  }
  EXPECT_GT(failed, 0);
  EXPECT_GT(grown, 0);
}
