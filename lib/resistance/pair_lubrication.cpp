#include "resistance/pair_lubrication.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pigment::resistance {

namespace {

using std::numbers::pi;

// r-coefficients c_i(k2) = sum_j p_j k2^j, k2 = kap^2: fitted to data/resistance/relative_K_basis.csv.
constexpr double kn_fit[5][6] = {
    {+6.6814708e-01, -1.9446321e+00, +2.2386862e+00, -1.4185070e+00, +4.5564947e-01, -2.8230012e-02},
    {-3.2434736e-01, -3.4278897e+00, +1.6326388e+01, -2.9855353e+01, +2.6587506e+01, -9.2551483e+00},
    {+2.6876856e+00, +5.7759925e+00, -4.1676591e+01, +7.9755122e+01, -7.1781835e+01, +2.5109288e+01},
    {-1.4184526e+00, -1.3677673e+01, +6.0010935e+01, -1.0317380e+02, +8.8981187e+01, -3.0595875e+01},
    {+1.5350960e+00, -6.6825650e-01, -5.5072947e+00, +9.2222506e+00, -6.6559983e+00, +2.0053772e+00}};
constexpr double ks_fit[3][6] = {
    {+3.2722856e-01, -1.1997859e+00, -2.2068851e+00, +4.0576310e+00, -2.7061023e+00, +6.7866859e-01},
    {-1.2858814e-01, +9.7820144e-01, -1.0705982e+00, +1.7143609e+00, -1.5847745e+00, +5.7928779e-01},
    {-2.9751576e-01, -1.2674936e-01, +3.0261040e+00, -6.0542570e+00, +5.4570661e+00, -1.8674320e+00}};
constexpr double kp_fit[3][6] = {
    {-1.2783037e+00, +9.2225815e+00, -2.3039515e+01, +2.5343103e+01, -1.3732798e+01, +3.0224709e+00},
    {+4.2364300e-01, +6.4522343e-01, +1.8185759e-01, -1.4323914e+00, +2.0133145e+00, -8.5997687e-01},
    {+2.9319418e-01, -2.3720099e+00, +1.6190055e+01, -3.3391856e+01, +2.7945159e+01, -8.4544502e+00}};
constexpr double ksp_fit[3][6] = {
    {-1.1618024e+01, +1.6183675e+01, +6.1020309e-01, -2.2234263e+01, +2.1355064e+01, -6.6777240e+00},
    {+2.0970676e+00, -5.1819132e+00, +1.5991604e+01, -2.7552160e+01, +2.3855727e+01, -8.0259536e+00},
    {+4.3196609e+00, -7.1156860e+00, -8.1458795e+00, +4.2198250e+01, -4.8473225e+01, +1.8175578e+01}};
constexpr double kt_fit[5][6] = {
    {+8.0177171e-01, -4.2312509e+00, +1.4355816e+01, -2.5057655e+01, +2.1275089e+01, -6.9457645e+00},
    {-3.5174704e-01, -1.0840997e+00, +3.9035147e+00, -6.8168314e+00, +5.7887051e+00, -1.9023842e+00},
    {+1.5308375e+00, -4.5936217e+00, +1.5124738e+01, -2.6069464e+01, +2.1961621e+01, -7.0946416e+00},
    {+1.0787131e-01, -9.1938053e+00, +3.2478501e+01, -5.6152121e+01, +4.7156893e+01, -1.5328122e+01},
    {+1.0755797e-01, +2.1747357e-02, -1.4410214e+00, +3.4995990e+00, -3.2853635e+00, +1.1188270e+00}};

double polynomial(const double (&p)[6], double y) {
  return p[0] + y * (p[1] + y * (p[2] + y * (p[3] + y * (p[4] + y * p[5]))));
}
double three_terms(const double (&fit)[3][6], double k2, double x, double x_log) {
  return polynomial(fit[0], k2) + polynomial(fit[1], k2) * x_log + polynomial(fit[2], k2) * x;
}
double five_terms(const double (&fit)[5][6], double k2, double x, double x_log) {
  const double cube = (1 + x) * (1 + x) * (1 + x);
  return (polynomial(fit[0], k2) + polynomial(fit[1], k2) * x_log + polynomial(fit[2], k2) * x +
          polynomial(fit[3], k2) * x * x_log + polynomial(fit[4], k2) * x * x) / cube;
}

struct Shape {
  double reduced_radius, kap;
};
Shape shape_of(double radius_i, double radius_j) {
  if (std::isinf(radius_j)) return {radius_i, -1};
  if (std::isinf(radius_i)) return {radius_j, +1};
  const double sum = radius_i + radius_j;
  return {radius_i * radius_j / sum, (radius_i - radius_j) / sum};
}

}  // namespace

double taper(double y, double begin, double end) {
  if (y <= begin) return 1;
  if (y >= end) return 0;
  const double t = (y - begin) / (end - begin);
  return 1 - t * t * t * (10 - 15 * t + 6 * t * t);
}

double hydrodynamic_gap(double gap, double smaller_radius) { return std::max(gap, 1e-6 * smaller_radius); }

PairScalars pair_scalars(double radius_i, double radius_j, double gap) {
  return tapered_pair_scalars(radius_i, radius_j, gap, no_taper);
}

PairScalars tapered_pair_scalars(double radius_i, double radius_j, double gap, const LubricationTaper& range) {
  const double smaller = std::min(radius_i, radius_j);
  const double squeeze_weight = taper(gap / smaller, range.squeeze_begin, range.squeeze_end);
  PairScalars k;
  if (squeeze_weight == 0) return k;
  const auto [R, kap] = shape_of(radius_i, radius_j);
  // Not log1p, which is slow: where a pair still resists, 1/x is never small.
  const double x = gap / R, log_term = std::log(1 + 1 / x), x_log = x * log_term, k2 = kap * kap;
  const double squeeze_log = 0.2 * (1 + 1.25 * (1 - k2));
  k.squeeze = squeeze_weight * 6 * pi * R * (1 / x + squeeze_log * log_term + five_terms(kn_fit, k2, x, x_log));
  const double shear_weight = taper(gap / smaller, range.shear_begin, range.shear_end);
  if (shear_weight == 0) return k;
  k.shear = shear_weight * 2 * pi * R * (log_term + three_terms(ks_fit, k2, x, x_log));
  k.pump = shear_weight * 4.8 * pi * R * R * R * (log_term + three_terms(kp_fit, k2, x, x_log));
  k.shear_pump = shear_weight * pi * R * R * kap * three_terms(ksp_fit, k2, x, x_log);
  // Twist is small and never singular; it shares the taper of the shear block, so that beyond it nothing couples to
  // rotation.
  k.twist = shear_weight * 8 * pi * R * R * R * five_terms(kt_fit, k2, x, x_log);
  return k;
}

PairOperatorScalars operator_scalars(const PairScalars& k, double radius_i, double radius_j) {
  const auto [R, kap] = shape_of(radius_i, radius_j);
  const double t = kap / (2 * R);
  return {k.squeeze, k.twist, k.shear + t * (t * k.pump - 2 * k.shear_pump), t * k.pump - k.shear_pump, k.pump};
}

double squeeze_constant(double R) { return 6 * pi * R * R; }

SqueezeStep squeeze_step(double R, double gap_begin, double gap_guess) {
  const double c = squeeze_constant(R), y = (gap_begin - gap_guess) / gap_guess;  // h0/g = 1 + y
  // ln(1 + y) - y, by its series where y is small, to keep all digits.
  const double rest = std::abs(y) < 1e-4 ? y * y * (-0.5 + y / 3) : std::log1p(y) - y;
  return {c * y / gap_begin, c * rest};
}

SqueezeStep squeeze_step(double R, double gap_begin, double gap_guess, double gap_at) {
  const SqueezeStep s = squeeze_step(R, gap_begin, gap_guess);
  return {s.coefficient + squeeze_constant(R) * (1 / gap_begin - 1 / gap_at), s.impulse};
}

}  // namespace pigment::resistance
