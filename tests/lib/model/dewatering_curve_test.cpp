#include "model/dewatering_curve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pigment {
namespace {

DewateringCurve ramp() {
  DewateringCurve c;
  c.time = {0, 2, 4};
  c.absorption_flux = {0, 2, 1};
  c.evaporation_flux = {3, 3, 3};
  return c;
}

// By hand: the flux t on [0,2], then 2 - (t-2)/2, then 1 for ever.
TEST(DewateringCurve, IntegratesALinearFluxExactly) {
  const DewateringCurve c = ramp();
  EXPECT_DOUBLE_EQ(c.absorbed_at(0), 0);
  EXPECT_DOUBLE_EQ(c.absorbed_at(1), 0.5);
  EXPECT_DOUBLE_EQ(c.absorbed_at(2), 2);
  EXPECT_DOUBLE_EQ(c.absorbed_at(3), 2 + 2 - 0.25);
  EXPECT_DOUBLE_EQ(c.absorbed_at(4), 5);
  EXPECT_DOUBLE_EQ(c.absorbed_at(10), 11);
  EXPECT_DOUBLE_EQ(c.mean_absorption_flux(1, 3), (3.75 - 0.5) / 2);
  EXPECT_DOUBLE_EQ(c.mean_absorption_flux(1, 1), 1);
  EXPECT_DOUBLE_EQ(c.mean_absorption_flux(3, 9), (10 - 3.75) / 6);
  EXPECT_DOUBLE_EQ(c.evaporated_at(7), 21);
}

// Darcy's square root: the flux at 0 is infinite, the cumulative curve is what acts.
TEST(DewateringCurve, CumulativeCurvesWinOverFluxes) {
  DewateringCurve c;
  for (int i = 0; i <= 10; ++i) {
    c.time.push_back(i * i);
    c.absorbed.push_back(i);
    c.absorption_flux.push_back(1e9);
    c.evaporation_flux.push_back(0);
  }
  c.absorption_flux.back() = 0.05;
  EXPECT_DOUBLE_EQ(c.absorbed_at(49), 7);
  EXPECT_DOUBLE_EQ(c.mean_absorption_flux(0, 100), 0.1);
  EXPECT_DOUBLE_EQ(c.mean_absorption_flux(0, 0), 1);           // the slope of the first piece
  EXPECT_DOUBLE_EQ(c.absorbed_at(120), 10 + 20 * 0.05);        // goes on with the last flux
}

// Late in a long run a difference of two cumulative values would keep few digits of one step.
TEST(DewateringCurve, StepsKeepTheirDigits) {
  DewateringCurve c;
  c.time = {0, 3e5};
  c.absorption_flux = {0.01, 0.01};
  c.evaporation_flux = {0, 0};
  const double t = 280000.1, dt = 0.1;
  EXPECT_NEAR(c.mean_absorption_flux(t, t + dt) / 0.01, 1, 1e-15);  // rounding of one product
}

TEST(DewateringCurve, StepsAddUp) {
  const DewateringCurve c = ramp();
  double sum = 0;
  const int n = 700;
  for (int i = 0; i < n; ++i) {
    const double a = 7.0 * i / n, b = 7.0 * (i + 1) / n;
    sum += c.mean_absorption_flux(a, b) * (b - a);
  }
  EXPECT_NEAR(sum, c.absorbed_at(7), 1e-12);
}

TEST(DewateringCurve, TemperatureOrTheFallback) {
  DewateringCurve c = ramp();
  EXPECT_EQ(c.temperature_at(1, 298.15), 298.15);
  c.temperature = {300, 310, 330};
  EXPECT_DOUBLE_EQ(c.temperature_at(3, 0), 320);
  EXPECT_DOUBLE_EQ(c.temperature_at(99, 0), 330);
}

TEST(DewateringCurve, EmptyLosesNothing) {
  const DewateringCurve c;
  EXPECT_EQ(c.absorbed_at(5), 0);
  EXPECT_EQ(c.mean_evaporation_flux(0, 1), 0);
}

}  // namespace
}  // namespace pigment
