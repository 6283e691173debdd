#include "model/liquid.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace pigment {
namespace {

// IAPWS SR6-08(2011), values of the release: to the digits that are printed.
TEST(Water, ViscosityAtThreeTemperatures) {
  EXPECT_NEAR(water_viscosity(293.15), 1.0016, 0.5e-4);
  EXPECT_NEAR(water_viscosity(298.15), 0.8900, 0.5e-4);
  EXPECT_NEAR(water_viscosity(323.15), 0.5465, 0.5e-4);
}

TEST(Water, PermittivityAtThreeTemperatures) {
  EXPECT_NEAR(water_relative_permittivity(293.15), 80.19, 0.5e-2);
  EXPECT_NEAR(water_relative_permittivity(298.15), 78.38, 0.5e-2);
  EXPECT_NEAR(water_relative_permittivity(323.15), 69.93, 0.5e-2);
}

TEST(Liquid, FollowsTheTemperatureUnlessGiven) {
  config::Document d = config::Document::from_text("liquid: {temperature: 50 degC}\n");
  const LiquidParameters p = read_liquid(d.root().block("liquid"));
  d.check();
  EXPECT_DOUBLE_EQ(liquid_at(p, p.temperature).viscosity, water_viscosity(323.15));
  EXPECT_DOUBLE_EQ(liquid_at(p, 298.15).viscosity, water_viscosity(298.15));
  EXPECT_DOUBLE_EQ(p.density, 1e-3);
  EXPECT_EQ(d.resolved(), "liquid: {temperature: 50 degC, density: 1000 kg/m3}\n");
}

TEST(Liquid, GivenValuesHoldAtEveryTemperature) {
  config::Document d = config::Document::from_text("liquid: {viscosity: 2 mPa s, relative_permittivity: 80}\n");
  const LiquidParameters p = read_liquid(d.root().block("liquid"));
  d.check();
  for (const double t : {280.0, 298.15, 353.15}) {
    EXPECT_DOUBLE_EQ(liquid_at(p, t).viscosity, 2);
    EXPECT_DOUBLE_EQ(liquid_at(p, t).relative_permittivity, 80);
  }
}

// kT(298.15 K) = 4.11640e-21 J; eps_0 = 8.8542e-12 F/m is 8.8542e-6 pN/mV^2.
TEST(Liquid, EngineUnits) {
  const Liquid liquid = liquid_at({}, 298.15);
  EXPECT_NEAR(liquid.thermal_energy(), 4.11640e-3, 1e-8);
  EXPECT_NEAR(liquid.permittivity() / liquid.relative_permittivity, 8.8541878e-6, 1e-13);
}

TEST(Liquid, RefusesWhatTheCorrelationDoesNotCover) {
  for (const char* text : {"{temperature: 120 degC}", "{temperature: -30 degC}", "{viscosity: 0 Pa s}", "{density: 0 kg/m3}",
                           "{relative_permittivity: 0.5}"}) {
    config::Document d = config::Document::from_text(std::string("liquid: ") + text);
    read_liquid(d.root().block("liquid"));
    EXPECT_THROW(d.check(), InputError) << text;
  }
}

}  // namespace
}  // namespace pigment
