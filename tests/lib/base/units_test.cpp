#include "base/units.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pigment {
namespace {

double engine(const char* text, Dimension d) {
  const ParsedQuantity q = parse_quantity(text, d);
  EXPECT_TRUE(q.ok) << q.error;
  return to_engine(d, q.si);
}

std::string refusal(const char* text, Dimension d) {
  const ParsedQuantity q = parse_quantity(text, d);
  EXPECT_FALSE(q.ok) << text << " was read as " << q.si;
  return q.error;
}

// The engine's units by hand: um, ms, pN, mV.
TEST(Units, EngineValues) {
  EXPECT_DOUBLE_EQ(engine("25 um", Dimension::Length), 25);
  EXPECT_DOUBLE_EQ(engine("5 nm", Dimension::Length), 0.005);
  EXPECT_DOUBLE_EQ(engine("1e-18 m2", Dimension::Area), 1e-6);
  EXPECT_DOUBLE_EQ(engine("0.5 s", Dimension::Time), 500);
  EXPECT_DOUBLE_EQ(engine("25 degC", Dimension::Temperature), 298.15);
  EXPECT_DOUBLE_EQ(engine("1 kg", Dimension::Mass), 1e12);
  EXPECT_DOUBLE_EQ(engine("2700 kg/m3", Dimension::Density), 2.7e-3);
  EXPECT_DOUBLE_EQ(engine("10 um/s", Dimension::Velocity), 0.01);
  EXPECT_DOUBLE_EQ(engine("2 rad/s", Dimension::AngularVelocity), 2e-3);
  EXPECT_DOUBLE_EQ(engine("9.81 m/s2", Dimension::Acceleration), 9.81);
  EXPECT_DOUBLE_EQ(engine("3 pN", Dimension::Force), 3);
  EXPECT_DOUBLE_EQ(engine("1e-21 J", Dimension::Energy), 1e-3);
  EXPECT_DOUBLE_EQ(engine("50 kPa", Dimension::Pressure), 5e4);
  EXPECT_DOUBLE_EQ(engine("72 mN/m", Dimension::SurfaceTension), 72000);
  EXPECT_DOUBLE_EQ(engine("0.89 mPa s", Dimension::Viscosity), 0.89);
  EXPECT_DOUBLE_EQ(engine("-25 mV", Dimension::Potential), -25);
  EXPECT_DOUBLE_EQ(engine("40 g/m2/s", Dimension::MassFlux), 40e-6);
  EXPECT_DOUBLE_EQ(engine("26 g/m2", Dimension::AreaDensity), 0.026);
  EXPECT_DOUBLE_EQ(engine("10 mmol/l", Dimension::Concentration), 10);
  EXPECT_DOUBLE_EQ(engine("2e-9 N m-1/2", Dimension::BrownianConstant), 2);
  EXPECT_DOUBLE_EQ(engine("65 wt%", Dimension::MassFraction), 0.65);
  EXPECT_DOUBLE_EQ(engine("68 vol-%", Dimension::VolumeFraction), 0.68);
  EXPECT_DOUBLE_EQ(engine("1e-2", Dimension::Number), 0.01);
}

// One gram per square metre and second of water is one micrometre per second.
TEST(Units, FactorsAgreeWithEachOther) {
  const double flux = engine("1 g/m2/s", Dimension::MassFlux) / engine("1000 kg/m3", Dimension::Density);
  EXPECT_DOUBLE_EQ(flux, engine("1 um/s", Dimension::Velocity));
  EXPECT_DOUBLE_EQ(engine("1 pN", Dimension::Force) / engine("1 um2", Dimension::Area), engine("1 Pa", Dimension::Pressure));
  EXPECT_DOUBLE_EQ(engine("1 pg", Dimension::Mass) * engine("1 m/s2", Dimension::Acceleration),
                   engine("1e-15 N", Dimension::Force));
  EXPECT_DOUBLE_EQ(engine("1 Pa", Dimension::Pressure) * engine("1 s", Dimension::Time),
                   engine("1 Pa s", Dimension::Viscosity));
  EXPECT_DOUBLE_EQ(engine("1 J", Dimension::Energy) / engine("1 m2", Dimension::Area),
                   engine("1 N/m", Dimension::SurfaceTension));
  EXPECT_NEAR(constants::boltzmann * 298.15, engine("4.11640e-21 J", Dimension::Energy), 1e-8);  // six digits given
}

TEST(Units, EveryDimensionReadsItsOwnExampleAndUnit) {
  for (int i = 0; i <= static_cast<int>(Dimension::VolumeFraction); ++i) {
    const auto d = static_cast<Dimension>(i);
    EXPECT_EQ(info(d).dimension, d);
    EXPECT_TRUE(parse_quantity(info(d).example, d).ok) << info(d).name;
    const UnitConversion c = conversion_to_si(info(d).si_unit, d);
    EXPECT_TRUE(c.ok) << info(d).name << ": " << c.error;
    EXPECT_EQ(c.factor, 1);
    EXPECT_EQ(c.offset, 0);
  }
}

TEST(Units, SpellingsAreAlike) {
  for (const char* text : {"5 um", "5um", "+5 um", "5e0  um", "5 micrometer", "5 \xC2\xB5m", "5e-6 m", "5000 nm"})
    EXPECT_DOUBLE_EQ(engine(text, Dimension::Length), 5) << text;
  for (const char* text : {"40 g/m2/s", "40 g m-2 s-1", "40 g/(m2 s)", "0.04 kg/m^2/s"})
    EXPECT_DOUBLE_EQ(engine(text, Dimension::MassFlux), 40e-6) << text;
  EXPECT_NEAR(engine("77 degF", Dimension::Temperature), 298.15, 1e-9);  // udunits' offset is rounded
}

TEST(Units, RefusalsSayWhatIsDue) {
  EXPECT_EQ(refusal("5 nmm", Dimension::Length), "\"5 nmm\" is not a length; write e.g. \"5 nm\"");
  EXPECT_EQ(refusal("5", Dimension::Length), "\"5\" is not a length: its unit is missing; write e.g. \"5 nm\"");
  EXPECT_EQ(refusal("5 kPa", Dimension::Length), "\"5 kPa\" is not a length (but a pressure); write e.g. \"5 nm\"");
  EXPECT_EQ(refusal("65 %", Dimension::MassFraction),
            "\"65 %\" is not a mass fraction (percent of what?); write e.g. \"65 wt%\"");
  EXPECT_EQ(refusal("1 m", Dimension::Energy).substr(0, 22), "\"1 m\" is not an energy");
}

TEST(Units, WhatIsNoQuantityIsRefused) {
  for (const char* text : {"", " ", "um", "nan m", "inf m", "-inf m", "1e999 m", "2,5 um", "5 3 m", "5 m m", "5 1/m",
                           "5 m since 2000-01-01", "5 m @ 3", "5 lg(re m)", "0x5 m", "5 m-", "- 5 m", "5 umm", "--5 m",
                           "5 wt%", "5 degC", "1e-3 m;", "5 m\n6 m"})
    refusal(text, Dimension::Length);
  refusal("3 Hz", Dimension::Time);  // udunits would take the reciprocal
  refusal("0.65", Dimension::MassFraction);
  refusal("0.65 1", Dimension::MassFraction);
  refusal("65 vol%", Dimension::MassFraction);
  refusal("5 um", Dimension::Number);
}

TEST(Units, FilesMayCarryOtherUnitsOfTheDimension) {
  const UnitConversion c = conversion_to_si("degC", Dimension::Temperature);
  ASSERT_TRUE(c.ok);
  EXPECT_EQ(c.factor, 1);
  EXPECT_DOUBLE_EQ(c.offset, 273.15);
  EXPECT_DOUBLE_EQ(conversion_to_si("nm", Dimension::Length).factor, 1e-9);
  EXPECT_FALSE(conversion_to_si("kg", Dimension::Length).ok);
  EXPECT_FALSE(conversion_to_si("", Dimension::Length).ok);
}

}  // namespace
}  // namespace pigment
