#include "model/height_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "base/error.h"
#include "model/height_field.h"

using namespace pigment;

namespace {

std::filesystem::path table(const std::string& text) {
  const std::filesystem::path file = "heights.csv";
  std::ofstream(file) << text;
  return file;
}

std::string refusal(const std::string& text) {
  try {
    height_map({0, 0, table(text)});
    return "accepted";
  } catch (const FileError& e) {
    return e.what();
  }
}

std::string read(const std::string& text) {
  auto document = config::Document::from_text(text, "scene.yaml");
  read_roughness(document.root().block("roughness"));
  try {
    document.check();
    return "accepted";
  } catch (const InputError& e) {
    return e.what();
  }
}

const std::string header = "x [um],y [um],height [um]\n";

}  // namespace

TEST(HeightMap, TableGivesItsHeightsInAnyOrderOfRows) {
  std::string rows, turned;
  const auto z = [](int i, int j) { return 0.1 * ((7 * i + 3 * j) % 5); };
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) {
      rows += std::to_string(0.5 * i + 1) + "," + std::to_string(0.25 * j) + "," + std::to_string(z(i, j)) + "\n";
      turned = std::to_string(0.5 * i + 1) + "," + std::to_string(0.25 * j) + "," + std::to_string(z(i, j)) + "\n" + turned;
    }
  const HeightMap map = height_map({0, 0, table(header + rows)});
  EXPECT_EQ(map.height, height_map({0, 0, table(header + turned)}).height);
  EXPECT_EQ(map.count_x, 6u);
  EXPECT_EQ(map.count_y, 4u);
  EXPECT_NEAR(map.period_x, 3, 1e-12);
  EXPECT_NEAR(map.period_y, 1, 1e-12);
  const HeightField field(map, Cell{7, 3.2, 10});  // two periods of 3.5 and three of 1.0667
  EXPECT_NEAR(field.lowest(), 0, 1e-9);
  double sum = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) {
      // The spline passes through every height, all of them moved up by the same.
      EXPECT_NEAR(field.height(3.5 * i / 6 + 3.5, 3.2 / 3 * j / 4) - field.height(0, 0), z(i, j) - z(0, 0), 1e-12);
      sum += map.height[i * 4 + j] / 24;
      EXPECT_LE(map.height[i * 4 + j], field.crest() + 1e-12);
    }
  EXPECT_NEAR(field.mean_height(), sum, 1e-12);
}

TEST(HeightMap, ASingleRowMakesRidges) {
  const HeightMap map = height_map({0, 0, table(header + "0,2,0\n1,2,0.5\n2,2,1\n3,2,0.5\n")});
  const HeightField field(map, Cell{8, 6, 10});
  EXPECT_NEAR(field.height(1.2, 0.3), field.height(1.2, 4.7), 1e-12);
  EXPECT_NEAR(field.height(2, 0), 1, 1e-12);
  EXPECT_NEAR(field.height(0, 0), 0, 1e-12);
}

// Space between a plane and the surface against the integral, and the whole of it above the crests.
TEST(HeightMap, SpaceBelowAPlaneIsTheIntegralOverTheSurface) {
  const HeightField field(height_map({1, 2, {}}), Cell{4, 4, 10});
  for (const double z : {0.2, 0.5, 0.9}) {
    double sum = 0;
    const int n = 500;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) sum += std::max(0.0, z - field.height(4.0 * (i + 0.5) / n, 4.0 * (j + 0.5) / n));
    // 24 x 24 points a period: the midpoint rule on a kink, a few of (1/24)^2.
    EXPECT_NEAR(field.space_below(z), sum / (n * n), 5e-3 * z);
  }
  EXPECT_NEAR(field.space_below(3), 3 - 0.5, 1e-12);
  EXPECT_EQ(field.space_below(-1), 0);
}

TEST(HeightMap, RefusesWhatIsNoGrid) {
  const std::string good = "0,0,0\n1,0,0.5\n2,0,1\n3,0,0.5\n";
  EXPECT_EQ(refusal(header + good), "accepted");
  EXPECT_NE(refusal(header + "0,0,0\n1,0,0.5\n2.5,0,1\n3,0,0.5\n").find("heights.csv:4: x = 2.5 um is not on an even grid"), std::string::npos)
      << refusal(header + "0,0,0\n1,0,0.5\n2.5,0,1\n3,0,0.5\n");
  EXPECT_NE(refusal(header + good + "1,0,0.7\n").find("heights.csv:6: x = 1 um, y = 0 um stands in line 3 already"), std::string::npos);
  EXPECT_NE(refusal(header + "0,0,0\n1,0,0.5\n").find("expected 4 or more"), std::string::npos);
  EXPECT_NE(refusal(header + good + "0,1,0\n0,2,0\n0,3,0\n").find("ends with 7 rows; a grid of 4 x 4 points takes 16"), std::string::npos);
  EXPECT_NE(refusal("x [um],y [um],depth [um]\n" + good).find("depth"), std::string::npos);
  EXPECT_NE(refusal("x [um],y [s],height [um]\n" + good).find("heights.csv:1"), std::string::npos);
  EXPECT_THROW(height_map({0, 0, "no-such.csv"}), FileError);
}

TEST(Roughness, KeysAreCheckedWithLineAndPath) {
  EXPECT_EQ(read("roughness: {amplitude: 1 um, wavelength: 2 um}"), "accepted");
  EXPECT_EQ(read("roughness: {file: heights.csv}"), "accepted");
  EXPECT_NE(read("roughness: {amplitude: 1 um}").find("scene.yaml:1: roughness.wavelength: missing"), std::string::npos) << read("roughness: {amplitude: 1 um}");
  EXPECT_NE(read("roughness: {amplitude: -1 um, wavelength: 2 um}").find("roughness.amplitude"), std::string::npos);
  EXPECT_NE(read("roughness:\n  file: h.csv\n  amplitude: 1 um\n").find("scene.yaml:3: roughness.amplitude: the file holds the heights"), std::string::npos);
  EXPECT_NE(read("roughness: {amplitude: 1 um, wavelenght: 2 um}").find("wavelength"), std::string::npos);
}
