// A temperature that changes during a run acts on all that depends on it, at once: viscosity, permittivity, both noises.
#include <gtest/gtest.h>

#include <cmath>

#include "support/one_layer.h"

using namespace pigment;

namespace {

constexpr double pi = 3.14159265358979323846, cold = 293.15, hot = 353.15, jump = 8;  // K, ms

// Steps end at multiples of 0.25 ms, so that none straddles the jump.
stepping::Problem problem_with_jump() {
  stepping::Problem problem = test::empty_problem();
  problem.dewatering.time = {0, jump, jump, 1000};
  problem.dewatering.absorption_flux = problem.dewatering.evaporation_flux = {0, 0, 0, 0};
  problem.dewatering.temperature = {cold, cold, hot, hot};
  problem.interactions.hydrodynamics.model = resistance::HydrodynamicsParameters::Model::Drag;
  problem.stepping.time_step = 0.25;
  return problem;
}

}  // namespace

// Two spheres that a double layer of given length drives apart: their speed is F/(6 pi mu a) each, F in proportion to the permittivity. Both
// are known at both temperatures: water at 0.1 MPa has 1.0016 and 0.3544 mPa s, 80.2 and 60.8 [patek2009]. 1 % for the gap that changes
// within the step, and for the three digits of the values.
TEST(Temperature, ChangesViscosityAndPermittivity) {
  stepping::Problem problem = problem_with_jump();
  problem.interactions.surface_potential = {-5};
  auto document = config::Document::from_text("colloidal: {electrostatic: {debye_length: 10 nm}}");
  problem.interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  problem.stepping.time_step = 1e-3;
  problem.stepping.integrator = stepping::SteppingParameters::Integrator::NewtonImplicit;  // its velocity owes nothing to the step before
  constexpr double a = 1, kappa = 100;
  Vec3Array position;
  test::add_particle(problem, position, a, Vec3(50, 50, 50));
  test::add_particle(problem, position, a, Vec3(52.03, 50, 50));
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper stepper(problem, state);
  const auto check = [&](double viscosity, double relative_permittivity) {
    const double gap = state.position[1].x() - state.position[0].x() - 2 * a, e = std::exp(-kappa * gap);
    stepper.advance(state, 1e-3);
    const double force = 2 * pi * relative_permittivity * 8.8541878e-6 * a * 25 * kappa * e / (1 + e);  // (17)
    EXPECT_NEAR(state.velocity[1].x(), force / (6 * pi * viscosity * a), 0.01 * state.velocity[1].x());
  };
  check(1.0016, 80.2);
  state.time = jump;
  check(0.3544, 60.8);
}

// <dx^2> = 2 kT t/(6 pi mu a) on either side of the jump, under either noise. The mean square of n independent Gaussian displacements has a
// relative standard error of sqrt(2/n); k_brown's, sums of eight uniform ones, scatter less. Four standard errors, four checks: 2.4e-4.
TEST(Temperature, ChangesTheNoise) {
  for (const auto model : {forces::BrownianParameters::Model::KBrown, forces::BrownianParameters::Model::FluctuationDissipation}) {
    stepping::Problem problem = problem_with_jump();
    problem.cell = {400, 400, 400};
    problem.interactions.brownian.emplace();
    problem.interactions.brownian->model = model;
    constexpr int count = 400;
    constexpr double a = 0.25;
    Vec3Array position;
    for (int k = 0; k < count; ++k) test::add_particle(problem, position, a, Vec3(20.0 * (k % 20), 20.0 * (k / 20), 200));
    stepping::RunState state = stepping::initial_state(problem, position);
    stepping::Stepper stepper(problem, state);
    double square[2] = {};
    constexpr int windows = 4;  // of 2 ms, on each side
    for (int w = 0; w < 2 * windows; ++w) {
      const Vec3Array before = state.position;
      for (int s = 0; s < 8; ++s) stepper.advance(state, 0.25);
      for (std::size_t k = 0; k < before.size(); ++k) square[w / windows] += (state.position[k] - before[k]).squaredNorm();
    }
    EXPECT_NEAR(state.time, 2 * jump, 1e-9);
    constexpr double n = 3.0 * count * windows;
    const double kT[2] = {1.380649e-5 * cold, 1.380649e-5 * hot}, viscosity[2] = {1.0016, 0.3544};
    for (int side : {0, 1}) {
      const double expected = 2 * kT[side] * 2 / (6 * pi * viscosity[side] * a);
      EXPECT_NEAR(square[side] / n, expected, 4 * std::sqrt(2 / n) * expected) << "side " << side;
    }
  }
}
