// Born repulsion of overlapping electron clouds: the r^-12 term of a Lennard-Jones fluid summed over two bodies
// [ruckenstein1976, feke1984], in the Derjaguin limit h << R:
//   E = A sigma^6 R/(1260 h^7),   f = A sigma^6 R/(180 h^8),
// which is their sphere-plate result A sigma^6/7560 [(8a+h)/(2a+h)^7 + (6a-h)/h^7] to leading order with R = a.
// With unretarded van der Waals attraction the energy has its minimum at h = sigma/30^(1/6), -(6/7) A R/(6 h) deep.
// Section 3.3 of [sand2010] calls for a Born force and states none.
#include "forces/pair_law.h"

namespace pigment::forces {

namespace {

struct Formula {
  double cutoff_gap, floor_gap;
  double strength;  // A sigma^6

  PairTerm operator()(const PairGeometry& g) const {
    const double inverse = 1 / g.gap, i2 = inverse * inverse, i4 = i2 * i2, i7 = i4 * i2 * inverse;
    const double s = strength * g.reduced_radius();
    return {s / 1260 * i7, s / 180 * i7 * inverse, s / 22.5 * i7 * i2};
  }
};

struct Born {
  double collision_diameter, hamaker_constant;

  Born(config::Node node, config::Node colloidal)
      : collision_diameter(node.quantity("collision_diameter", Dimension::Length, "0.5 nm", config::positive())),
        hamaker_constant(node.quantity("hamaker_constant", Dimension::Energy, attraction(colloidal), config::positive())) {}

  // Both laws sum the same Lennard-Jones fluid: unless the scene says otherwise they share one Hamaker constant.
  static std::string attraction(config::Node colloidal) {
    if (!colloidal.has("van_der_waals")) return "1e-21 J";
    config::Node van_der_waals = colloidal.block("van_der_waals");
    return van_der_waals.has("hamaker_constant") ? van_der_waals.text("hamaker_constant") : "1e-21 J";
  }

  Formula prepare(const Liquid&) const {
    const double s3 = collision_diameter * collision_diameter * collision_diameter;
    // Floor: at a quarter of the collision diameter repulsion is 136 times the attraction, and it stays so in overlap.
    return {4 * collision_diameter, collision_diameter / 4, hamaker_constant * s3 * s3};
  }
};

}  // namespace

PairLawEntry born_law() {
  return pair_law<Born>("born", "Born repulsion [ruckenstein1976, feke1984], Derjaguin limit", "{collision_diameter: 0.5 nm}");
}

}  // namespace pigment::forces
