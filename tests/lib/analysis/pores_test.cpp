#include "analysis/pores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"

namespace pigment::analysis {
namespace {

double share_below(const std::vector<double>& rising, double limit) {
  return static_cast<double>(std::lower_bound(rising.begin(), rising.end(), limit) - rising.begin()) /
         static_cast<double>(rising.size());
}

TEST(Pores, OfACubicLatticeAreKnown) {
  // Spheres of radius a on a lattice of spacing 1; each cube is one sphere's. Shells about the spheres do not meet while
  // they are thinner than 1/2 - a: what lies within d of a surface is the shell's volume. The farthest points are the
  // corners of the cubes, sqrt(3)/2 from the centres.
  const double a = 0.35;
  Snapshot frame;
  frame.cell = {4, 3, 3};
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z) frame.position.push_back({x + 0.3 + 12, y - 2.9, z + 0.5});
  const std::size_t points = 40000;
  const Pores p = measure_pores(frame, std::vector<double>(36, a), points);
  const double sphere = 4.0 / 3 * std::numbers::pi * a * a * a;
  EXPECT_NEAR(p.porosity, 1 - sphere, 1e-12);
  EXPECT_NEAR(p.specific_surface, 4 * std::numbers::pi * a * a, 1e-12);
  EXPECT_NEAR(p.hydraulic_diameter, 4 * (1 - sphere) / (4 * std::numbers::pi * a * a), 1e-12);
  // Shares of independent points: four binomial standard deviations, exceeded once in 16,000.
  const auto deviation = [](double share, double count) { return 4 * std::sqrt(share * (1 - share) / count); };
  const auto found = static_cast<double>(p.distance.size());
  EXPECT_NEAR(found / points, 1 - sphere, deviation(sphere, points));
  for (const double d : {0.03, 0.08, 0.15}) {
    const double shell = 4.0 / 3 * std::numbers::pi * (std::pow(a + d, 3) - std::pow(a, 3)) / (1 - sphere);
    EXPECT_NEAR(share_below(p.distance, d), shell, deviation(shell, found)) << d;
  }
  EXPECT_LE(p.distance.back(), std::sqrt(3) / 2 - a);
  EXPECT_GT(p.distance.back(), std::sqrt(3) / 2 - a - 0.05);
  EXPECT_NEAR(p.mean_distance(), 0.18, 0.05);  // between nothing and the corner's 0.52
}

TEST(Pores, OfSpheresAcrossTheFacesAreThoseOfTheirParts) {
  // Half a sphere below the surface: half its volume, half its area.
  Snapshot frame;
  frame.cell = {3, 3, 4};
  frame.position = {{1, 1, 4}};
  const Pores p = measure_pores(frame, {1}, 1000);
  EXPECT_NEAR(p.porosity, 1 - 2.0 / 3 * std::numbers::pi / 36, 1e-12);
  EXPECT_NEAR(p.specific_surface, 2 * std::numbers::pi / 36, 1e-12);
}

TEST(Pores, OfNothingAreTheWholeLayer) {
  const Pores p = measure_pores({0, {3, 3, 4}, {}}, {}, 100);
  EXPECT_EQ(p.porosity, 1);
  EXPECT_EQ(p.hydraulic_diameter, 0);
  EXPECT_EQ(p.mean_distance(), 0);
}

}  // namespace
}  // namespace pigment::analysis
