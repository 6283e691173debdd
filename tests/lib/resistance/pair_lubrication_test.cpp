#include "resistance/pair_lubrication.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/table.h"

using namespace pigment;
using namespace pigment::resistance;
using std::numbers::pi;

namespace {

// The relative resistance of isolated drags in the same basis: K_iso = (G R_iso^-1 G^T)^-1. Errors are judged on the whole,
// isolated plus pair term, as a pair feels it.
struct Isolated {
  double squeeze, twist, ss, sq, qq;
};
Isolated isolated(double a1, double a2, double h) {
  const double f1 = 1 / (6 * pi * a1), f2 = std::isinf(a2) ? 0 : 1 / (6 * pi * a2);
  const double t1 = 1 / (8 * pi * a1 * a1 * a1), t2 = std::isinf(a2) ? 0 : 1 / (8 * pi * a2 * a2 * a2);
  Isolated iso{1 / (f1 + f2), 1 / (t1 + t2), 0, 0, 0};
  if (std::isinf(a2)) {
    // The plane neither moves nor turns: v = u + l w x n, w = omega.
    const double l = a1 + h / 2;
    iso.ss = 6 * pi * a1;
    iso.sq = -6 * pi * a1 * l;
    iso.qq = 8 * pi * a1 * a1 * a1 + 6 * pi * a1 * l * l;
    return iso;
  }
  const double l1 = a1 + h / 2, l2 = a2 + h / 2;
  // mobility of (s, q): s = n x u_1 - n x u_2 + l1 w1 + l2 w2 (tangential), q = w1 - w2
  const double mss = f1 + f2 + l1 * l1 * t1 + l2 * l2 * t2, msq = l1 * t1 - l2 * t2, mqq = t1 + t2, det = mss * mqq - msq * msq;
  iso.ss = mqq / det;
  iso.sq = -msq / det;
  iso.qq = mss / det;
  return iso;
}

}  // namespace

// data/resistance/relative_K_basis.csv holds exact solutions (bispherical coordinates), independent of the fitted form.
TEST(PairLubrication, RelativeResistanceIsExactNearContact) {
  const auto table = test::read_table("relative_K_basis.csv");
  double squeeze_error = 0, twist_error = 0, shear_error = 0;
  int rows = 0;
  for (std::size_t k = 0; k < table.at("lambda").size(); ++k) {
    const double lambda = table.at("lambda")[k], hb = table.at("gap_over_b")[k];
    if (hb > 0.1) continue;
    ++rows;
    // The smaller sphere has radius 1; the table's R is reduced radius.
    const double a1 = 1, a2 = lambda == 0 ? std::numeric_limits<double>::infinity() : 1 / lambda, h = hb;
    const double R = lambda == 0 ? 1 : a1 * a2 / (a1 + a2);
    const PairScalars p = pair_scalars(a2, a1, h);  // larger first, as in the table (kap > 0)
    const double kn = table.at("Kn/(6piR)")[k] * 6 * pi * R, kt = table.at("Kt/(8piR^3)")[k] * 8 * pi * R * R * R;
    const double ks = table.at("Ks/(2piR)")[k] * 2 * pi * R, kp = table.at("Kp/(4.8piR^3)")[k] * 4.8 * pi * R * R * R;
    const double ksp = table.at("Ksp/(piR^2)")[k] * pi * R * R;
    const Isolated iso = isolated(a2, a1, h);
    if (std::isinf(a2)) {
      squeeze_error = std::max(squeeze_error, std::abs(p.squeeze - kn) / (kn + 6 * pi));
      twist_error = std::max(twist_error, std::abs(p.twist - kt) / (kt + 8 * pi));
    } else {
      squeeze_error = std::max(squeeze_error, std::abs(p.squeeze - kn) / (kn + iso.squeeze));
      twist_error = std::max(twist_error, std::abs(p.twist - kt) / (kt + iso.twist));
    }
    // Shear block: largest relative deviation of the dissipation over all motions, a 2 x 2 generalised eigenvalue problem.
    const PairOperatorScalars o = operator_scalars(p, a2, a1);
    const PairOperatorScalars e = operator_scalars({kn, kt, ks, kp, ksp}, a2, a1);
    if (std::isinf(a2)) continue;  // the plane's isolated part is covered by the boundary functions
    const double d11 = o.a - e.a, d12 = o.b - e.b, d22 = o.c - e.c;
    const double m11 = e.a + iso.ss, m12 = e.b + iso.sq, m22 = e.c + iso.qq, det = m11 * m22 - m12 * m12;
    const double trace = (m22 * d11 - 2 * m12 * d12 + m11 * d22) / det, product = (d11 * d22 - d12 * d12) / det;
    const double root = std::sqrt(std::max(0.0, trace * trace / 4 - product));
    shear_error = std::max({shear_error, std::abs(trace / 2 + root), std::abs(trace / 2 - root)});
  }
  EXPECT_GT(rows, 300);
  EXPECT_LT(squeeze_error, 0.0005);  // the accuracy that the model claims
  EXPECT_LT(shear_error, 0.005);
  EXPECT_LT(twist_error, 0.005);
}

TEST(PairLubrication, ShearBlockIsPositiveAtEveryTaperedGapAndRatio) {
  for (double ratio : {1.0, 1.5, 2.0, 4.0, 8.0, 20.0, 50.0, 100.0})
    for (double g = 1e-7; g < 0.45; g *= 1.05) {
      const PairScalars k = tapered_pair_scalars(ratio, 1, g, {});
      ASSERT_GE(k.squeeze, 0);
      ASSERT_GE(k.twist, 0) << ratio << " " << g;
      ASSERT_GE(k.shear * k.pump, k.shear_pump * k.shear_pump) << ratio << " " << g;
    }
}

TEST(PairLubrication, DecaysMonotonicallyToZeroAtTheCutoff) {
  for (double ratio : {1.0, 3.0, 10.0, 100.0}) {
    PairScalars last = tapered_pair_scalars(ratio, 1, 1e-6, {});
    for (double g = 1.01e-6; g < 1.6; g *= 1.01) {
      const PairScalars k = tapered_pair_scalars(ratio, 1, g, {});
      ASSERT_LE(k.squeeze, last.squeeze) << ratio << " " << g;
      ASSERT_LE(k.shear, last.shear) << ratio << " " << g;
      ASSERT_LE(k.pump, last.pump) << ratio << " " << g;
      last = k;
    }
    EXPECT_EQ(last.squeeze, 0);
    EXPECT_EQ(last.shear, 0);
    EXPECT_EQ(last.pump, 0);
    EXPECT_EQ(last.shear_pump, 0);
    EXPECT_EQ(last.twist, 0);
  }
}

// C2: value, slope and curvature meet at both ends, so that what is left at a small distance from an end goes with its cube:
// t^3 (10 - 15 t + 6 t^2), and the same from above.
TEST(PairLubrication, TaperIsSmoothAndMonotone) {
  const double begin = 0.2, end = 0.4;
  double last = 1;
  for (double y = 0.15; y < 0.45; y += 1e-4) {
    const double w = taper(y, begin, end);
    ASSERT_LE(w, last);
    ASSERT_GE(w, 0);
    last = w;
  }
  EXPECT_EQ(taper(begin, begin, end), 1);
  EXPECT_EQ(taper(end, begin, end), 0);
  for (double t : {0.01, 0.001}) {
    EXPECT_NEAR((1 - taper(begin + t * (end - begin), begin, end)) / (t * t * t), 10, 16 * t);
    EXPECT_NEAR(taper(end - t * (end - begin), begin, end) / (t * t * t), 10, 16 * t);
  }
  EXPECT_NEAR(taper(0.3, begin, end), 0.5, 1e-14);
}

TEST(PairLubrication, ExchangingTheSpheresChangesOnlyTheSignOfTheCoupling) {
  const PairScalars a = pair_scalars(0.2, 1.1, 0.01), b = pair_scalars(1.1, 0.2, 0.01);
  EXPECT_DOUBLE_EQ(a.squeeze, b.squeeze);
  EXPECT_DOUBLE_EQ(a.shear, b.shear);
  EXPECT_DOUBLE_EQ(a.pump, b.pump);
  EXPECT_DOUBLE_EQ(a.shear_pump, -b.shear_pump);
}

// A gap pressed shut with a constant force F against 6 pi R^2/h alone is h0 exp(-F t/c) after t: Newton's iteration with the
// linearised impulse must land there, from a first guess that is seven factors of e off.
TEST(PairLubrication, NewtonOnTheImpulseClosesAGapExponentially) {
  const double R = 0.3, h0 = 0.02, c = 6 * pi * R * R, dt = 0.1, force = 7 * c / dt;
  double guess = h0;
  for (int k = 0; k < 40; ++k) {
    const SqueezeStep s = squeeze_step(R, h0, guess);
    // (c/h0 + coefficient) dh/dt = -F + impulse/dt
    const double h = h0 + dt * (s.impulse / dt - force) / (c / h0 + s.coefficient);
    guess = std::max(h, 0.2 * guess);
  }
  EXPECT_NEAR(guess, h0 * std::exp(-7.0), 1e-10 * guess);
}
TEST(PairLubrication, ImpulseIsSmoothWhereItsSeriesTakesOver) {
  const double R = 0.3, h0 = 0.02;
  const double near = squeeze_step(R, h0, h0 / (1 + 0.99e-4)).impulse, far = squeeze_step(R, h0, h0 / (1 + 1.01e-4)).impulse;
  EXPECT_NEAR(near / (0.99 * 0.99), far / (1.01 * 1.01), 1e-5 * std::abs(far));  // -c y^2/2 and a term of relative size y
  EXPECT_EQ(squeeze_step(R, h0, h0).impulse, 0);
  EXPECT_EQ(squeeze_step(R, h0, h0).coefficient, 0);
}
