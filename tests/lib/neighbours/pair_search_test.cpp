#include "neighbours/pair_search.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/random.h"

namespace pigment::neighbours {
namespace {

constexpr RandomKey key{7, Stream::Tests};

struct Spheres {
  Cell cell;
  Vec3Array position;
  std::vector<double> radius;
};

// Radii log-uniform over the ratio; centres anywhere in a box, unwrapped by up to `periods` periods.
Spheres random_spheres(std::uint64_t variant, int count, Cell cell, double largest, double ratio,
                       int periods) {
  Spheres s{cell, {}, {}};
  for (int i = 0; i < count; ++i) {
    const auto u = random_uniforms(key, variant, i, 0), v = random_uniforms(key, variant, i, 1);
    s.radius.push_back(largest * std::pow(ratio, -u[0]));
    s.position.emplace_back((u[1] + std::floor((2 * v[0] - 1) * periods)) * cell.width_x,
                            (u[2] + std::floor((2 * v[1] - 1) * periods)) * cell.width_y, u[3] * cell.height);
  }
  return s;
}

// Independent of the grid: every pair, the nearest of 3 x 3 images of the wrapped positions.
std::vector<IndexPair> brute_force(const Spheres& s, const PairRange& range) {
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < s.radius.size(); ++i)
    for (std::size_t j = i + 1; j < s.radius.size(); ++j) {
      const Vec3 d = s.cell.wrap(s.position[j]) - s.cell.wrap(s.position[i]);
      double nearest = std::numeric_limits<double>::infinity();
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b)
          nearest = std::min(nearest, (d + Vec3(a * s.cell.width_x, b * s.cell.width_y, 0)).norm());
      const double gap = nearest - s.radius[i] - s.radius[j];
      const double smaller = std::min(s.radius[i], s.radius[j]);
      if (gap < std::max(range.per_smaller_radius * smaller, range.at_least) + range.skin)
        pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
    }
  return pairs;
}

TEST(PairSearch, AgreesWithBruteForceForAnySizeRatio) {
  std::uint64_t variant = 0;
  for (const double ratio : {1.0, 8.0, 100.0})
    for (const PairRange range : {PairRange{0.1, 0.03, 0.01}, PairRange{2, 0, 0}, PairRange{0, 0.3, 0}})
      for (const int periods : {0, 50}) {
        const Spheres s = random_spheres(++variant, 700, {5, 4, 9}, 1.0, ratio, periods);
        const auto expected = brute_force(s, range);
        ASSERT_GT(expected.size(), 100u);
        EXPECT_EQ(find_pairs(s.cell, s.position, s.radius, range), expected)
            << "ratio " << ratio << " periods " << periods;
      }
}

TEST(PairSearch, ListsEachPairOnceInCellsTwoDiametersWide) {
  // Widths of two largest diameters leave one or two cells across, where a search meets itself from behind.
  for (std::uint64_t variant = 100; variant < 120; ++variant) {
    const Spheres s = random_spheres(variant, 60, {4.0, 4.1, 3}, 1.0, variant % 2 ? 1.2 : 30, 3);
    const PairRange range{1.0, 0.2, 0.1};
    EXPECT_EQ(find_pairs(s.cell, s.position, s.radius, range), brute_force(s, range));
  }
}

TEST(PairSearch, FindsASmallSphereBesideAWallOfLargeOnes) {
  // A ratio of 100 with the pair across the periodic boundary and at a gap just inside, then just outside,
  // the limit.
  const Cell cell{10, 10, 10};
  const std::vector<double> radius{1.0, 0.01};
  const double limit = 0.004;
  for (const double nudge : {-1e-9, 1e-9}) {
    const Vec3Array position{{0.5, 5, 5}, {0.5 - 1.01 - limit - nudge + 70, 5, 5}};
    EXPECT_EQ(find_pairs(cell, position, radius, {0.2, 0.004, 0}).size(), nudge < 0 ? 1u : 0u);
  }
}

TEST(PairSearch, SurvivesSpheresFarAboveTheLayer) {
  Spheres s = random_spheres(300, 500, {5, 5, 5}, 0.5, 10, 0);
  s.position[17].z() = 1e7;
  s.position[18].z() = -1e7;
  const PairRange range{0.5, 0.01, 0};
  EXPECT_EQ(find_pairs(s.cell, s.position, s.radius, range), brute_force(s, range));
}

TEST(PairSearch, DoesNotDependOnTheNumberOfThreads) {
  const Spheres s = random_spheres(400, 3000, {5, 5, 10}, 0.5, 20, 2);
  const PairRange range{0.5, 0.02, 0.01};
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = find_pairs(s.cell, s.position, s.radius, range);
  omp_set_num_threads(3);
  const auto three = find_pairs(s.cell, s.position, s.radius, range);
  omp_set_num_threads(before);
  EXPECT_EQ(one, three);
}

TEST(PairSearch, HasNothingToFindAmongNoneOrOne) {
  EXPECT_TRUE(find_pairs({5, 5, 5}, {}, {}, {1, 1, 0}).empty());
  EXPECT_TRUE(find_pairs({5, 5, 5}, {{1, 1, 1}}, {0.5}, {1, 1, 0}).empty());
}

TEST(PairSearch, RefusesAPositionThatIsNotANumber) {
  const Vec3Array position{{1, 1, 1}, {1, std::nan(""), 1}};
  EXPECT_THROW(find_pairs({5, 5, 5}, position, {0.5, 0.5}, {1, 1, 0}), NumericsError);
}

}  // namespace
}  // namespace pigment::neighbours
