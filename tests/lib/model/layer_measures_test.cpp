#include "model/layer_measures.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "base/random.h"
#include "model/sphere_slice.h"

namespace pigment {
namespace {

struct Spheres {
  Vec3Array position;
  std::vector<double> radius;
};

// Spheres of 0.1..1 um radius with centres in a 10 x 10 x 20 um box; they overlap, which no measure minds.
Spheres random_spheres(std::size_t count, std::uint64_t seed) {
  Spheres s;
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = random_uniforms({seed, Stream::Tests}, i);
    s.position.push_back({10 * u[0], 10 * u[1], 20 * u[2]});
    s.radius.push_back(0.1 + 0.9 * u[3]);
  }
  return s;
}

TEST(SphereSlice, AgreesWithIntegratedSections) {
  // Simpson's rule is exact for the quadratic section area inside the sphere.
  const double a = 0.7, centre = 3.1, low = 2.9, high = 3.6;
  const auto area = [&](double z) { return sphere_section_area(a, centre, z); };
  const double simpson = (high - low) / 6 * (area(low) + 4 * area(0.5 * (low + high)) + area(high));
  EXPECT_NEAR(sphere_slice_volume(a, centre, low, high), simpson, 1e-15);
  EXPECT_NEAR(sphere_volume_below(a, centre, high) - sphere_volume_below(a, centre, low), simpson, 1e-14);
}

TEST(SphereSlice, WholeSphereAndNothingOutside) {
  const double a = 0.35;
  EXPECT_DOUBLE_EQ(sphere_slice_volume(a, 1, -5, 5), Particles::sphere_volume(a));
  EXPECT_DOUBLE_EQ(sphere_volume_below(a, 1, 5), Particles::sphere_volume(a));
  EXPECT_EQ(sphere_slice_volume(a, 1, 1.35, 5), 0);
  EXPECT_EQ(sphere_slice_volume(a, 1, -5, 0.65), 0);
  EXPECT_EQ(sphere_section_area(a, 1, 2), 0);
}

TEST(SphereSlice, ThinSliceKeepsItsRelativeAccuracy) {
  // 1e-9 um at the equator: pi a^2 times the thickness as the doubles have it, to a relative 1e-14.
  const double a = 1, low = 0.0, high = 1e-9;
  EXPECT_NEAR(sphere_slice_volume(a, 0, low, high) / (std::numbers::pi * 1e-9), 1, 1e-14);
}

TEST(SliceVolumes, SumToTheTotalVolume) {
  const Spheres s = random_spheres(2000, 1);
  std::vector<double> edges = equal_slices(23, 37);
  for (double& z : edges) z -= 1.5;  // -1.5 .. 21.5 um holds every sphere
  const std::vector<double> volume = slice_volumes(edges, s.position, s.radius);
  const double sum = std::accumulate(volume.begin(), volume.end(), 0.0), total = solids_volume(s.radius);
  // 2,000 spheres in slices: rounding of some 1e4 additions, whose errors average out.
  EXPECT_NEAR(sum / total, 1, 1e-14);
}

TEST(SliceVolumes, AgreeWithMidpointIntegration) {
  const Spheres s = random_spheres(300, 2);
  const std::vector<double> edges = equal_slices(20, 7);
  const std::vector<double> volume = slice_volumes(edges, s.position, s.radius);
  for (std::size_t k = 0; k < volume.size(); ++k) {
    const int points = 2000;
    const double dz = (edges[k + 1] - edges[k]) / points;
    double sum = 0;
    for (int p = 0; p < points; ++p)
      for (std::size_t i = 0; i < s.radius.size(); ++i)
        sum += dz * sphere_section_area(s.radius[i], s.position[i].z(), edges[k] + (p + 0.5) * dz);
    // Midpoint error: slope jumps 2 pi a at a sphere's ends, at most 2 pi a dz^2/8 each: 300 x 2 x 1.6e-6
    // um^3.
    EXPECT_NEAR(volume[k], sum, 1e-3);
  }
}

TEST(SliceVolumes, PlanesOnSphereEndsAndOutside) {
  // One sphere that just fits slice 1, one that lies outside.
  const std::vector<double> volume = slice_volumes({0, 1, 2, 3}, {{0, 0, 1.5}, {0, 0, 7}}, {0.5, 0.5});
  EXPECT_EQ(volume[0], 0);
  EXPECT_DOUBLE_EQ(volume[1], Particles::sphere_volume(0.5));
  EXPECT_EQ(volume[2], 0);
}

TEST(MassCentre, WeighsByMassOrElseByVolume) {
  const Vec3Array position{{0, 0, 1}, {0, 0, 4}};
  EXPECT_DOUBLE_EQ(mass_centre(position, {1, 1}, {2, 1}), 2);
  EXPECT_DOUBLE_EQ(mass_centre(position, {1, 2}), (1 + 8 * 4) / 9.0);
  EXPECT_DOUBLE_EQ(mass_centre(position, {1, 2}, {0, 0}), (1 + 8 * 4) / 9.0);
  EXPECT_EQ(mass_centre({}, {}), 0);
}

TEST(HeightBelowWhich, HoldsThatShareBelow) {
  const Spheres s = random_spheres(500, 3);
  const double total = solids_volume(s.radius);
  for (double share : {0.01, 0.5, 0.95, 0.99, 0.9999}) {
    const double z = height_below_which(share, s.position, s.radius);
    double below = 0;
    for (std::size_t i = 0; i < s.radius.size(); ++i)
      below += sphere_volume_below(s.radius[i], s.position[i].z(), z);
    EXPECT_NEAR(below / total, share, 1e-14) << share;  // rounding of the sums
  }
}

TEST(HeightBelowWhich, KnowsOneSphereAndGaps) {
  EXPECT_DOUBLE_EQ(height_below_which(0.5, {{0, 0, 3}}, {0.5}), 3);
  EXPECT_DOUBLE_EQ(height_below_which(0, {{0, 0, 3}}, {0.5}), 2.5);
  EXPECT_DOUBLE_EQ(height_below_which(1, {{0, 0, 3}}, {0.5}), 3.5);
  EXPECT_EQ(height_below_which(0.5, {}, {}), 0);
  // Half of the volume lies below every height of the gap between two equal spheres.
  const double z = height_below_which(0.5, {{0, 0, 1}, {0, 0, 9}}, {1, 1});
  EXPECT_GE(z, 2 - 1e-6);
  EXPECT_LE(z, 8 + 1e-6);
  // A hemisphere of two spheres on one height and a third above: 1/3 of all lies below the first two's
  // middle.
  EXPECT_NEAR(height_below_which(1.0 / 3, {{0, 0, 1}, {5, 0, 1}, {0, 0, 9}}, {1, 1, 1}), 1, 1e-15);
}

TEST(ProtrudingFraction, IsTheCapsAboveTheSurface) {
  EXPECT_EQ(protruding_fraction(5, {{0, 0, 1}}, {1}), 0);
  EXPECT_DOUBLE_EQ(protruding_fraction(1, {{0, 0, 1}, {0, 0, 1}}, {1, 1}), 0.5);
  // A cap of height 0.1 on a sphere of radius 1: pi h^2 (3 - h)/3 over 4 pi/3.
  EXPECT_NEAR(protruding_fraction(1.9, {{0, 0, 1}}, {1}), 0.1 * 0.1 * 2.9 / 4, 1e-16);
  EXPECT_EQ(protruding_fraction(1, {}, {}), 0);
}

TEST(TopEnvelope, IsTheMeanHeightOfASphereOverItsCell) {
  // One unit sphere at z = 3 in a 4 x 4 cell: inside the circle 3 + sqrt(1 - r^2), mean over the cell
  // (3 pi + 2 pi/3)/16; outside 0. Columns of 0.01 um sample the jump at the rim with an error of some
  // 3 * perimeter * column * scatter / 16 < 1e-3.
  const Cell cell{4, 4, 10};
  const double exact = (3 * std::numbers::pi + 2 * std::numbers::pi / 3) / 16;
  EXPECT_NEAR(top_envelope(cell, {{2, 2, 3}}, {1}, 0.01), exact, 1e-3);
  // The same across the periodic corner and any number of periods away, by a whole number of columns.
  EXPECT_NEAR(top_envelope(cell, {{-8, 12, 3}}, {1}, 0.01), top_envelope(cell, {{2, 2, 3}}, {1}, 0.01),
              1e-12);
  EXPECT_EQ(top_envelope(cell, {}, {}), 0);
}

TEST(NonAffineMotion, IgnoresEvenShrinkingAndFindsPlantedMotion) {
  const Spheres s = random_spheres(5000, 4);
  std::vector<double> rise;
  for (const Vec3& p : s.position) rise.push_back(-0.03 * p.z());
  EXPECT_LT(non_affine_motion(s.position, rise, 20, 30).rms, 1e-15);
  // White noise of known size on top comes back; its sample deviation over 5,000 - 60 degrees of freedom
  // scatters by 1 % (one s.d.), so 5 % is a false-alarm rate of 6e-7.
  for (std::size_t i = 0; i < rise.size(); ++i) rise[i] += 0.002 * random_normals({5, Stream::Tests}, i)[0];
  const NonAffineMotion motion = non_affine_motion(s.position, rise, 20, 30);
  EXPECT_EQ(motion.degrees_of_freedom, 5000 - 60);
  EXPECT_NEAR(motion.rms / 0.002, 1, 0.05);
}

TEST(NonAffineMotion, SaysWhenThereAreTooFewParticles) {
  EXPECT_EQ(non_affine_motion({{0, 0, 1}, {0, 0, 2}}, {5, 7}, 3, 1).degrees_of_freedom, 0);
  EXPECT_EQ(non_affine_motion({}, {}, 3, 30).degrees_of_freedom, 0);
}

}  // namespace
}  // namespace pigment
