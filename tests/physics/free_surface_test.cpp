// One buoyant sphere that rises to the free surface and stays there.
#include <gtest/gtest.h>

#include <cmath>

#include "forces/surface_spring.h"
#include "support/one_layer.h"

using namespace pigment;

namespace {

// A sphere without mass under `force` pN of buoyancy, 0.01 um below a surface that rests at 10 um.
stepping::Problem buoyant(double force, Vec3Array& position) {
  stepping::Problem problem = test::empty_problem();
  problem.cell.height = 10;
  test::add_particle(problem, position, 0.5, {5, 5, 9.49});
  problem.particles.mass[0] = 0;
  problem.interactions.gravity.emplace();
  problem.interactions.gravity->acceleration = force / (problem.interactions.liquid.density * Particles::sphere_volume(0.5));
  problem.interactions.free_surface.emplace();
  problem.stepping.time_step = 0.5;
  return problem;
}

double height_after(const stepping::Problem& problem, const Vec3Array& position, double time, stepping::StepReport& report) {
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper stepper(problem, state);
  while (state.time < time - 1e-9) report = stepper.advance(state, time - state.time);
  return state.position[0].z();
}

}  // namespace

// The spring beyond the roughness, 2 nm: protrusion where sigma Delta is the force, by bisection on the plain formulas. A tension
// of 1 uN/m, so that 2 pN lift the sphere by far more than what counts as nothing.
TEST(FreeSurface, BuoyantSphereRestsWhereTheSpringBearsIt) {
  for (bool arc : {true, false}) {
    Vec3Array position;
    stepping::Problem problem = buoyant(0.3, position);
    auto& surface = *problem.interactions.free_surface;
    surface.surface_tension = 1;
    surface.elongation = arc ? forces::FreeSurfaceParameters::Elongation::Arc : forces::FreeSurfaceParameters::Elongation::ArcMinusChord;
    double low = 0, high = 0.5;
    for (int k = 0; k < 100; ++k) {
      const double h = 0.5 * (low + high), theta = std::acos(1 - h / 0.5), length = 2 * 0.5 * (arc ? theta : theta - std::sin(theta));
      (1.0 * length < 0.3 ? low : high) = h;
    }
    stepping::StepReport report;
    problem.stepping.time_step = 20;
    const double z = height_after(problem, position, 20000, report);  // thirty relaxation times of frozen resistance and spring
    EXPECT_NEAR(z + 0.5 + 0.002 - 10, low, 1e-5) << arc;
    EXPECT_NEAR(report.pressures.surface * 1e4, 0.3, 1e-4 * 0.3);
    EXPECT_EQ(report.pressures.contacts, 1);
  }
}

// At the tension of water the surface holds the sphere at the roughness, as `constraint` does at any: and bears its force.
TEST(FreeSurface, HoldsAtTheRoughness) {
  using Model = forces::FreeSurfaceParameters::Model;
  for (Model model : {Model::Spring, Model::Constraint}) {
    Vec3Array position;
    stepping::Problem problem = buoyant(2, position);
    problem.interactions.free_surface->model = model;
    if (model == Model::Constraint) problem.interactions.free_surface->surface_tension = 1e-6;
    stepping::StepReport report;
    const double z = height_after(problem, position, 60, report);
    EXPECT_NEAR(z + 0.5, 9.998, 1e-12);
    EXPECT_NEAR(report.pressures.surface * 1e4, 2, 1e-9);
  }
}

// Across the hand-over nothing jumps: the speed of a sphere just below the roughness and just above it, the hydrodynamic term
// frozen there and the spring at its very beginning. 2e-5 um either way, beyond what the surface holds exactly.
TEST(FreeSurface, HandsOverContinuouslyAtTheRoughness) {
  for (bool arc : {true, false}) {
    double speed[2];
    for (int side : {0, 1}) {
      Vec3Array position;
      stepping::Problem problem = buoyant(0.3, position);
      problem.interactions.free_surface->surface_tension = 1e-3;
      if (!arc) problem.interactions.free_surface->elongation = forces::FreeSurfaceParameters::Elongation::ArcMinusChord;
      problem.stepping.time_step = 1e-6;
      position[0].z() = 10 - 0.5 - 0.002 + (side == 0 ? -2e-5 : 2e-5);
      stepping::RunState state = stepping::initial_state(problem, position);
      state.protrusion[0] = side == 0 ? 0 : 2e-5;
      stepping::Stepper stepper(problem, state);
      stepper.advance(state, 1e-6);
      speed[side] = state.velocity[0].z();
    }
    EXPECT_GT(speed[0], 0);
    // Below, the resistance is that of a gap 1 % wider; above, the arc pulls with 2 sigma sqrt(2 a h) = 9e-6 of 0.3 pN.
    EXPECT_NEAR(speed[1] / speed[0], 0.99, 1e-3) << arc;
  }
}
