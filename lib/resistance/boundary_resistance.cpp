#include "resistance/boundary_resistance.h"

#include <cmath>
#include <numbers>

#include "resistance/pair_lubrication.h"

namespace pigment::resistance {

namespace {

using std::numbers::pi;

// g(x) = lead L (1+x)^(1-m) + (c0 + c1 x L + c2 x + c3 x^2 L + c4 x^2)/(1+x)^(m+2), L = ln(1 + 1/x), x = gap/radius:
// lubrication logarithm with its known coefficient, far field decaying as its known power x^-m.
struct Fit {
  double lead;
  int m;
  double c[5];
};
constexpr Fit wall_perpendicular{1.0 / 5, 1, {-0.03035804, +0.089493082, -0.23338224, +0.24799837, -0.074713957}};
constexpr Fit wall_parallel{8.0 / 15, 1, {-0.045704961, +0.1649668, -0.21032339, +0.31238721, +0.029954786}};
constexpr Fit wall_rolling{2.0 / 5, 3, {-0.6287719, +1.1911804, -2.5534465, +2.3403948, -0.14205172}};
constexpr Fit wall_coupling{-2.0 / 15, 4, {+0.25713496, -0.56341609, +1.2185125, -1.1932769, +0.051779391}};
constexpr Fit wall_twist{0, 3, {+0.20199262, -0.43791586, +1.1384918, -1.0029756, +0.16503692}};
constexpr Fit surface_perpendicular{9.0 / 20, 1, {+0.03352017, +0.10706843, -0.029879062, +0.21667323, +0.050148289}};
constexpr Fit surface_parallel{0, 1, {-0.27535315, +0.0074200561, -0.68396991, +0.052210433, -0.37162829}};
constexpr Fit surface_rolling{3.0 / 20, 3, {-0.37361911, +0.50886731, -1.4476179, +1.0690162, -0.23808486}};
constexpr Fit surface_coupling{0, 2, {+0.1582114, -0.0045807835, +0.4507846, -0.031367897, +0.24654037}};
constexpr Fit surface_twist{0, 3, {-0.098463382, +0.004784115, -0.30546521, +0.038194572, -0.11711226}};

double power(double base, int exponent) {
  double result = 1;
  for (; exponent > 0; --exponent) result *= base;
  return result;
}
double value(const Fit& f, double x, double log_term) {
  const double x_log = x * log_term;
  return f.lead * log_term / power(1 + x, f.m - 1) +
         (f.c[0] + f.c[1] * x_log + x * (f.c[2] + f.c[3] * x_log + f.c[4] * x)) / power(1 + x, f.m + 2);
}

}  // namespace

double stokes_drag(double a) { return 6 * pi * a; }
double stokes_torque(double a) { return 8 * pi * a * a * a; }

BoundaryScalars wall_increment(double a, double gap) {
  const double x = gap / a, log_term = std::log1p(1 / x);
  return {stokes_drag(a) * (1 / x + value(wall_perpendicular, x, log_term)),
          stokes_drag(a) * value(wall_parallel, x, log_term), 6 * pi * a * a * value(wall_coupling, x, log_term),
          stokes_torque(a) * value(wall_twist, x, log_term), stokes_torque(a) * value(wall_rolling, x, log_term)};
}

BoundaryScalars free_surface_increment(double a, double gap) {
  const double x = gap / a, log_term = std::log1p(1 / x);
  // The table's coupling holds for a surface below the sphere; reflected to lie above it changes sign.
  return {stokes_drag(a) * (1 / (4 * x) + value(surface_perpendicular, x, log_term)),
          stokes_drag(a) * value(surface_parallel, x, log_term),
          -6 * pi * a * a * value(surface_coupling, x, log_term),
          stokes_torque(a) * value(surface_twist, x, log_term), stokes_torque(a) * value(surface_rolling, x, log_term)};
}

}  // namespace pigment::resistance
