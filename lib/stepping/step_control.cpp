#include "stepping/step_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pigment::stepping {

namespace {
// A particle about to tear from its bonds is held by next to nothing, and what a solve leaves undone throws it about: from 1,555 passes of
// Newton's method to 1,080 in an uncharged layer of 4,700 particles.
constexpr double tighter_among_bonds = 0.03;
}  // namespace

double gap_scale(const assembly::Interactions& interactions, const Liquid& liquid) {
  for (const auto& [name, law] : interactions.colloidal)
    if (name == "electrostatic") return law->prepare(liquid)->cutoff_gap() / 20;  // its cutoff is 20 Debye lengths
  return 5e-4;
}

double brownian_step(const Particles& particles, const Liquid& liquid, double scale) {
  const double smallest = *std::min_element(particles.radius.begin(), particles.radius.end());
  const double diffusivity = liquid.thermal_energy() / (6 * std::numbers::pi * liquid.viscosity * smallest);
  return 9 * scale * scale / diffusivity;
}

double solver_tolerance(const SteppingParameters& p, bool noisy, bool bonds) {
  return p.solver_tolerance.value_or((bonds ? tighter_among_bonds : 1) * (noisy ? 1e-3 : std::clamp(0.1 * p.tolerance, 1e-8, 1e-3)));
}

double thermal_step(const Particles& particles, const Liquid& liquid, double scale, bool lubrication) {
  const double smallest = *std::min_element(particles.radius.begin(), particles.radius.end());
  if (!lubrication) return brownian_step(particles, liquid, scale) / 72;
  const double reduced = 0.5 * smallest;
  return 0.25 * scale * 6 * std::numbers::pi * liquid.viscosity * reduced * reduced / liquid.thermal_energy();
}

double next_step(double step, double error) {
  const double wanted = error > 0 ? 0.9 / std::sqrt(error) : 1.5;
  return step * std::clamp(wanted, 0.3, 1.5);
}

}  // namespace pigment::stepping
