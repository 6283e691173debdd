#include "packing/pack_layer.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "base/error.h"
#include "packing/sample_sizes.h"
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
Species spheres(double diameter) {
  Species s;
  s.name = "spheres";
  s.size.diameter = diameter;
  return s;
}

Recipe recipe(Species species, double solids, double width, double thickness) {
  Recipe r;
  r.species = {std::move(species)};
  r.layer.solids = solids, r.layer.width = width, r.layer.thickness = thickness;
  return r;
}

// Every pair and all nine images, and both planes.
double smallest_gap_by_brute_force(const Layer& layer) {
  double smallest = 1e9;
  const auto& a = layer.particles.radius;
  for (std::size_t i = 0; i < a.size(); ++i) {
    smallest =
        std::min({smallest, layer.position[i].z() - a[i], layer.cell.height - layer.position[i].z() - a[i]});
    for (std::size_t j = i + 1; j < a.size(); ++j)
      for (int p = -1; p <= 1; ++p)
        for (int q = -1; q <= 1; ++q) {
          const Vec3 image(p * layer.cell.width_x, q * layer.cell.width_y, 0);
          smallest = std::min(smallest, (layer.position[j] + image - layer.position[i]).norm() - a[i] - a[j]);
        }
  }
  return smallest;
}

void expect_valid(const Recipe& r, const Packing& packing) {
  const Layer& layer = packing.layer;
  EXPECT_GE(smallest_gap_by_brute_force(layer), r.packing.minimum_gap);
  for (const Vec3& p : layer.position) {
    EXPECT_TRUE(p.x() >= 0 && p.x() < layer.cell.width_x && p.y() >= 0 && p.y() < layer.cell.width_y);
  }
  const Solids solids = solids_of(layer, r.liquid_density);
  // A sum over N particles and a square root: rounding only.
  const double achieved = r.layer.solids_by_weight ? solids.mass_fraction : solids.volume_fraction;
  EXPECT_NEAR(achieved, r.layer.solids, 1e-13);
  if (r.layer.thickness) {
    EXPECT_EQ(layer.cell.height, *r.layer.thickness);
  } else {
    EXPECT_NEAR(solids.coat_weight / *r.layer.coat_weight, 1, 1e-13);
  }
  // Radii are the sampled ones to the bit: nothing was grown or shrunk to fit.
  const double volume =
      packing.target.volume_fraction * packing.target.thickness * r.layer.width * r.layer.width;
  EXPECT_EQ(layer.particles.radius, sample_particles(r.species, packing.sizes, volume, r.seed).radius);
}

TEST(PackLayer, ByInsertionAlone) {
  const Recipe r = recipe(fine_carbonate(), 0.65, 5, 5);
  const Packing packing = pack_layer(r);
  expect_valid(r, packing);
  EXPECT_EQ(packing.inserted_overlapping, 0u);
  // 2,357 in 10 um, so 1,178 in 5; the strata make the width nearly the one asked for.
  EXPECT_NEAR(packing.layer.particles.size(), 1178, 2);
  EXPECT_NEAR(packing.width_scale, 1, 0.005);
}

TEST(PackLayer, ByRemovalOfOverlapsWhereInsertionStalls) {
  // 78 wt% of the polydisperse law, and equal spheres, which random insertion brings to 38 vol% only.
  for (const Recipe& r : {recipe(fine_carbonate(), 0.78, 4.2, 3.5), recipe(spheres(0.5), 0.78, 2.5, 3)}) {
    const Packing packing = pack_layer(r);
    expect_valid(r, packing);
    EXPECT_GT(packing.inserted_overlapping, 0u);
    EXPECT_GT(packing.relaxation_steps, 0);
  }
}

TEST(PackLayer, MeetsCoatWeightAndVolumeFractionOfMixtures) {
  Recipe r;
  Species latex = spheres(0.2);
  latex.name = "latex", latex.density = 1e-3, latex.parts = 12;
  r.species = {fine_carbonate(), latex};
  r.layer.coat_weight = 0.004, r.layer.solids = 0.42, r.layer.solids_by_weight = false, r.layer.width = 4.2;
  r.packing.minimum_gap = 0.005;
  expect_valid(r, pack_layer(r));
}

TEST(PackLayer, StaysValidThroughEquilibration) {
  Recipe r = recipe(fine_carbonate(), 0.7, 4.2, 3.5);
  r.packing.equilibration_sweeps = 30;
  const Packing packing = pack_layer(r);
  expect_valid(r, packing);
  EXPECT_GT(packing.acceptance, 0.2);
  r.packing.equilibration_sweeps = 0;
  EXPECT_NE(pack_layer(r).layer.position, packing.layer.position);
}

TEST(PackLayer, AllowsSpheresToTouchWhereNoGapIsAskedFor) {
  Recipe r = recipe(fine_carbonate(), 0.78, 4.2, 3);
  r.packing.minimum_gap = 0;
  expect_valid(r, pack_layer(r));
}

TEST(PackLayer, IsTheSameAtAnyThreadCount) {
  Recipe r = recipe(fine_carbonate(), 0.78, 4.2, 3);
  r.packing.equilibration_sweeps = 3;
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Packing one = pack_layer(r);
  omp_set_num_threads(3);
  const Packing three = pack_layer(r);
  omp_set_num_threads(before);
  EXPECT_EQ(one.layer.position, three.layer.position);
  EXPECT_EQ(one.layer.particles.radius, three.layer.particles.radius);
}

TEST(PackLayer, DiffersFromSeedToSeed) {
  Recipe r = recipe(fine_carbonate(), 0.6, 4.2, 4);
  const Packing first = pack_layer(r);
  r.seed = 2;
  const Packing second = pack_layer(r);
  EXPECT_NE(first.layer.particles.radius, second.layer.particles.radius);
  EXPECT_NE(first.layer.position, second.layer.position);
}

TEST(PackLayer, FillsTheLayerEvenlyAcross) {
  // Random insertion knows no direction in x and y: chi-squared of centre counts in 4 x 4 columns, 15 degrees
  // of freedom (the columns must hold 16 counts with a fixed sum), against its 99.9 % point 37.7. Excluded
  // volume makes the counts vary less than independent ones, so false alarms are rarer than 0.1 %.
  const Packing packing = pack_layer(recipe(fine_carbonate(), 0.65, 5, 10));
  double counts[16] = {};
  const double width = packing.layer.cell.width_x;
  for (const Vec3& p : packing.layer.position)
    ++counts[static_cast<int>(4 * p.x() / width) * 4 + static_cast<int>(4 * p.y() / width)];
  double chi2 = 0;
  const double expected = packing.layer.position.size() / 16.0;
  for (const double c : counts) chi2 += (c - expected) * (c - expected) / expected;
  EXPECT_LT(chi2, 37.7);
  // Up and down are alike too, and thinner beside the planes than between them.
  const ProfileFlatness profile = measure_flatness(packing.layer, 30);
  EXPECT_LT(profile.outer_bottom, 0.95 * profile.inner);
  EXPECT_LT(profile.outer_top, 0.95 * profile.inner);
}

std::string refusal(const Recipe& r) {
  try {
    pack_layer(r);
  } catch (const InputError& e) {
    EXPECT_EQ(e.exit_status(), 2);
    return e.what();
  }
  return "no refusal";
}

TEST(PackLayer, RefusesTheImpossibleWithTheReason) {
  const auto says = [](const Recipe& r, const char* words) {
    EXPECT_NE(refusal(r).find(words), std::string::npos) << refusal(r);
  };
  says(recipe(fine_carbonate(), 0.95, 5, 10), "layer.solids: 95 wt% (87.6 vol%) cannot be packed");
  says(recipe(fine_carbonate(), 0.65, 3.9, 10),
       "layer.width: 3.9 um is less than two largest diameters (4 um)");
  says(recipe(fine_carbonate(), 0.65, 5, 1.9),
       "layer.thickness: a wet layer of 1.9 um is thinner than the largest");
  says(recipe(spheres(1), 0.65, 5, 1.001), "minimum gap");
  // One row of spheres cannot reach 78 wt% between two planes that leave no second row.
  says(recipe(spheres(0.5), 0.78, 3, 0.6), "no packing without overlaps was found");
  Recipe wide_gap = recipe(spheres(0.2), 0.7, 2, 3);
  wide_gap.packing.minimum_gap = 0.1;
  says(wide_gap, "packing.minimum_gap");
  Recipe thin = recipe(fine_carbonate(), 0.65, 5, 1);
  thin.layer.thickness.reset();
  thin.layer.coat_weight = 1e-3;
  says(thin, "layer.coat_weight");
  // A width that the solids then shrink below two diameters.
  says(recipe(spheres(2), 0.6, 4.0, 2.5), "layer.width");
  Recipe nothing = recipe(spheres(1), 0.6, 4.0, 2.5);
  nothing.species.clear();
  says(nothing, "no species");
}

}  // namespace
}  // namespace pigment::packing
