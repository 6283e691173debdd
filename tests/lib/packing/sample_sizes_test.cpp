#include "packing/sample_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "packing/impossible.h"
#include "packing/statistics.h"

namespace pigment::packing {
namespace {

Species fine_carbonate(double parts = 100) {
  Species s;
  s.name = "carbonate", s.parts = parts;
  s.size.kind = SizeLaw::Kind::Lognormal;
  s.size.median = 0.222511, s.size.geometric_standard_deviation = 7.05392;
  s.size.min = 0.25, s.size.max = 2;
  return s;
}
Species latex(double parts) {
  Species s;
  s.name = "latex", s.parts = parts, s.density = 1e-3;
  s.size.diameter = 0.15;
  return s;
}

TEST(SampleSizes, FollowTheLawByNumberAndByWeight) {
  const std::vector<Species> species{fine_carbonate()};
  const std::vector<SizeDistribution> sizes{SizeDistribution(species[0].size)};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Particles particles = sample_particles(species, sizes, 200, seed);
    std::vector<double> diameter;
    double volume = 0;
    for (const double a : particles.radius) {
      diameter.push_back(2 * a);
      volume += Particles::sphere_volume(a);
    }
    // A stratified sample never leaves the number curve by more than one part in N.
    EXPECT_LE(compare_numbers(diameter, sizes[0]).distance, 1.0 / diameter.size() + 1e-9);
    // By weight a stratum near the top spreads over at most its own share.
    EXPECT_GT(compare_weights(diameter, sizes[0]).p_value, 0.5);
    // Independent draws would scatter by 7 % here; the strata bring it to a fraction of a per cent.
    EXPECT_NEAR(volume / 200, 1, 0.01) << seed;
  }
}

TEST(SampleSizes, SingleStrataAreDrawnAtRandom) {
  // A law of one particle is drawn anew for each seed: over 400 seeds its quantiles are uniform. False alarm:
  // 1e-4.
  const std::vector<Species> species{fine_carbonate()};
  const std::vector<SizeDistribution> sizes{SizeDistribution(species[0].size)};
  std::vector<double> diameter;
  for (std::uint64_t seed = 1; seed <= 400; ++seed)
    diameter.push_back(2 * sample_particles(species, sizes, sizes[0].mean_volume(), seed).radius.at(0));
  EXPECT_GT(compare_numbers(diameter, sizes[0]).p_value, 1e-4);
}

TEST(SampleSizes, MixByWeight) {
  const std::vector<Species> species{fine_carbonate(100), latex(10)};
  const std::vector<SizeDistribution> sizes{SizeDistribution(species[0].size),
                                            SizeDistribution(species[1].size)};
  const Particles particles = sample_particles(species, sizes, 100, 1);
  double mass[2] = {0, 0};
  for (std::size_t i = 0; i < particles.size(); ++i) mass[particles.species[i]] += particles.mass[i];
  // The carbonate's mass is sampled to a per cent or so; the latex's is rounded to a particle out of ten
  // thousand.
  EXPECT_NEAR(mass[1] / mass[0], 0.1, 0.002);
  EXPECT_TRUE(std::is_sorted(particles.radius.rbegin(), particles.radius.rend()));
  for (std::size_t i = 0; i < particles.size(); ++i) ASSERT_EQ(particles.id[i], static_cast<std::int64_t>(i));
}

TEST(SampleSizes, RefuseNoneAndTooMany) {
  const std::vector<Species> species{fine_carbonate()};
  const std::vector<SizeDistribution> sizes{SizeDistribution(species[0].size)};
  EXPECT_THROW(sample_particles(species, sizes, 0.1 * sizes[0].mean_volume(), 1), Impossible);
  EXPECT_THROW(sample_particles(species, sizes, 1e8 * sizes[0].mean_volume(), 1), Impossible);
}

}  // namespace
}  // namespace pigment::packing
