// Depletion attraction [asakura1954, vrij1976]: spheres of the depletant, radius r, cannot come nearer to a particle than r.
// Where two such layers overlap, by a volume V, the depletant's osmotic pressure P is missing:
//   E = -P V,   f = -P pi rho^2,   rho the radius of the circle in which the layers' outer spheres meet,
// exact for unequal spheres and for a sphere and the plane. With h the gap, D = a + b + h and s = 2r - h > 0:
//   V     = pi s^2 [(2a + h)(2b + h)/(4 D) + s/6]          the lens of spheres a + r and b + r at distance D
//   rho^2 = s (2D + s) (2a + h)(2b + h)/(4 D^2)
// Valid for hard spheres as depletant, dilute or with P their true osmotic pressure; rods and free polymer coils are like it.
#include <cmath>
#include <numbers>

#include "forces/pair_law.h"

namespace pigment::forces {

namespace {

struct Formula {
  static constexpr bool concave = true;
  double cutoff_gap, floor_gap;
  double reach, pressure;  // reach: 2r

  PairTerm operator()(const PairGeometry& g) const {
    const double h = g.gap, s = reach - h;
    if (s <= 0) return {};
    const double scale = std::numbers::pi * pressure;
    // c = (2a + h)(2b + h)/D and its slope; e = (2D + s)/(4 D) and its slope: both finite for the plane.
    double c, dc, e, de;
    if (std::isinf(g.radius_a) || std::isinf(g.radius_b)) {
      c = 2 * (2 * g.reduced_radius() + h);
      dc = 2;
      e = 0.5;
      de = 0;
    } else {
      const double A = 2 * g.radius_a + h, B = 2 * g.radius_b + h, D = 0.5 * (A + B);
      c = A * B / D;
      dc = 2 - c / D;
      e = 0.5 + s / (4 * D);
      de = -(1 + s / D) / (4 * D);
    }
    return {-scale * s * s * (c / 4 + s / 6), -scale * s * c * e, scale * (s * (dc * e + c * de) - c * e)};
  }
};

struct Depletion {
  double depletant_radius, osmotic_pressure;

  Depletion(config::Node node, config::Node)
      : depletant_radius(node.quantity("depletant_radius", Dimension::Length, config::positive())),
        osmotic_pressure(node.quantity("osmotic_pressure", Dimension::Pressure, config::non_negative())) {}

  // The force ends with zero value at 2r: the switch, from three quarters of the cutoff on, begins beyond it. The formula
  // holds at contact; in overlap it goes on from there.
  Formula prepare(const Liquid&) const {
    return {2.7 * depletant_radius, 0, 2 * depletant_radius, osmotic_pressure};
  }
};

}  // namespace

PairLawEntry depletion_law() {
  return pair_law<Depletion>("depletion", "depletion attraction, overlap of excluded layers [asakura1954, vrij1976]",
                             "{depletant_radius: 5 nm, osmotic_pressure: 10 kPa}");
}

}  // namespace pigment::forces
