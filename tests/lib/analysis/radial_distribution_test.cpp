#include "analysis/radial_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace pigment::analysis {
namespace {

// Pairs expected in a bin when every particle keeps its height: summed pair by pair.
double expected_pairs(const Snapshot& frame, double from, double to) {
  double sum = 0;
  for (std::size_t i = 0; i < frame.position.size(); ++i)
    for (std::size_t j = i + 1; j < frame.position.size(); ++j) {
      const double dz = frame.position[i].z() - frame.position[j].z();
      const auto disc = [&](double r) { return std::numbers::pi * std::max(0.0, r * r - dz * dz); };
      sum += (disc(to) - disc(from)) / frame.cell.area();
    }
  return sum;
}

TEST(RadialDistribution, OfACubicLatticePeaksAtItsDistances) {
  // Spacing 1, 6 x 6 x 4: 6 x 6 x (2 x 4 + 3) pairs at 1, 6 x 6 x (2 x 4 + 4 x 3) at sqrt 2, nothing between.
  Snapshot frame;
  frame.cell = {6, 6, 4};
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y)
      for (int z = 0; z < 4; ++z) frame.position.push_back({x - 11.7, y + 0.2, z + 0.5});
  const auto g = radial_distribution(frame, 1.6, 8);  // bins of 0.2: 1 lies on an edge, either side may have it
  EXPECT_EQ(g[0] + g[1] + g[2] + g[3], 0);
  const double at_one = g[4] * expected_pairs(frame, 0.8, 1) + g[5] * expected_pairs(frame, 1, 1.2);
  EXPECT_NEAR(at_one, 36 * 11, 1e-9 * 396);
  EXPECT_EQ(g[6], 0);
  EXPECT_NEAR(g[7] * expected_pairs(frame, 1.4, 1.6), 36 * 20, 1e-9 * 720);
}

TEST(RadialDistribution, OfParticlesAtRandomIsOneWhateverTheirHeights) {
  // Three quarters of the particles in the lowest quarter of the layer, at random in x and y.
  Snapshot frame;
  frame.cell = {8, 7, 10};
  const std::size_t count = 4000;
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = random_uniforms({51, Stream::Tests}, i);
    frame.position.push_back({8 * u[0] - 16, 7 * u[1], (u[3] < 0.75 ? 2.5 : 10.0) * u[2]});
  }
  const auto g = radial_distribution(frame, 3, 6);
  for (std::size_t k = 0; k < 6; ++k) {
    // Pairs in a bin are all but independent: Poisson. Four standard deviations, exceeded once in 16,000 bins.
    const double expected = expected_pairs(frame, 0.5 * static_cast<double>(k), 0.5 * static_cast<double>(k + 1));
    EXPECT_NEAR(g[k], 1, 4 / std::sqrt(expected)) << k;
    EXPECT_GT(expected, 1000) << k;  // else the tolerance would allow anything
  }
}

TEST(RadialDistribution, OfSpheresAtRandomVanishesInsideThem) {
  // Hard spheres of diameter 1 put in one after the other where there is room.
  Snapshot frame;
  frame.cell = {6, 6, 6};
  for (std::size_t i = 0; i < 5000; ++i) {
    const auto u = random_uniforms({52, Stream::Tests}, i);
    const Vec3 p{6 * u[0], 6 * u[1], 6 * u[2]};
    bool free = true;
    for (const Vec3& q : frame.position) free = free && frame.cell.minimum_image(p - q).norm() >= 1;
    if (free) frame.position.push_back(p);
  }
  ASSERT_GT(frame.position.size(), 100u);
  const auto g = radial_distribution(frame, 2, 4);
  EXPECT_EQ(g[0], 0);
  EXPECT_EQ(g[1], 0);
  EXPECT_GT(g[2], 1.1);  // those kept out of the sphere stand next to it
}

TEST(RadialDistribution, OfOneIsZero) {
  Snapshot frame;
  frame.cell = {5, 5, 5};
  frame.position = {{1, 1, 1}};
  EXPECT_EQ(radial_distribution(frame, 2, 3), std::vector<double>(3, 0.0));
}

}  // namespace
}  // namespace pigment::analysis
