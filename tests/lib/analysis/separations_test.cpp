#include "analysis/separations.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/random.h"

namespace pigment::analysis {
namespace {

Frames one_frame(const Snapshot& snapshot) {
  return {1, [=](std::size_t) { return snapshot; }};
}

double integral(const std::vector<double>& density, double width) {
  return width * std::accumulate(density.begin(), density.end(), 0.0);
}

TEST(Separations, OfACubicLatticeAreAllTheLatticeGap) {
  // 5 x 5 x 5 spheres of diameter 0.8 with spacing 1: nearest gaps 0.2; face diagonals 0.614 lie within the
  // limit 0.8, space diagonals sqrt(3) - 0.8 = 0.93 beyond it. Open in z: 5 x 5 x 4 vertical and 2 x 125
  // lateral nearest pairs; diagonals 2 x 125 in planes and 4 x 100 across planes.
  Snapshot frame;
  frame.cell = {5, 5, 5};
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z) frame.position.push_back({x + 0.1, y + 0.1, z + 0.5});
  const SeparationDevelopment d =
      measure_separations(one_frame(frame), std::vector<double>(125, 0.4), Parameters{});
  EXPECT_DOUBLE_EQ(d.limit, 0.8);
  const Separations& s = d.frames[0];
  EXPECT_EQ(s.pairs, 350 + 650);
  double nearest = 0, diagonal = 0;
  for (std::size_t k = 0; k < s.count.size(); ++k) {
    if (d.edges[k] < 0.2 + 1e-9 && d.edges[k + 1] > 0.2 - 1e-9) nearest += s.count[k];
    if (d.edges[k] < 0.6143 && d.edges[k + 1] > 0.6142) diagonal += s.count[k];
  }
  EXPECT_EQ(nearest, 350);
  EXPECT_EQ(diagonal, 650);
  EXPECT_NEAR(integral(s.density, 0.008), 1, 1e-14);
  EXPECT_NEAR(s.smallest, 0.2, 1e-14);
  EXPECT_DOUBLE_EQ(s.neighbours_per_particle, 16);
  EXPECT_EQ(s.near_pairs, 0);
}

TEST(Separations, AgreeWithACountOverAllPairs) {
  Snapshot frame;
  frame.cell = {6, 5, 7};
  std::vector<double> radius;
  for (std::size_t i = 0; i < 400; ++i) {
    const auto u = random_uniforms({21, Stream::Tests}, i);
    frame.position.push_back({6 * u[0], 5 * u[1], 7 * u[2]});
    radius.push_back(0.05 + 0.2 * u[3]);
  }
  Parameters parameters;
  parameters.separation_limit = 0.2;
  parameters.separation_bins = 8;
  const SeparationDevelopment d = measure_separations(one_frame(frame), radius, parameters);
  std::vector<double> count(8, 0.0);
  std::int64_t overlaps = 0, near = 0, near_10nm = 0;
  for (std::size_t i = 0; i < 400; ++i)
    for (std::size_t j = i + 1; j < 400; ++j) {
      Vec3 r = frame.position[j] - frame.position[i];
      r.x() -= 6 * std::round(r.x() / 6);
      r.y() -= 5 * std::round(r.y() / 5);
      const double gap = r.norm() - radius[i] - radius[j];
      if (gap < 0) ++overlaps;
      if (gap < 0.2) count[static_cast<std::size_t>(std::max(0.0, gap) / 0.025)] += 1;
      if (gap < 0.05) ++near;
      if (gap < 0.01) ++near_10nm;
    }
  const Separations& s = d.frames[0];
  EXPECT_EQ(s.count, count);
  EXPECT_EQ(s.overlaps, overlaps);
  EXPECT_EQ(s.near_pairs, near);
  EXPECT_NEAR(s.near_cumulative[0] * static_cast<double>(near), static_cast<double>(overlaps), 1e-9);
  EXPECT_NEAR(s.near_cumulative[10] * static_cast<double>(near), static_cast<double>(near_10nm), 1e-9);
  EXPECT_DOUBLE_EQ(s.near_cumulative.back(), 1);
}

TEST(Separations, WithoutPairsAreZeroNotUndefined) {
  Snapshot frame;
  frame.cell = {50, 50, 50};
  frame.position = {{1, 1, 1}, {20, 20, 20}};
  const SeparationDevelopment d = measure_separations(one_frame(frame), {0.5, 0.6}, Parameters{});
  EXPECT_EQ(d.frames[0].pairs, 0);
  EXPECT_EQ(d.frames[0].mean, 0);
  EXPECT_DOUBLE_EQ(d.frames[0].smallest, d.limit);
  for (double x : d.frames[0].density) EXPECT_EQ(x, 0);
  for (double x : d.frames[0].near_cumulative) EXPECT_EQ(x, 0);
}

}  // namespace
}  // namespace pigment::analysis
