#include "resistance/source_forms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pigment::resistance {

namespace {

using std::numbers::pi;

// Minus the bracket of (12) and (13): positive, 1/(2x) near contact. beta is the centre's height over the radius.
double bracket(double beta) {
  // Beyond a hundred radii it is below 1e-5 and its terms cancel to nothing.
  if (beta > 100) return 0;
  const double b = beta / 2 - beta * beta / (2 * (beta - 1)) - 1 / (4 * beta) - 1 + 1.5 * beta * std::log(beta / (beta - 1));
  return std::max(0.0, -b);
}

constexpr double virtual_sphere = 100;  // radii of the particle

// What moves along the boundary or turns beside it, by a virtual sphere of radius b that neither moves nor turns:
// s = n x U + l W, q = W across n, n = -z, l = a + gap/2.
BoundaryScalars beside(const PairScalars& k, double a, double b, double gap) {
  const PairOperatorScalars o = operator_scalars(k, a, b);
  const double l = a + gap / 2;
  BoundaryScalars w;
  w.parallel = o.a;
  w.coupling = -(o.a * l + o.b);
  w.rolling = o.a * l * l + 2 * o.b * l + o.c;
  w.twist = 0;
  return w;
}

}  // namespace

PairScalars source_pair_scalars(double radius_i, double radius_j, double gap, const LubricationTaper& range) {
  const double R = radius_i * radius_j / (radius_i + radius_j), kap = (radius_i - radius_j) / (radius_i + radius_j);
  const double x = gap / R, log_term = std::log1p(1 / x), y = gap / std::min(radius_i, radius_j);
  PairScalars k;
  k.squeeze = taper(y, range.squeeze_begin, range.squeeze_end) * 6 * pi * R * (1 / x + 0.2 * (1 + 1.25 * (1 - kap * kap)) * log_term);
  const double shear = taper(y, range.shear_begin, range.shear_end);
  k.shear = shear * 2 * pi * R * log_term;
  k.pump = shear * 4.8 * pi * R * R * R * log_term;
  return k;
}

BoundaryScalars source_wall_increment(double a, double gap, const LubricationTaper& range) {
  BoundaryScalars w = beside(source_pair_scalars(a, virtual_sphere * a, gap, range), a, virtual_sphere * a, gap);
  w.perpendicular = 12 * pi * a * bracket(1 + gap / a);
  return w;
}

BoundaryScalars source_corner_increment(double a, double gap, const LubricationTaper& range) {
  const PairScalars k = source_pair_scalars(a, corner_share * a, gap, range);
  BoundaryScalars w = beside(k, a, corner_share * a, gap);
  w.perpendicular = k.squeeze;
  return w;
}

BoundaryScalars source_free_surface_increment(double a, double gap) {
  BoundaryScalars w;
  w.perpendicular = 3 * pi * a * bracket(1 + gap / a);
  return w;
}

}  // namespace pigment::resistance
