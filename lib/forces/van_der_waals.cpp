// Retarded van der Waals attraction, (19) of [sand2010] after [suzuki1969]:
//   E = -A R lambda/(6 h (lambda + 11.116 h)),   f = dE/dh = -A R lambda (lambda + 22.232 h)/(6 h^2 (lambda + 11.116 h)^2).
// Differs from [sand2010] (19): beta/(1+beta) there lacks a length; R = a1 a2/(a1 + a2) is meant.
#include <algorithm>

#include "forces/pair_law.h"

namespace pigment::forces {

namespace {

struct Formula {
  static constexpr bool concave = true;
  double cutoff_gap, floor_gap;
  double hamaker_constant, wavelength;

  PairTerm operator()(const PairGeometry& g) const {
    const double h = g.gap, scale = hamaker_constant * g.reduced_radius() * wavelength / 6;
    const double c = 11.116;
    const double d = h * (wavelength + c * h), d1 = wavelength + 2 * c * h;  // E = -scale/d
    const double inverse = 1 / d;
    return {-scale * inverse, -scale * d1 * inverse * inverse,
            scale * (2 * c - 2 * d1 * d1 * inverse) * inverse * inverse};
  }
};

struct VanDerWaals {
  double hamaker_constant, london_wavelength, cutoff;

  VanDerWaals(config::Node node, config::Node)
      : hamaker_constant(node.quantity("hamaker_constant", Dimension::Energy, "1e-21 J", config::non_negative())),
        london_wavelength(node.quantity("london_wavelength", Dimension::Length, "100 nm", config::positive())),
        // At 200 nm the force on a 0.5 um pair is 1e-16 N at the default constant, a thousandth of its drag at 10 um/s.
        cutoff(node.quantity("cutoff", Dimension::Length, "200 nm", config::positive())) {}

  Formula prepare(const Liquid&) const {
    // 0.165 nm is the usual cut-off separation of the continuum theory at molecular contact [israelachvili2011].
    return {cutoff, std::min(1.65e-4, 0.1 * cutoff), hamaker_constant, london_wavelength};
  }
};

}  // namespace

PairLawEntry van_der_waals_law() {
  return pair_law<VanDerWaals>("van_der_waals", "retarded van der Waals attraction, (19) [sand2010], [suzuki1969]",
                               "{hamaker_constant: 1e-21 J, london_wavelength: 100 nm}");
}

}  // namespace pigment::forces
