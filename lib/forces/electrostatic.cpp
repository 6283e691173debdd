// Double-layer repulsion at constant potential.
//   equal potentials, (17) of [sand2010]: E = 4 pi eps R psi^2 ln(1 + exp(-kappa h))
//   otherwise [hogg1966]: E = pi eps R [2 psi1 psi2 ln((1+e)/(1-e)) + (psi1^2 + psi2^2) ln(1 - e^2)], e = exp(-kappa h),
// which reduces to the former at equal potentials and turns attractive near contact where they differ, same sign included.
// R = a1 a2/(a1 + a2), h the gap, 1/kappa the Debye length. Valid for kappa a >> 1 and potentials up to about 60 mV.
// Differs from [sand2010] (17): there psi1 psi2 stands for psi^2 whatever the two are, which is not a constant-potential form.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/units.h"
#include "forces/pair_law.h"

namespace pigment::forces {

namespace {

struct Formula {
  double cutoff_gap, floor_gap;
  double kappa, permittivity;

  PairTerm operator()(const PairGeometry& g) const {
    const double e = std::exp(-kappa * g.gap), sum = g.potential_a + g.potential_b, difference = g.potential_a - g.potential_b;
    PairTerm term = forces(g, e);
    // In terms of sum and difference: E = scale [ (p1+p2)^2 ln(1+e) + (p1-p2)^2 ln(1-e) ].
    term.energy = sum * sum * std::log1p(e);
    if (difference != 0) term.energy += difference * difference * std::log1p(-e);
    term.energy *= scale(g);
    return term;
  }
  PairTerm without_energy(const PairGeometry& g) const { return forces(g, std::exp(-kappa * g.gap)); }

 private:
  double scale(const PairGeometry& g) const { return std::numbers::pi * permittivity * g.reduced_radius(); }
  PairTerm forces(const PairGeometry& g, double e) const {
    const double p1 = g.potential_a, p2 = g.potential_b, s = scale(g);
    if (p1 == p2) {
      const double all = 4 * s * p1 * p1, share = e / (1 + e);
      return {0, all * kappa * share, all * kappa * kappa * share / (1 + e)};
    }
    const double plus = (p1 + p2) * (p1 + p2), minus = (p1 - p2) * (p1 - p2);
    const double up = e / (1 + e), down = e / (1 - e);
    return {0, s * kappa * (plus * up - minus * down), s * kappa * kappa * (plus * up / (1 + e) - minus * down / (1 - e))};
  }
};

struct Electrostatic {
  std::optional<double> debye_length;            // um
  double valence = 1, concentration = 0;         // concentration in mol/m3

  Electrostatic(config::Node node, config::Node) {
    if (node.has("debye_length") || !node.has("electrolyte")) {
      debye_length = node.quantity("debye_length", Dimension::Length, config::positive());
      if (node.has("electrolyte")) node.error("electrolyte", "give debye_length or electrolyte, not both");
    } else {
      config::Node electrolyte = node.block("electrolyte");
      valence = electrolyte.number("valence", 1, config::positive());
      concentration = electrolyte.quantity("concentration", Dimension::Concentration, config::positive());
    }
  }
  // Symmetric z:z electrolyte: kappa^2 = 2 e^2 z^2 N_A c/(eps kT). Differs from [sand2010] (18), whose coefficients hold at
  // 25 degC only and whose asymmetric branch carries a |z| too many.
  double kappa(const Liquid& liquid) const {
    if (debye_length) return 1 / *debye_length;
    using namespace constants;
    const double charge = elementary_charge_si * valence;
    const double permittivity_si = liquid.relative_permittivity * vacuum_permittivity_si;
    const double kappa_si = std::sqrt(2 * charge * charge * avogadro_si * concentration /
                                      (permittivity_si * boltzmann_si * liquid.temperature));
    return kappa_si * 1e-6;
  }
  Formula prepare(const Liquid& liquid) const {
    const double k = kappa(liquid);
    // At 20 Debye lengths the force is 2e-9 of that at contact. Unequal potentials diverge at contact: floor at 0.1 nm,
    // where the continuum double layer has long lost its meaning.
    return {20 / k, std::min(1e-4, 0.1 / k), k, liquid.permittivity()};
  }
};

}  // namespace

PairLawEntry electrostatic_law() {
  return pair_law<Electrostatic>("electrostatic", "double-layer repulsion at constant potential, (17) [sand2010], [hogg1966]",
                                 "{debye_length: 5 nm}");
}

}  // namespace pigment::forces
