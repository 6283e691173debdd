#include "analysis/mobility.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/random.h"

namespace pigment::analysis {
namespace {

double integral(const std::vector<double>& density, const std::vector<double>& edges) {
  return (edges[1] - edges[0]) * std::accumulate(density.begin(), density.end(), 0.0);
}

// 1,000 particles, two sizes, in a 10 x 10 x 10 um layer; those of the upper half move by (0.03, 0, -0.04) um
// a frame (0.05 um in all), those of the lower half rest. Frames 2 ms apart.
Frames planted(std::size_t count) {
  return {count, [](std::size_t k) {
            Snapshot s;
            s.time = 2.0 * static_cast<double>(k);
            s.cell = {10, 10, 10};
            for (std::size_t i = 0; i < 1000; ++i) {
              const auto u = random_uniforms({31, Stream::Tests}, i);
              Vec3 p{10 * u[0], 10 * u[1], i % 2 ? 6 + 3 * u[2] : 1 + 3 * u[2]};
              if (i % 2) p += static_cast<double>(k) * Vec3{0.03, 0, -0.04};
              s.position.push_back(p);
            }
            return s;
          }};
}
const std::vector<double>& planted_radius() {
  static const std::vector<double> radius = [] {
    std::vector<double> r;
    for (int i = 0; i < 1000; ++i) r.push_back(i % 4 < 2 ? 0.125 : 0.4);
    return r;
  }();
  return radius;
}

TEST(Mobility, FindsAPlantedDisplacement) {
  Parameters parameters;
  parameters.height_bands = 2;
  parameters.surface_band = {1.5, 4.5};  // heights 5.5 to 8.5
  parameters.displacement_limit = 0.1;
  parameters.displacement_bins = 20;  // 5 nm
  const Mobility m = measure_mobility(planted(4), {0, 1, 2, 3}, planted_radius(), parameters);
  ASSERT_EQ(m.intervals.size(), 3u);
  for (const MobilityInterval& interval : m.intervals) {
    ASSERT_EQ(interval.all_sizes.size(), 3u);
    const Displacements& low = interval.all_sizes[0];
    const Displacements& high = interval.all_sizes[1];
    EXPECT_EQ(low.particles, 500);
    EXPECT_EQ(high.particles, 500);
    EXPECT_EQ(low.rms_vertical, 0);
    EXPECT_NEAR(low.absolute[0], 1 / 0.005, 1e-9);
    EXPECT_NEAR(high.mean_absolute, 0.05, 1e-12);
    EXPECT_NEAR(high.mean_vertical, -0.04, 1e-12);
    EXPECT_NEAR(high.rms_vertical, 0.04, 1e-12);
    EXPECT_NEAR(high.rms_lateral, 0.03 / std::sqrt(2), 1e-12);
    // Displacements on bin edges may fall to either side; two bins hold each.
    EXPECT_NEAR(0.005 * (high.absolute[9] + high.absolute[10]), 1, 1e-12);
    EXPECT_NEAR(0.005 * (high.vertical[7] + high.vertical[8]), 1, 1e-12);
    EXPECT_NEAR(0.005 * (high.lateral[5] + high.lateral[6]), 0.5, 1e-12);
    EXPECT_NEAR(0.005 * high.lateral[0], 0.5, 1e-12);
    EXPECT_NEAR(interval.speed[0], 0, 1e-15);
    EXPECT_NEAR(interval.speed[1], 0.025, 1e-12);
    // Classes <= 0.3 um and 0.5..1 um hold a half each.
    EXPECT_EQ(interval.by_size_and_height[0][1].particles, 250);
    EXPECT_EQ(interval.by_size_and_height[1][1].particles, 0);
    EXPECT_EQ(interval.by_size_and_height[2][1].particles, 250);
    EXPECT_EQ(integral(interval.by_size_and_height[1][1].absolute, m.edges), 0);
    EXPECT_NEAR(interval.all_sizes[2].mean_vertical, -0.04, 1e-12);
  }
  EXPECT_NEAR(m.displacement[1], 0.15, 1e-12);
  EXPECT_NEAR(m.speed[1], 0.025, 1e-12);
  EXPECT_EQ(m.displacement[0], 0);
}

TEST(Mobility, AutomaticLimitLosesNothing) {
  const Mobility m = measure_mobility(planted(3), {0, 2}, planted_radius(), Parameters{});
  EXPECT_NEAR(m.edges.back(), 0.1, 1e-9);
  for (const Displacements& d : m.intervals[0].all_sizes)
    if (d.particles > 0) {
      EXPECT_NEAR(integral(d.absolute, m.edges), 1, 1e-12);
      EXPECT_NEAR(integral(d.vertical, m.edges), 1, 1e-12);
      EXPECT_NEAR(integral(d.lateral, m.edges), 1, 1e-12);
    }
}

TEST(Mobility, OfRestingParticlesIsZeroNotUndefined) {
  Frames resting{2, [](std::size_t k) {
                   Snapshot s = planted(1).read(0);
                   s.time = static_cast<double>(k);
                   return s;
                 }};
  const Mobility m = measure_mobility(resting, {0, 1}, planted_radius(), Parameters{});
  EXPECT_GT(m.edges.back(), 0);
  EXPECT_EQ(m.intervals[0].all_sizes[0].mean_absolute, 0);
}

TEST(ChooseFrames, TakesTheWindowAndTheNearestMultiples) {
  std::vector<double> time;
  for (int k = 0; k <= 20; ++k) time.push_back(5.0 * k);
  Parameters parameters;
  EXPECT_EQ(choose_frames(time, parameters).size(), 21u);
  parameters.mobility_start = 10;
  parameters.mobility_end = 50;
  EXPECT_EQ(choose_frames(time, parameters), (std::vector<std::size_t>{2, 3, 4, 5, 6, 7, 8, 9, 10}));
  parameters.mobility_interval = 20;
  EXPECT_EQ(choose_frames(time, parameters), (std::vector<std::size_t>{2, 6, 10}));
  parameters.mobility_interval =
      12;  // 22, 34, 46 ms: frames at 20, 35, 45 ms; 50 ms is farther from 46 than 45 is
  EXPECT_EQ(choose_frames(time, parameters), (std::vector<std::size_t>{2, 4, 7, 9}));
  parameters.mobility_interval = 25;  // 35 ms; 60 ms lies outside
  EXPECT_EQ(choose_frames(time, parameters), (std::vector<std::size_t>{2, 7}));
  parameters.mobility_interval = 1;  // finer than the frames: each of them
  EXPECT_EQ(choose_frames(time, parameters).size(), 9u);
  parameters.mobility_interval = 1000;
  EXPECT_EQ(choose_frames(time, parameters).size(), 1u);
  EXPECT_TRUE(choose_frames({}, parameters).empty());
}

}  // namespace
}  // namespace pigment::analysis
