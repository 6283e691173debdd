#include "dewatering/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/error.h"

namespace pigment::dewatering {
namespace {

constexpr double water = 1e-3;  // density, engine units

DewateringCurve table(const std::string& text, double density = water) {
  const std::filesystem::path file = "table.csv";
  std::ofstream(file) << text;
  return read_table(file, density);
}

std::string complaint(const std::string& text) {
  try {
    table(text);
  } catch (const FileError& error) {
    return error.what();
  }
  return "none";
}

TEST(DewateringTable, MassFluxBecomesVolumeFlux) {
  const std::string text = "time [s],absorption [g/m2/s],evaporation [g/m2/s]\n0,10,20\n0.5,10,20\n";
  const DewateringCurve curve = table(text);
  EXPECT_NEAR(curve.absorbed_at(500), 5, 1e-12);     // um: 10 um/s for half a second
  EXPECT_NEAR(curve.evaporated_at(250), 5, 1e-12);
  EXPECT_NEAR(table(text, 0.972e-3).absorbed_at(500), 5 / 0.972, 1e-12);  // water at 80 C
  EXPECT_TRUE(curve.temperature.empty());
}

TEST(DewateringTable, CumulativeCurvesAreTheIntegralOfTheLinearFlux) {
  const DewateringCurve curve =
      table("time [ms],evaporation [g/m2/s],absorption [g/m2/s]\n0,0,30\n100,40,30\n500,0,0\n");
  // 0..100 ms: 0.04 t^2 / 200 um; later a parabola; total 2 + 8 um and 3 + 6 um.
  EXPECT_NEAR(curve.evaporated_at(500), 10, 1e-12);
  EXPECT_NEAR(curve.absorbed_at(500), 9, 1e-12);
  for (double t = 0; t <= 100; t += 0.777)  // straight lines between points: the stated error
    EXPECT_NEAR(curve.evaporated_at(t), 0.04 * t * t / 200, 1e-6 * 19) << t;
  EXPECT_GT(curve.time.size(), 50u);
}

TEST(DewateringTable, TimeTwiceIsAJump) {
  const DewateringCurve curve =
      table("time [s],absorption [g/m2/s],evaporation [g/m2/s]\n0,0,40\n0.2,0,40\n0.2,0,8\n0.6,0,8\n");
  EXPECT_NEAR(curve.evaporated_at(200), 8, 1e-12);
  EXPECT_NEAR(curve.evaporated_at(600), 8 + 3.2, 1e-7);  // the jump takes 1e-9 of 600 ms
  for (std::size_t i = 1; i < curve.time.size(); ++i) EXPECT_LT(curve.time[i - 1], curve.time[i]);
}

TEST(DewateringTable, TemperatureIsLinearInTime) {
  const DewateringCurve curve = table(
      "time [s],absorption [g/m2/s],evaporation [g/m2/s],temperature [degC]\n0,0,0,25\n0.1,10,0,45\n0.2,10,0,45\n");
  EXPECT_NEAR(curve.temperature_at(50, 0), 273.15 + 35, 1e-9);
  EXPECT_NEAR(curve.temperature_at(1000, 0), 273.15 + 45, 1e-9);
}

TEST(DewateringTable, OneRowIsAConstantFlux) {
  EXPECT_NEAR(table("time [s],absorption [g/m2/s],evaporation [g/m2/s]\n0,10,0\n").absorbed_at(500), 5, 1e-12);
}

TEST(DewateringTable, RefusesWithTheLine) {
  const std::string header = "time [s],absorption [g/m2/s],evaporation [g/m2/s]\n";
  auto expect = [](const std::string& text, const std::string& words) {
    const std::string found = complaint(text);
    EXPECT_NE(found.find(words), std::string::npos) << text << "gave: " << found;
  };
  expect(header + "0.1,1,1\n0.2,1,1\n", "table.csv:2: the first time must be 0");
  expect(header + "0,1,1\n0.2,1,1\n0.1,1,1\n", "table.csv:4: time must not fall");
  expect(header + "0,1,1\n0.2,1,1\n0.2,2,1\n0.2,3,1\n", "table.csv:5: time stands here for the third time");
  expect(header + "0,1,1\n0.2,-1,1\n", "table.csv:3: absorption must not be negative");
  expect(header + "0,1,nan\n", "table.csv:2");
  expect(header, "no rows");
  expect("", "empty");
  expect("time [s],absorption,evaporation [g/m2/s]\n0,1,1\n", "names no unit");
  expect("time [s],absorption [mm],evaporation [g/m2/s]\n0,1,1\n", "[mm]");
  expect("time [s],absorption [g/m2/s],evaporation [g/m2/s],temperature [degC]\n0,1,1,400\n", "temperature");
  EXPECT_THROW(read_table("absent.csv", water), FileError);
}

}  // namespace
}  // namespace pigment::dewatering
