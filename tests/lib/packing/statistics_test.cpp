#include "packing/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace pigment::packing {
namespace {

Layer two_spheres() {
  Layer layer;
  layer.cell = {4, 4, 6};
  layer.particles.radius = {1.0, 0.5};
  layer.particles.mass = {2.7e-3 * 4.0 / 3 * std::numbers::pi, 2.7e-3 / 6 * std::numbers::pi};
  layer.particles.species = {0, 0};
  layer.particles.id = {0, 1};
  layer.position = {{0.2, 2, 1.25}, {3.8 + 4, 2, 4}};
  return layer;
}

TEST(Statistics, KolmogorovProbabilityAtItsTabulatedPoints) {
  // Critical values of Kolmogorov's limiting distribution: 1.3581 at 5 %, 1.6276 at 1 %.
  EXPECT_NEAR(kolmogorov_probability(1.3581 / 1e4, 1e8), 0.05, 1e-4);
  EXPECT_NEAR(kolmogorov_probability(1.6276 / 1e4, 1e8), 0.01, 1e-4);
  // n = 10: 0.409 at 5 % in the tables of the exact distribution, which the correction meets within 1 %.
  EXPECT_NEAR(kolmogorov_probability(0.409, 10), 0.05, 1e-3);
  EXPECT_EQ(kolmogorov_probability(0, 100), 1);
  EXPECT_EQ(kolmogorov_probability(1, 1000), 0);
}

TEST(Statistics, DistanceIsTheLargestOfBothSidesOfEachStep) {
  SizeLaw law;
  law.kind = SizeLaw::Kind::Lognormal;
  law.median = 1, law.geometric_standard_deviation = 2, law.min = 0.25, law.max = 4;
  const SizeDistribution sizes(law);
  // One particle at the quantile 0.3: the step is 0.7 away from the law at its top.
  const double d = sizes.diameter_at_number(0.3);
  EXPECT_NEAR(compare_numbers({d}, sizes).distance, 0.7, 1e-12);
  EXPECT_NEAR(compare_weights({d}, sizes).distance,
              std::max(sizes.weight_below(d), 1 - sizes.weight_below(d)), 1e-12);
  // A wrong sample is caught: 500 particles of one size.
  EXPECT_LT(compare_numbers(std::vector<double>(500, d), sizes).p_value, 1e-12);
}

TEST(Statistics, FindsTheSmallestGapAcrossThePeriod) {
  const Layer layer = two_spheres();
  const SmallestGaps gaps = smallest_gaps(layer);
  EXPECT_NEAR(gaps.particles, std::hypot(0.4, 2.75) - 1.5, 1e-14);
  EXPECT_NEAR(gaps.substrate, 0.25, 1e-15);
  EXPECT_NEAR(gaps.surface, 1.5, 1e-15);
  Layer alone = layer;
  alone.particles.radius.resize(1), alone.position.resize(1);
  EXPECT_EQ(smallest_gaps(alone).particles, std::numeric_limits<double>::infinity());
}

TEST(Statistics, SolidsByHand) {
  const Layer layer = two_spheres();
  const Solids solids = solids_of(layer, 1e-3);
  const double volume = 4.0 / 3 * std::numbers::pi * 1.125;
  EXPECT_NEAR(solids.volume_fraction, volume / 96, 1e-15);
  EXPECT_NEAR(solids.mass_fraction, 2.7 * volume / (2.7 * volume + 96 - volume), 1e-15);
  EXPECT_NEAR(solids.coat_weight, 2.7e-3 * volume / 16, 1e-15);
}

TEST(Statistics, ProfileHoldsAllSolids) {
  const ProfileFlatness profile = measure_flatness(two_spheres(), 24);
  double volume = 0;
  for (std::size_t s = 0; s < 24; ++s)
    volume += profile.volume_fraction[s] * 16 * (profile.edges[s + 1] - profile.edges[s]);
  EXPECT_NEAR(volume, 4.0 / 3 * std::numbers::pi * 1.125, 1e-13);
  // Cap of the large sphere from 0.25 to 1 um: pi h^2 (3 a - h)/3 with h = 0.75.
  EXPECT_NEAR(profile.outer_bottom * 16, std::numbers::pi * 0.5625 * 2.25 / 3, 1e-14);
  EXPECT_EQ(profile.outer_top, 0);
}

}  // namespace
}  // namespace pigment::packing
