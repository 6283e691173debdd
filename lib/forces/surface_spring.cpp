#include "forces/surface_spring.h"

#include <cmath>
#include <limits>

namespace pigment::forces {

SpringForce surface_spring(const FreeSurfaceParameters& p, double a, double h) {
  if (h <= 0 || h >= 2 * a) return {};
  // theta from sin^2(theta/2) = h/2a keeps its digits at small h, where arccos(1 - h/a) loses them.
  const double half = std::asin(std::sqrt(h / (2 * a))), theta = 2 * half, sine = std::sin(theta);
  if (p.elongation == FreeSurfaceParameters::Elongation::Arc) return {2 * a * p.surface_tension * theta, 2 * p.surface_tension / sine};
  const double chord_gain = theta < 1e-3 ? theta * theta * theta / 6 * (1 - theta * theta / 20) : theta - sine;
  return {2 * a * p.surface_tension * chord_gain, 2 * p.surface_tension * std::tan(half)};
}

double rigid_load(const FreeSurfaceParameters& p, double a) {
  if (p.model == FreeSurfaceParameters::Model::Constraint) return std::numeric_limits<double>::infinity();
  return 0.5 * surface_spring(p, a, rigid_protrusion).force;
}

SpringForce lifted_spring(const FreeSurfaceParameters& p, double a, double h) {
  if (h >= rigid_protrusion) return surface_spring(p, a, h);
  const double half = rigid_load(p, a), stiffness = half / rigid_protrusion;
  return {half + stiffness * h, stiffness};
}

double lifted_height(const FreeSurfaceParameters& p, double a, double load) {
  double low = 0.5 * rigid_protrusion, high = a;
  while (high > 1.001 * low) {
    const double middle = std::sqrt(low * high);
    (lifted_spring(p, a, middle).force < load ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

double entry_pressure(const FreeSurfaceParameters& p, const std::vector<double>& radius) {
  if (p.max_pressure) return *p.max_pressure;
  double surface = 0, volume = 0;
  for (double a : radius) {
    surface += 3 * a * a;
    volume += a * a * a;
  }
  return p.surface_tension * surface / volume;
}

}  // namespace pigment::forces
