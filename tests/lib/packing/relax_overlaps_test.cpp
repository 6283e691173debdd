#include "packing/relax_overlaps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace pigment::packing {
namespace {

TEST(RelaxOverlaps, PartsTwoSpheresAcrossThePeriod) {
  const Slab slab{3, 0, 3};
  Vec3Array centre{{0.1, 1.5, 1.5}, {2.9, 1.5, 1.5}};  // 0.2 apart across x = 0
  const Relaxation result = relax_overlaps(slab, {0.5, 0.5}, centre);
  EXPECT_TRUE(result.done);
  const Vec3 d = slab.cell().minimum_image(centre[1] - centre[0]);
  EXPECT_GE(d.norm(), 1);
  // Forces are central and equal: neither the mid-point nor the direction changes.
  EXPECT_NEAR(slab.cell().minimum_image(0.5 * d + centre[0] - Vec3(0, 1.5, 1.5)).norm(), 0, 1e-12);
  EXPECT_NEAR(std::abs(d.x()), d.norm(), 1e-12);
}

TEST(RelaxOverlaps, PartsConcentricSpheres) {
  Vec3Array centre{{1, 1, 1}, {1, 1, 1}};
  EXPECT_TRUE(relax_overlaps({4, 0, 4}, {0.5, 0.2}, centre).done);
  EXPECT_GE((centre[1] - centre[0]).norm(), 0.7);
}

TEST(RelaxOverlaps, LeavesWhatDoesNotOverlap) {
  Vec3Array centre{{1, 1, 1}, {1, 1, 3}};
  const Vec3Array before = centre;
  const Relaxation result = relax_overlaps({4, 0, 4}, {0.5, 0.5}, centre);
  EXPECT_TRUE(result.done);
  EXPECT_EQ(result.steps, 0);
  EXPECT_EQ(centre, before);
}

TEST(RelaxOverlaps, SaysThatItCannot) {
  // Six spheres of 1 um in a slab of 2.1 x 2.1 x 1.1 um: one layer, whose discs alone (6 pi/4 = 4.7 um2, 1 %
  // less for the slack in height) are larger than its area of 4.4 um2.
  Vec3Array centre;
  for (int i = 0; i < 6; ++i) {
    const auto u = random_uniforms({1, Stream::Tests}, i);
    centre.emplace_back(2.1 * u[0], 2.1 * u[1], 0.55);
  }
  const Relaxation result = relax_overlaps({2.1, 0, 1.1}, std::vector<double>(6, 0.5), centre);
  EXPECT_FALSE(result.done);
  EXPECT_GT(result.largest_overlap, 0);
}

}  // namespace
}  // namespace pigment::packing
