#include "analysis/clusters.h"

#include <gtest/gtest.h>

#include <map>
#include <queue>

#include "base/error.h"
#include "base/random.h"

namespace pigment::analysis {
namespace {

std::vector<std::int64_t> ids(std::size_t count, std::int64_t first = 0) {
  std::vector<std::int64_t> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(first + static_cast<std::int64_t>(i));
  return result;
}

TEST(Clusters, JoinAcrossThePeriodicBoundary) {
  // 0-1 across x, 1-2 across y and several periods away, 3 alone, 4-5 touching.
  Snapshot frame;
  frame.cell = {10, 10, 10};
  frame.position = {{0.2, 5, 2}, {9.19, 5, 2}, {9.19 + 30, 5 + 1.01 - 20, 2},
                    {5, 0.1, 8}, {4, 4, 5},    {4, 4, 6}};
  const std::vector<double> radius(6, 0.5);
  const Clusters c = find_clusters(frame, radius, {50, 40, 60, 10, 70, 20}, 0.02);
  EXPECT_EQ(c.id, (std::vector<std::int64_t>{40, 40, 40, 10, 20, 20}));
  EXPECT_EQ(c.size, (std::vector<std::int64_t>{3, 3, 3, 1, 2, 2}));
  EXPECT_EQ(c.neighbours, (std::vector<std::int64_t>{1, 2, 1, 0, 1, 1}));
  EXPECT_EQ(c.count, 2);
  EXPECT_EQ(c.connections, 3);
  EXPECT_EQ(c.largest, 3);
  EXPECT_DOUBLE_EQ(c.clustered_fraction, 5.0 / 6);
  EXPECT_DOUBLE_EQ(c.clustered_volume_fraction, 5.0 / 6);
  EXPECT_DOUBLE_EQ(c.extent[0], 1);
  EXPECT_DOUBLE_EQ(c.extent[4], 2);
  EXPECT_DOUBLE_EQ(c.largest_extent, 2);
  EXPECT_FALSE(c.percolates);
  // Gaps of 1.01 um less a diameter, and of nothing.
  ASSERT_EQ(c.pairs.size(), 3u);
  EXPECT_EQ(c.pairs[0].first, 0);
  EXPECT_EQ(c.pairs[0].second, 1);
  EXPECT_NEAR(c.pairs[0].separation, 0.01, 1e-14);
  EXPECT_EQ(c.pairs[1].second, 2);
  EXPECT_NEAR(c.pairs[1].separation, 0.01, 1e-14);
  EXPECT_EQ(c.pairs[2].first, 4);
  EXPECT_NEAR(c.pairs[2].separation, 0, 1e-14);
  EXPECT_EQ(c.coordination, (std::vector<std::int64_t>{1, 4, 1}));
  EXPECT_DOUBLE_EQ(c.mean_coordination, 1);
}

TEST(Clusters, OfACubicLatticeHaveItsCoordination) {
  // 5 x 5 x 5 touching spheres, periodic in x and y: six neighbours inside, five in the lowest and highest plane.
  Snapshot frame;
  frame.cell = {5, 5, 5};
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z) frame.position.push_back({x + 0.5, y + 0.5, z + 0.5});
  const Clusters c = find_clusters(frame, std::vector<double>(125, 0.495), ids(125), 0.02);
  EXPECT_EQ(c.coordination, (std::vector<std::int64_t>{0, 0, 0, 0, 0, 50, 75}));
  EXPECT_DOUBLE_EQ(c.mean_coordination, (50 * 5 + 75 * 6) / 125.0);
  EXPECT_EQ(c.count, 1);
  EXPECT_TRUE(c.percolates);
  for (const Connection& pair : c.pairs) EXPECT_NEAR(pair.separation, 0.01, 1e-14);
}

TEST(Clusters, OfSpheresAtRandomHaveThePoissonCoordination) {
  // Points at random, one a um^3, have 4/3 pi d^3 others closer than d, less what the faces take: 1 - 3 d/(8 H) of it.
  Snapshot frame;
  const double height = 40, closer = 0.8;
  frame.cell = {20, 20, height};
  for (std::size_t i = 0; i < 16000; ++i) {
    const auto u = random_uniforms({41, Stream::Tests}, i);
    frame.position.push_back({20 * u[0], 20 * u[1], height * u[2]});
  }
  const Clusters c = find_clusters(frame, std::vector<double>(16000, 0.001), ids(16000), closer - 0.002);
  const double expected = 4.0 / 3 * 3.141592653589793 * std::pow(closer, 3) * (1 - 3 * closer / (8 * height));
  // The number of pairs is all but Poisson: four of its standard deviations, exceeded once in 16,000.
  const double deviation = 2 / 16000.0 * std::sqrt(16000 * expected / 2);
  EXPECT_NEAR(c.mean_coordination, expected, 4 * deviation);
  // A share exp(-expected) has none.
  const double alone = 16000 * std::exp(-expected);
  EXPECT_NEAR(static_cast<double>(c.coordination[0]), alone, 4 * std::sqrt(alone) * 1.5);  // neighbours are shared
}

TEST(Clusters, CakeHeightIsThatOfAPlantedDeposit) {
  // Columns of touching spheres: 3 high where x < 4, 1 high elsewhere, periodic; one sphere floats above, one hovers 0.1
  // above a low column. Each column's axis goes through the middle of its spheres.
  Snapshot frame;
  frame.cell = {8, 4, 12};
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < (x < 4 ? 3 : 1); ++z) frame.position.push_back({x + 0.5 - 16, y + 0.5 + 4, z + 0.5});
  frame.position.push_back({6.5, 3.5, 9});
  frame.position.push_back({5.5, 2.5, 1.6});
  const std::size_t count = frame.position.size();
  const ColumnGrid columns = columns_of(frame.cell, 1.1);
  EXPECT_EQ(columns.x, 7u);
  const ColumnGrid grid{8, 4};
  const Clusters c = find_clusters(frame, std::vector<double>(count, 0.5), ids(count), 0.02, grid);
  ASSERT_EQ(c.cake_height.size(), 32u);
  for (std::size_t x = 0; x < 8; ++x)
    for (std::size_t y = 0; y < 4; ++y) EXPECT_NEAR(c.cake_height[4 * x + y], x < 4 ? 3 : 1, 1e-12);
  EXPECT_NEAR(c.mean_cake_height, 2, 1e-12);
  EXPECT_NEAR(c.cake_roughness, 1, 1e-12);
  // A wider threshold takes in what hovers, not what floats.
  const Clusters wide = find_clusters(frame, std::vector<double>(count, 0.5), ids(count), 0.11, grid);
  EXPECT_NEAR(wide.cake_height[4 * 5 + 2], 2.1, 1e-12);
  EXPECT_NEAR(wide.cake_height[4 * 6 + 3], 1, 1e-12);
}

TEST(Clusters, PercolateFromAFrameOn) {
  // The sphere that closes the chain arrives in the fourth frame, at 30 ms.
  const Frames frames{6, [](std::size_t k) {
                        Snapshot s;
                        s.time = 10.0 * static_cast<double>(k);
                        s.cell = {5, 5, 3};
                        s.position = {{1, 1, 0.5}, {k < 3 ? 2.2 : 1.0, 1, 1.5}, {1, 1, 2.5}};
                        return s;
                      }};
  const auto clusters = find_clusters(frames, {0.5, 0.5, 0.5}, ids(3), 0.02);
  EXPECT_EQ(percolation_time(clusters), 30);
  EXPECT_EQ(percolation_time({clusters[0], clusters[1]}), std::nullopt);
}

TEST(Clusters, EndAtTheThreshold) {
  Snapshot frame;
  frame.cell = {10, 10, 10};
  frame.position = {{5, 5, 2}, {6.0199, 5, 2}, {5, 6.0201, 2}};
  EXPECT_EQ(find_clusters(frame, {0.5, 0.5, 0.5}, ids(3), 0.02).size, (std::vector<std::int64_t>{2, 2, 1}));
}

TEST(Clusters, PercolateFromSubstrateToSurface) {
  Snapshot frame;
  frame.cell = {5, 5, 4};
  for (int k = 0; k < 4; ++k) frame.position.push_back({1, 1, 0.5 + k});
  const std::vector<double> radius(4, 0.5);
  EXPECT_TRUE(find_clusters(frame, radius, ids(4), 0.02).percolates);
  frame.cell.height = 4.03;
  EXPECT_FALSE(find_clusters(frame, radius, ids(4), 0.02).percolates);
  frame.cell.height = 4;
  frame.position[2].x() += 0.3;  // the chain parts
  frame.position[3].x() += 0.3;
  EXPECT_FALSE(find_clusters(frame, radius, ids(4), 0.02).percolates);
}

TEST(Clusters, AgreeWithAFloodFillOverAllPairs) {
  // 600 spheres of very unequal size in a cell with many clusters; an independent search over all pairs.
  Snapshot frame;
  frame.cell = {8, 7, 9};
  std::vector<double> radius;
  for (std::size_t i = 0; i < 600; ++i) {
    const auto u = random_uniforms({3, Stream::Tests}, i);
    frame.position.push_back({40 * u[0] - 20, 35 * u[1] - 14, 9 * u[2]});
    radius.push_back(0.05 * std::pow(10, u[3]));
  }
  const auto id = ids(600, 1000);
  const Clusters c = find_clusters(frame, radius, id, 0.05);
  std::vector<std::int64_t> expected(600, -1);
  for (std::size_t start = 0; start < 600; ++start) {
    if (expected[start] >= 0) continue;
    std::queue<std::size_t> open({start});
    expected[start] = id[start];
    for (; !open.empty(); open.pop())
      for (std::size_t j = 0; j < 600; ++j) {
        const std::size_t i = open.front();
        Vec3 d = frame.position[j] - frame.position[i];
        d.x() -= 8 * std::round(d.x() / 8);
        d.y() -= 7 * std::round(d.y() / 7);
        if (expected[j] < 0 && d.norm() - radius[i] - radius[j] < 0.05) {
          expected[j] = id[start];
          open.push(j);
        }
      }
  }
  EXPECT_EQ(c.id, expected);
  std::map<std::int64_t, std::int64_t> size;
  for (std::int64_t root : expected) ++size[root];
  for (std::size_t i = 0; i < 600; ++i) EXPECT_EQ(c.size[i], size[expected[i]]);
  EXPECT_GT(c.count, 20);  // the test would say little with one cluster
}

TEST(Clusters, DoNotDependOnTheOrderOfParticles) {
  Snapshot frame, reversed;
  frame.cell = reversed.cell = {6, 6, 6};
  std::vector<double> radius(300, 0.3);
  for (std::size_t i = 0; i < 300; ++i) {
    const auto u = random_uniforms({4, Stream::Tests}, i);
    frame.position.push_back({6 * u[0], 6 * u[1], 6 * u[2]});
  }
  reversed.position.assign(frame.position.rbegin(), frame.position.rend());
  const auto id = ids(300);
  const std::vector<std::int64_t> reversed_id(id.rbegin(), id.rend());
  const Clusters a = find_clusters(frame, radius, id, 0.02),
                 b = find_clusters(reversed, radius, reversed_id, 0.02);
  EXPECT_EQ(a.id, std::vector<std::int64_t>(b.id.rbegin(), b.id.rend()));
}

TEST(Clusters, OfNothingAndOfOne) {
  Snapshot frame;
  frame.cell = {5, 5, 5};
  EXPECT_EQ(find_clusters(frame, {}, {}, 0.02).largest, 0);
  frame.position = {{1, 1, 1}};
  const Clusters one = find_clusters(frame, {0.5}, {9}, 0.02);
  EXPECT_EQ(one.id, std::vector<std::int64_t>{9});
  EXPECT_EQ(one.count, 0);
  EXPECT_EQ(one.largest, 1);
  EXPECT_EQ(one.largest_extent, 0);
}

TEST(Clusters, PassOnWhatGoesWrongInAFrame) {
  const Frames frames{40, [](std::size_t k) {
                        Snapshot s;
                        s.cell = {5, 5, 5};
                        s.position = {{1, 1, k == 30 ? std::nan("") : 1.0}, {2, 2, 2}};
                        return s;
                      }};
  EXPECT_THROW(find_clusters(frames, {0.5, 0.5}, ids(2), 0.02), NumericsError);
}

}  // namespace
}  // namespace pigment::analysis
