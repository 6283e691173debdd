// Steric repulsion of adsorbed polymer layers of thickness d, (20)-(22) of [sand2010] after [vincent1986]:
//   osmotic  f = K1 2R (2d - h)            for d < h < 2d
//            f = K1 2R (2 d^2/h - d)       for h <= d
//   elastic  f = K2 2R d ln(4 d^3/(h (h - 3d)^2))   for h < d
// Differs from [sand2010] (21): printed with the opposite sign, attractive; both parts repel in [vincent1986]. The radius a
// of equal spheres becomes 2R = 2 a1 a2/(a1 + a2), and 2a against the plane.
#include <cmath>

#include "forces/pair_law.h"

namespace pigment::forces {

namespace {

struct Formula {
  double cutoff_gap, floor_gap;
  double d, k1, k2;

  PairTerm operator()(const PairGeometry& g) const {
    const double h = g.gap, s = 2 * g.reduced_radius();
    if (h >= 2 * d) return {};
    if (h > d) {
      const double c = 2 * d - h;
      return {0.5 * s * k1 * c * c, s * k1 * c, s * k1};
    }
    const double l = std::log(d / h), u = 3 * d - h, lu = std::log(u / (2 * d));
    // Integrals of the forces from h to d; the elastic one in t: ln 4d^3 - ln t - 2 ln(3d - t).
    const double osmotic = k1 * (0.5 * d * d + 2 * d * d * l - d * (d - h));
    const double elastic = k2 * d * (3 * (d - h) - h * l - 2 * u * lu);
    return {s * (osmotic + elastic), s * (k1 * (2 * d * d / h - d) + k2 * d * (l - 2 * lu)),
            s * (2 * k1 * d * d / (h * h) + k2 * d * (1 / h - 2 / u))};
  }
};

struct Steric {
  double layer_thickness, k1, k2;

  Steric(config::Node node, config::Node)
      : layer_thickness(node.quantity("layer_thickness", Dimension::Length, config::positive())),
        k1(node.quantity("k1", Dimension::Pressure, config::non_negative())),
        k2(node.quantity("k2", Dimension::Pressure, config::non_negative())) {}

  // The force ends with zero value at 2d: the switch begins beyond it. Floor: a twentieth of the layer.
  Formula prepare(const Liquid&) const {
    return {2.7 * layer_thickness, layer_thickness / 20, layer_thickness, k1, k2};
  }
};

}  // namespace

PairLawEntry steric_law() {
  return pair_law<Steric>("steric", "steric repulsion of adsorbed polymer, (20)-(22) [sand2010], [vincent1986]",
                          "{layer_thickness: 5 nm, k1: 1e6 N/m2, k2: 1e6 N/m2}");
}

}  // namespace pigment::forces
