// Bridging attraction of polymer whose chains can hold on to two surfaces. An ideal chain of root-mean-square end-to-end distance
// s, one end on a surface, reaches a height z with the Gaussian weight exp(-3 z^2/(2 s^2)) [doi1986]. With its other end on the
// facing surface at gap h instead of on its own it gains the choice of both: free energy -kT ln(1 + exp(-3 h^2/(2 s^2))) a chain.
// Where bridges are few beside loops, and with w = kT times the chains of both surfaces an area,
//   W = -w exp(-3 h^2/(2 s^2))          an area of flat surfaces
//   f = 2 pi R W                         between spheres, by Derjaguin's approximation [israelachvili2011], R = a1 a2/(a1 + a2)
//   E = -2 pi R w s sqrt(pi/6) erfc(sqrt(3/2) h/s).
// Valid for s << R, chains at equilibrium at every gap, and layers thin enough not to crowd each other; that crowding is what
// `steric` adds. Dense brushes bridge by other laws [milner1992]. The unexpanded logarithm would be ln 2 of this at contact.
#include <cmath>
#include <numbers>

#include "forces/pair_law.h"

namespace pigment::forces {

namespace {

struct Formula {
  double cutoff_gap, floor_gap;
  double chain_size, adhesion_energy;

  PairTerm operator()(const PairGeometry& g) const {
    using std::numbers::pi;
    const double h = g.gap, s = chain_size, u = h / s;
    const double scale = 2 * pi * g.reduced_radius() * adhesion_energy, weight = std::exp(-1.5 * u * u);
    return {-scale * s * std::sqrt(pi / 6) * std::erfc(std::sqrt(1.5) * u), -scale * weight, -scale * 3 * u / s * weight};
  }
};

struct Bridging {
  double chain_size, adhesion_energy;

  Bridging(config::Node node, config::Node)
      : chain_size(node.quantity("chain_size", Dimension::Length, config::positive())),
        adhesion_energy(node.quantity("adhesion_energy", Dimension::SurfaceTension, config::non_negative())) {}

  // At 3.2 chain sizes the force is 2e-7 of that at contact, where the switch begins 2e-4. In overlap the force stays what it
  // is at contact.
  Formula prepare(const Liquid&) const { return {3.2 * chain_size, 0, chain_size, adhesion_energy}; }
};

}  // namespace

PairLawEntry bridging_law() {
  return pair_law<Bridging>("bridging", "bridging attraction of adsorbed chains [doi1986], Derjaguin limit",
                            "{chain_size: 10 nm, adhesion_energy: 0.01 mN/m}");
}

}  // namespace pigment::forces
