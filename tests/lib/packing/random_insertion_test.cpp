#include "packing/random_insertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pigment::packing {
namespace {

// Deepest overlap over all pairs and images.
double deepest_overlap(const Slab& slab, const std::vector<double>& radius, const Vec3Array& centre) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < radius.size(); ++i)
    for (std::size_t j = i + 1; j < radius.size(); ++j)
      for (int p = -1; p <= 1; ++p)
        for (int q = -1; q <= 1; ++q) {
          const Vec3 d = centre[j] - centre[i] + Vec3(p * slab.width, q * slab.width, 0);
          deepest = std::max(deepest, radius[i] + radius[j] - d.norm());
        }
  return deepest;
}

TEST(RandomInsertion, LeavesNoOverlapWhereThereIsRoom) {
  const Slab slab{4.1, 0.5, 6};
  std::vector<double> kept;  // 1:100, a quarter of the room
  for (int i = 0; i < 400; ++i) kept.push_back(std::pow(0.01, i / 399.0));
  kept.erase(kept.begin() + 1, kept.begin() + 50);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Insertion insertion = insert_largest_first(slab, kept, seed);
    ASSERT_EQ(insertion.overlapping, 0u);
    EXPECT_LE(deepest_overlap(slab, kept, insertion.centre), 0);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      EXPECT_GE(insertion.centre[i].z(), slab.bottom + kept[i]);
      EXPECT_LE(insertion.centre[i].z(), slab.top - kept[i]);
    }
  }
}

TEST(RandomInsertion, CountsThoseThatFoundNoPlace) {
  // Eight spheres fill half of the slab, past the 38 % at which random insertion of equal spheres jams.
  const Slab slab{2.0, 0, 2.0};
  const std::vector<double> radius(8, 0.5);
  const Insertion insertion = insert_largest_first(slab, radius, 1);
  EXPECT_GT(insertion.overlapping, 0u);
  EXPECT_EQ(insertion.centre.size(), 8u);
  EXPECT_GT(deepest_overlap(slab, radius, insertion.centre), 0);
}

TEST(RandomInsertion, TakesTheFirstFreePlaceOfASingleSphereEvenly) {
  // One sphere among nothing: its height is uniform over the room between the planes. Kolmogorov's 99.9 %
  // point for 1000 seeds: 1.95/sqrt(1000) = 0.0617, a false alarm in a thousand (the seeds are fixed).
  std::vector<double> height;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed)
    height.push_back((insert_largest_first({3, 1, 5}, {0.5}, seed).centre[0].z() - 1.5) / 3);
  std::sort(height.begin(), height.end());
  double distance = 0;
  for (std::size_t k = 0; k < height.size(); ++k)
    distance = std::max({distance, std::abs(height[k] - k / 1000.0), std::abs(height[k] - (k + 1) / 1000.0)});
  EXPECT_LT(distance, 0.0617);
}

}  // namespace
}  // namespace pigment::packing
