#include "analysis/solids_profile.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "base/random.h"
#include "model/particles.h"

namespace pigment::analysis {
namespace {

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// A random layer, 10 x 8 x 12 um, spheres of 0.2..1.6 um diameter inside it, two densities.
struct RandomLayer {
  Snapshot frame;
  Solids solids;
};
RandomLayer random_layer(std::size_t count) {
  RandomLayer layer;
  layer.frame.cell = {10, 8, 12};
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = random_uniforms({7, Stream::Tests}, i);
    const double a = 0.1 + 0.7 * u[3];
    layer.frame.position.push_back({10 * u[0], 8 * u[1], a + (12 - 2 * a) * u[2]});
    layer.solids.radius.push_back(a);
    layer.solids.mass.push_back((i % 3 == 0 ? 1.05e-3 : 2.7e-3) * Particles::sphere_volume(a));
  }
  return layer;
}

TEST(SolidsProfile, OfACubicLatticeIsItsPackingFraction) {
  // Simple cubic lattice of touching spheres, 4 x 4 x 6, diameter 0.5: solids pi/6 in every slice of whole
  // layers.
  Snapshot frame;
  frame.cell = {2, 2, 3};
  Solids solids;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 6; ++z) {
        frame.position.push_back({0.25 + 0.5 * x, 0.25 + 0.5 * y, 0.25 + 0.5 * z});
        solids.radius.push_back(0.25);
        solids.mass.push_back(2.7e-3 * Particles::sphere_volume(0.25));
      }
  Parameters parameters;
  parameters.slices = 6;
  parameters.size_classes = {0.4, 0.5};
  const SolidsProfile p = profile_solids(frame, solids, parameters);
  const double phi = std::numbers::pi / 6, wt = 2.7 * phi / (2.7 * phi + 1 - phi);
  for (std::size_t s = 0; s < 6; ++s) {
    EXPECT_NEAR(p.volume_fraction[s], phi, 1e-14);
    EXPECT_NEAR(p.mass_fraction[s], wt, 1e-14);
    EXPECT_NEAR(p.cumulative_share[s], (static_cast<double>(s) + 1) / 6, 1e-14);
    EXPECT_NEAR(p.cumulative_mass_fraction[s], wt, 1e-14);
    // A diameter on a class border belongs to the finer class: all spheres are in class 1.
    EXPECT_EQ(p.size_classes[0].number[s], 0);
    EXPECT_EQ(p.size_classes[1].number[s], 16);
    EXPECT_EQ(p.size_classes[2].number[s], 0);
    EXPECT_NEAR(p.size_classes[1].share[s], 1.0 / 6, 1e-15);
  }
  EXPECT_NEAR(p.mean_volume_fraction, phi, 1e-14);
  EXPECT_NEAR(p.mass_centre, 1.5, 1e-14);
  EXPECT_NEAR(p.protruding_fraction, 0, 1e-15);
  EXPECT_NEAR(p.z95, 3 - 0.5 * 0.3,
              0.05);  // 5 % of six layers is 0.3 of the top one, somewhat nearer its middle
}

TEST(SolidsProfile, ConservesVolumeAndMass) {
  const RandomLayer layer = random_layer(4000);
  const SolidsProfile p = profile_solids(layer.frame, layer.solids, Parameters{});
  double total = 0;
  for (double a : layer.solids.radius) total += Particles::sphere_volume(a);
  const double slice = 10 * 8 * 12 / 30.0;
  EXPECT_NEAR(sum(p.volume_fraction) * slice / total, 1, 1e-14);  // rounding of the sums
  EXPECT_NEAR(p.cumulative_share.back(), 1, 1e-14);
  EXPECT_NEAR(p.cumulative_mass_fraction.back(), p.mean_mass_fraction, 1e-14);
  double particles = 0;
  for (std::size_t s = 0; s < 30; ++s) {
    double volume = 0, mass = 0, solids_fraction = 0, number_fraction = 0;
    for (const GroupProfile& c : p.size_classes) {
      volume += c.volume_fraction[s];
      mass += c.mass_fraction[s];
      solids_fraction += c.solids_fraction[s];
      number_fraction += c.number_fraction[s];
      particles += c.number[s];
    }
    EXPECT_NEAR(volume, p.volume_fraction[s], 1e-14);
    EXPECT_NEAR(mass, p.mass_fraction[s], 1e-14);
    EXPECT_NEAR(solids_fraction, 1, 1e-14);
    EXPECT_NEAR(number_fraction, 1, 1e-14);
  }
  EXPECT_EQ(particles, 4000);
  for (const GroupProfile& c : p.size_classes) EXPECT_NEAR(sum(c.share), 1, 1e-14);
}

TEST(SolidsProfile, BySpeciesIsThatOfTheLayerWithTheOthersTakenOut) {
  RandomLayer layer = random_layer(2000), second = layer;
  second.frame.position.clear();
  second.solids = {};
  for (std::size_t i = 0; i < 2000; ++i) {
    layer.solids.species.push_back(i % 3 == 0 ? 1 : 0);
    if (i % 3 != 0) continue;
    second.frame.position.push_back(layer.frame.position[i]);
    second.solids.radius.push_back(layer.solids.radius[i]);
    second.solids.mass.push_back(layer.solids.mass[i]);
  }
  const SolidsProfile all = profile_solids(layer.frame, layer.solids, Parameters{}),
                      alone = profile_solids(second.frame, second.solids, Parameters{});
  ASSERT_EQ(all.species.size(), 2u);
  EXPECT_TRUE(alone.species.empty());
  for (std::size_t s = 0; s < 30; ++s) {
    EXPECT_NEAR(all.species[1].volume_fraction[s], alone.volume_fraction[s], 1e-14);
    EXPECT_NEAR(all.species[0].volume_fraction[s] + all.species[1].volume_fraction[s], all.volume_fraction[s], 1e-14);
    EXPECT_NEAR(all.species[0].mass_fraction[s] + all.species[1].mass_fraction[s], all.mass_fraction[s], 1e-14);
  }
  EXPECT_EQ(sum(all.species[1].number), 667);  // of 2000 every third, from the first
  EXPECT_NEAR(sum(all.species[1].share), 1, 1e-14);
}

TEST(SolidsProfile, LeavesOutWhatProtrudesAndSaysHowMuch) {
  Snapshot frame;
  frame.cell = {2, 2, 3};
  frame.position = {{1, 1, 1}, {1, 1, 3}};  // the upper one half out
  const double mass = 2.7e-3 * Particles::sphere_volume(0.5);
  const SolidsProfile p = profile_solids(frame, {{0.5, 0.5}, {mass, mass}, 1e-3}, Parameters{});
  EXPECT_NEAR(p.protruding_fraction, 0.25, 1e-15);
  EXPECT_NEAR(p.cumulative_share.back(), 0.75, 1e-15);
  EXPECT_NEAR(sum(p.volume_fraction) * 12 / 30, 1.5 * Particles::sphere_volume(0.5), 1e-14);
}

TEST(SolidsProfile, OverlapsNeverGiveMoreThanAllSolids) {
  Snapshot frame;
  frame.cell = {1, 1, 1};
  frame.position.assign(5, Vec3{0.5, 0.5, 0.5});
  const double mass = 2.7e-3 * Particles::sphere_volume(0.5);
  const SolidsProfile p =
      profile_solids(frame, {std::vector<double>(5, 0.5), std::vector<double>(5, mass), 1e-3}, Parameters{});
  for (double w : p.mass_fraction) EXPECT_LE(w, 1);
  EXPECT_DOUBLE_EQ(p.mean_mass_fraction, 1);
}

TEST(DenseThickness, EndsWhereTheProfileFallsThroughTheThreshold) {
  const std::vector<double> edges{0, 1, 2, 3, 4};
  EXPECT_DOUBLE_EQ(dense_thickness(edges, {0.6, 0.6, 0.4, 0.4}, 0.5, 1), 2);
  EXPECT_DOUBLE_EQ(dense_thickness(edges, {0.6, 0.6, 0.2, 0.4}, 0.5, 1), 1.75);
  EXPECT_DOUBLE_EQ(dense_thickness(edges, {0.6, 0.6, 0.6, 0.6}, 0.5, 1), 4);
  EXPECT_DOUBLE_EQ(dense_thickness(edges, {0.4, 0.4, 0.4, 0.4}, 0.5, 1), 0);
  EXPECT_DOUBLE_EQ(dense_thickness(edges, {0.3, 0.6, 0.4, 0.4}, 0.5, 1), 2);  // a loose slice at the wall
  EXPECT_DOUBLE_EQ(dense_thickness(edges, {0.3, 0.4, 0.6, 0.4}, 0.5, 1), 0);  // dense only far from it
  EXPECT_DOUBLE_EQ(dense_thickness(edges, {0.3, 0.6, 0.6, 0.3}, 0.5, 1), 4);  // loose at both walls only
}

TEST(SolidsProfile, FindsCakeAndSkin) {
  // Touching cubic lattices (0.52) below 2 um and above 9 um, nothing between; threshold a quarter of that.
  Snapshot frame;
  frame.cell = {2, 2, 10};
  Solids solids;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (double z : {0.25, 0.75, 1.25, 1.75, 9.25, 9.75}) {
        frame.position.push_back({0.25 + 0.5 * x, 0.25 + 0.5 * y, z});
        solids.radius.push_back(0.25);
        solids.mass.push_back(1);
      }
  Parameters parameters;
  parameters.slices = 20;
  parameters.cake_solids = std::numbers::pi / 12;
  const SolidsProfile p = profile_solids(frame, solids, parameters);
  EXPECT_NEAR(p.cake_thickness, 2, 1e-12);
  EXPECT_NEAR(p.skin_thickness, 1, 1e-12);
}

// A layer that shrinks evenly by 0.1 um in each of 10 steps, with motion of its own until step `still`: random, of the given
// r.m.s. in um a step, and as much again as a flow of mass towards the top (a parabola over the height).
Frames shrinking_layer(const RandomLayer& layer, std::size_t still, double own) {
  Frames frames;
  frames.count = 11;
  frames.read = [=](std::size_t k) {
    Snapshot s = layer.frame;
    s.time = 2.0 * static_cast<double>(k);
    s.cell.height = 12 - 0.1 * static_cast<double>(k);
    for (std::size_t i = 0; i < s.position.size(); ++i) {
      double z = s.position[i].z();
      for (std::size_t step = 1; step <= k; ++step) {
        const double height = 12 - 0.1 * static_cast<double>(step - 1);
        z *= (height - 0.1) / height;
        const double share = z / (height - 0.1);
        if (step <= still) z += own * (random_normals({11, Stream::Tests}, i, step)[0] + 4 * share * (1 - share));
      }
      s.position[i].z() = z;
    }
    return s;
  };
  return frames;
}

TEST(Immobilisation, IsWhenMassNoLongerMovesBetweenHeights) {
  const RandomLayer layer = random_layer(1500);
  Parameters parameters;
  parameters.immobilisation_shrinkage = 0.015;  // two intervals
  const SolidsDevelopment development = follow_solids(shrinking_layer(layer, 6, 0.02), layer.solids, parameters);
  ASSERT_EQ(development.profiles.size(), 11u);
  ASSERT_EQ(development.intervals.size(), 10u);
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_NEAR(development.intervals[k].shrinkage_rate, 0.05, 1e-12);
    if (k < 6) {  // 0.02 um in 2 ms; 1,440 degrees of freedom scatter by 2 %, 10 % is 5 s.d.
      EXPECT_NEAR(development.intervals[k].velocity, 0.01, 1e-3);
      // The parabola's root mean square over ten slices is 0.73: 0.0146 of a fall of 0.1, and a tenth of that by chance. One interval has no halves.
      EXPECT_NEAR(development.intervals[k].redistribution, k == 0 ? 1 : 0.146, 0.03);
    } else {
      EXPECT_LT(development.intervals[k].velocity, 1e-12);
    }
  }
  EXPECT_LT(development.intervals[6].redistribution, 1e-6);  // the root of rounding
  ASSERT_TRUE(development.immobilisation_time.has_value());
  EXPECT_DOUBLE_EQ(*development.immobilisation_time, 14);  // frame 7: what still moved in one half does not go on in the other
  EXPECT_NEAR(development.intervals[8].mass_centre_rate, 0, 1e-13);
}

TEST(Immobilisation, IsNotReportedWhileParticlesMoveOrTheSurfaceRests) {
  const RandomLayer layer = random_layer(1500);
  Parameters parameters;
  parameters.immobilisation_shrinkage = 0.015;
  EXPECT_FALSE(follow_solids(shrinking_layer(layer, 10, 0.02), layer.solids, parameters).immobilisation_time);
  Frames resting{5, [&](std::size_t k) {
                   Snapshot s = layer.frame;
                   s.time = static_cast<double>(k);
                   return s;
                 }};
  const SolidsDevelopment development = follow_solids(resting, layer.solids, Parameters{});
  EXPECT_FALSE(development.immobilisation_time);
  for (const NonAffineInterval& interval : development.intervals) EXPECT_FALSE(interval.judged);
}

TEST(Immobilisation, NeedsTwoFrames) {
  const RandomLayer layer = random_layer(100);
  const Frames one{1, [&](std::size_t) { return layer.frame; }};
  const SolidsDevelopment development = follow_solids(one, layer.solids, Parameters{});
  EXPECT_EQ(development.profiles.size(), 1u);
  EXPECT_TRUE(development.intervals.empty());
  EXPECT_FALSE(development.immobilisation_time);
}

}  // namespace
}  // namespace pigment::analysis
