#include "calibration/brownian_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pigment;

// The calibrated constant against its closed form: 25 simulations of 2,000 displacements have a standard error of
// 0.5 sqrt(0.8/50,000) = 0.2 % (a component is uniform, its square has a variance of 0.8); 4 of them: one false alarm in 15,000.
TEST(BrownianCalibration, FindsTheClosedFormAtEveryTemperature) {
  calibration::CalibrationSettings settings;
  settings.temperatures = {293.15, 313.15, 333.15, 353.15};
  settings.displacements = 2000;
  const BrownianCalibration result = calibration::calibrate({}, settings);
  ASSERT_EQ(result.value.size(), 4u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(result.value[k], result.closed_form[k], 4 * 0.002 * result.closed_form[k]);
    // One simulation scatters by 0.5 sqrt(0.8/2000) = 1 %; its estimate from 25 is good to a factor of 1.5 (4 standard errors 0.57).
    EXPECT_NEAR(result.standard_deviation[k] / result.closed_form[k], 0.01, 0.006);
    if (k > 0) {
      EXPECT_LT(result.value[k], result.value[k - 1]);  // Fig. 14: K falls with T
    }
  }
  EXPECT_NE(result.value[0] / result.closed_form[0], result.value[1] / result.closed_form[1]);  // independent draws
}

TEST(BrownianConstant, ClosedFormInSi) {
  // sqrt(36 pi mu k T/dt) at 25 degC, dt = 1e-4 s: sqrt(36 pi * 8.900e-4 * 1.380649e-23 * 298.15/1e-4) = 2.0355e-9 N m^-1/2.
  const Liquid liquid = liquid_at({}, 298.15);
  EXPECT_NEAR(to_si(Dimension::BrownianConstant, brownian_constant(liquid.viscosity, liquid.thermal_energy(), 0.1)), 2.0355e-9, 5e-13);
}

TEST(BrownianConstant, RescalesWithTheStepAndInterpolatesInTemperature) {
  const BrownianCalibration c{{300, 320}, {0.1, 0.4}, {2.0, 0.9}, {}, {}};
  EXPECT_DOUBLE_EQ(c.value_at(300, 0.1), 2.0);
  EXPECT_DOUBLE_EQ(c.value_at(300, 0.4), 1.0);
  EXPECT_DOUBLE_EQ(c.value_at(320, 0.1), 1.8);
  EXPECT_DOUBLE_EQ(c.value_at(310, 0.1), 1.9);
  EXPECT_DOUBLE_EQ(c.value_at(250, 0.1), 2.0);
  EXPECT_DOUBLE_EQ(c.value_at(400, 0.1), 1.8);
}
