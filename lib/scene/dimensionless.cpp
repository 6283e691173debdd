#include "scene/dimensionless.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pigment::scene {

double particle_reynolds(double liquid_density, double radius, double velocity, double viscosity) {
  return liquid_density * radius * velocity / viscosity;
}

double peclet(double viscosity, double radius, double length, double velocity, double thermal_energy) {
  return 6 * std::numbers::pi * viscosity * radius * length * velocity / thermal_energy;
}

double colloidal_number(double radius, double viscosity, double velocity, double force) {
  return force == 0 ? std::numeric_limits<double>::infinity() : radius * viscosity * velocity / std::abs(force);
}

EqualPair::EqualPair(const std::vector<forces::ColloidalLaw>& laws, const Liquid& liquid, double radius, double potential)
    : radius_(radius), potential_(potential) {
  for (const forces::ColloidalLaw& law : laws) laws_.push_back({law.name, law.law->prepare(liquid)});
}

double EqualPair::force(double gap) const {
  double sum = 0;
  for (const Law& law : laws_) sum += law.prepared->switched({gap, radius_, radius_, potential_, potential_}).force;
  return sum;
}

double EqualPair::energy(double gap) const {
  double sum = 0;
  for (const Law& law : laws_) sum += law.prepared->switched({gap, radius_, radius_, potential_, potential_}).energy;
  return sum;
}

double EqualPair::law_force(const std::string& name, double gap) const {
  for (const Law& law : laws_)
    if (law.name == name) return law.prepared->switched({gap, radius_, radius_, potential_, potential_}).force;
  return 0;
}

double EqualPair::cutoff() const {
  double longest = 0;
  for (const Law& law : laws_) longest = std::max(longest, law.prepared->cutoff_gap());
  return longest;
}

EqualPair::Landscape EqualPair::landscape() const {
  Landscape found;
  if (laws_.empty()) return found;
  constexpr int points = 4000;
  constexpr double first = 1e-4;  // um
  const double ratio = std::log(cutoff() / first);
  std::vector<Point> curve;
  for (int k = 0; k <= points; ++k) {
    const double gap = first * std::exp(ratio * k / points);
    curve.push_back({gap, energy(gap)});
  }
  // From far out to contact: a barrier is a local maximum; Born repulsion at contact, which only rises, is none.
  std::size_t barrier = 0;
  for (std::size_t k = 1; k + 1 < curve.size(); ++k)
    if (curve[k].energy >= curve[k - 1].energy && curve[k].energy > curve[k + 1].energy &&
        (barrier == 0 || curve[k].energy > curve[barrier].energy))
      barrier = k;
  if (barrier > 0 && curve[barrier].energy > 0) found.barrier = curve[barrier];
  for (std::size_t k = barrier; k < curve.size(); ++k)
    if (curve[k].energy < found.secondary_minimum.energy) found.secondary_minimum = curve[k];
  return found;
}

}  // namespace pigment::scene
