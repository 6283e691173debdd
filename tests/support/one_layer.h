#pragma once
// Small problems for the stepper, made by hand.
#include "stepping/stepper.h"

namespace pigment::test {

inline stepping::Problem empty_problem() {
  stepping::Problem problem;
  problem.interactions.surface_potential = {-25};
  problem.cell = {100, 100, 100};
  problem.stepping.solver_tolerance = 1e-12;
  return problem;
}

inline void add_particle(stepping::Problem& problem, Vec3Array& position, double radius, Vec3 at) {
  problem.particles.radius.push_back(radius);
  problem.particles.mass.push_back(2.7e-3 * Particles::sphere_volume(radius));
  problem.particles.species.push_back(0);
  problem.particles.id.push_back(static_cast<std::int64_t>(position.size()));
  position.push_back(at);
}

// A constant absorption flux (um/ms) for a long time.
inline DewateringCurve steady_absorption(double flux) {
  DewateringCurve curve;
  curve.time = {0, 1e6};
  curve.absorption_flux = {flux, flux};
  curve.evaporation_flux = {0, 0};
  return curve;
}

}  // namespace pigment::test
