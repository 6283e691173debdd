#include "forces/surface_spring.h"

#include <cmath>

namespace pigment::forces {

SpringForce surface_spring(const FreeSurfaceParameters& p, double a, double h) {
  if (h <= 0 || h >= 2 * a) return {};
  const SpringForce line{constraint_stiffness * h, constraint_stiffness};
  if (p.model == FreeSurfaceParameters::Model::Constraint) return line;
  // theta from sin^2(theta/2) = h/2a keeps its digits at small h, where arccos(1 - h/a) loses them.
  const double half = std::asin(std::sqrt(h / (2 * a))), theta = 2 * half, sine = std::sin(theta);
  if (p.elongation == FreeSurfaceParameters::Elongation::Arc) {
    const double force = 2 * a * p.surface_tension * theta;
    if (line.force < force) return line;
    return {force, 2 * p.surface_tension / sine};
  }
  const double chord_gain = theta < 1e-3 ? theta * theta * theta / 6 * (1 - theta * theta / 20) : theta - sine;
  return {2 * a * p.surface_tension * chord_gain, 2 * p.surface_tension * std::tan(half)};
}

}  // namespace pigment::forces
