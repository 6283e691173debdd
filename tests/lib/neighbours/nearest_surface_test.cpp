#include "neighbours/nearest_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"

namespace pigment::neighbours {
namespace {

TEST(NearestSurface, AgreesWithALookAtAllSpheres) {
  // Radii 1:100, one sphere far above the rest, positions several periods away.
  const Cell cell{6, 5, 8};
  Vec3Array position{{3, 3, 40}};
  std::vector<double> radius{1};
  for (std::size_t i = 0; i < 400; ++i) {
    const auto u = random_uniforms({61, Stream::Tests}, i);
    position.push_back({30 * u[0] - 12, 25 * u[1] - 10, 8 * u[2]});
    radius.push_back(0.01 * std::pow(100, u[3] * u[3]));
  }
  const NearestSurface surfaces(cell, position, radius);
  int inside = 0;
  for (std::size_t k = 0; k < 300; ++k) {
    const auto u = random_uniforms({62, Stream::Tests}, k);
    const Vec3 point{12 * u[0] - 6, 10 * u[1] - 5, 12 * u[2] - 2};
    double expected = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < radius.size(); ++i) {
      Vec3 d = position[i] - point;
      d.x() -= 6 * std::round(d.x() / 6);
      d.y() -= 5 * std::round(d.y() / 5);
      expected = std::min(expected, d.norm() - radius[i]);
    }
    EXPECT_NEAR(surfaces.distance(point), expected, 1e-13);  // rounding of coordinates of some 10
    inside += expected < 0;
  }
  EXPECT_GT(inside, 20);
  EXPECT_LT(inside, 280);
}

TEST(NearestSurface, IsInfiniteWithoutSpheres) {
  EXPECT_TRUE(std::isinf(NearestSurface({5, 5, 5}, {}, {}).distance({1, 1, 1})));
}

TEST(NearestSurface, IsDistributedAsForSpheresAtRandom) {
  // Points at random, n a um^3: the chance that none lies within r is exp(-4/3 pi n r^3). Asked for in the middle of a
  // layer that is deep enough for the faces not to count.
  const Cell cell{12, 12, 12};
  Vec3Array position;
  for (std::size_t i = 0; i < 12 * 12 * 12; ++i) {
    const auto u = random_uniforms({63, Stream::Tests}, i);
    position.push_back({12 * u[0], 12 * u[1], 12 * u[2]});
  }
  const double a = 0.2, r = 0.6;
  const NearestSurface surfaces(cell, position, std::vector<double>(position.size(), a));
  int beyond = 0;
  const int points = 20000;
  for (int k = 0; k < points; ++k) {
    const auto u = random_uniforms({64, Stream::Tests}, static_cast<std::uint64_t>(k));
    beyond += surfaces.distance({12 * u[0], 12 * u[1], 2 + 8 * u[2]}) > r - a;
  }
  const double expected = std::exp(-4.0 / 3 * std::numbers::pi * r * r * r);
  // The spheres are one sample: their places limit it, as if some 1,000 volumes of 0.9 um^3 had been looked at. Four of
  // that binomial's standard deviations.
  EXPECT_NEAR(static_cast<double>(beyond) / points, expected, 4 * std::sqrt(expected * (1 - expected) / 1000));
}

}  // namespace
}  // namespace pigment::neighbours
