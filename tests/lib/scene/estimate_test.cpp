#include "scene/estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "neighbours/pair_search.h"
#include "packing/pack_layer.h"

namespace pigment::scene {
namespace {

Scene read(const std::string& text) {
  config::Document d = config::Document::from_text(text);
  return read_scene(d);
}

std::string coating(const std::string& layer) {
  return "layer: " + layer +
         "\nparticles: [{size: {law: lognormal, mean: 1.5 um, standard_deviation: 10 um, min: 0.25 um, max: 2 um}}]\n";
}

// The mean number of particles of the source's layers, known from integrating the law: 2,360, 4,710, 7,070 (rounded to 10).
TEST(LayerEstimate, ParticleNumbersOfTheSourcesLayers) {
  const double expected[] = {2360, 4710, 7070};
  for (int i = 0; i < 3; ++i) {
    const auto e = estimate_layer(read(coating("{thickness: " + std::to_string(10 * (i + 1)) + " um, solids: 65 wt%, width: 5 um}")));
    EXPECT_NEAR(e.particles, expected[i], 6);
  }
}

// 65 wt% of 2700 in 1000 kg/m3 is 0.4075 by volume; 20 um of that hold 0.4075 * 20e-6 * 2700 = 22.0 g/m2.
TEST(LayerEstimate, CoatWeightAndThicknessAreOneThing) {
  const double phi = (0.65 / 2700) / (0.65 / 2700 + 0.35 / 1000);
  const auto e = estimate_layer(read(coating("{thickness: 20 um, solids: 65 wt%, width: 5 um}")));
  EXPECT_NEAR(e.volume_fraction, phi, 1e-12);
  EXPECT_NEAR(e.dry_coat_weight, phi * 20e-6 * 2700, 1e-12);
  const auto back = estimate_layer(read(coating("{coat_weight: " + std::to_string(1e3 * e.dry_coat_weight) + " g/m2, solids: 65 wt%, width: 5 um}")));
  EXPECT_NEAR(back.thickness, 20, 1e-3);  // the text holds six decimals
  EXPECT_LT(e.smallest, e.median);
  EXPECT_LT(e.median, 0.35);  // 43.6 % by number lie below 0.3 um
  EXPECT_GT(e.median, 0.30);
}

TEST(LayerEstimate, MonodisperseByHand) {
  const auto e = estimate_layer(read("layer: {thickness: 10 um, solids: 40 vol%, width: 6 um}\n"
                                     "particles: [{size: {law: monodisperse, diameter: 1 um}}]\n"));
  EXPECT_NEAR(e.particles, 0.4 * 360 / (std::numbers::pi / 6), 1e-9);
  // Spheres of 1 um at 0.4: lattice spacing (0.7405/0.4)^(1/3).
  EXPECT_NEAR(e.mean_gap, std::cbrt(0.740480489693061 / 0.4) - 1, 1e-12);
  EXPECT_EQ(e.median, 1);
}

// Two species: the volume is shared by parts over density.
TEST(LayerEstimate, MixturesShareByPartsOverDensity) {
  const auto e = estimate_layer(read("layer: {thickness: 10 um, solids: 40 vol%, width: 6 um}\n"
                                     "particles:\n"
                                     "  - {species: a, parts: 90, density: 2700 kg/m3, size: {law: monodisperse, diameter: 1 um}}\n"
                                     "  - {species: b, parts: 10, density: 1000 kg/m3, size: {law: monodisperse, diameter: 0.5 um}}\n"));
  const double va = 90 / 2.7, vb = 10 / 1.0, volume = 0.4 * 360;
  const double na = volume * va / (va + vb) / (std::numbers::pi / 6), nb = volume * vb / (va + vb) / (std::numbers::pi / 48);
  EXPECT_NEAR(e.particles, na + nb, 1e-9 * na);
  EXPECT_NEAR(e.number_share[0], na / (na + nb), 1e-12);
}

TEST(RateEstimate, MeanRateTimesDurationIsWhatIsRemoved) {
  const Scene s = read(coating("{thickness: 25 um, solids: 65 wt%, width: 5 um}") +
                       "free_surface: {}\ndewatering: {strategy: HLL, duration: 0.5 s, final_solids: 85 wt%}\n");
  const auto r = estimate_rates(dewatering::make_profile(*s.dewatering, coating_of(s)));
  EXPECT_NEAR(r.mean * r.duration, r.removed, 1e-9 * r.removed);
  EXPECT_NEAR(r.removed, 9.96, 5e-3);  // 25 um from 65 to 85 wt%: 9.96 um of water
  EXPECT_LT(r.slowest, r.mean);
  EXPECT_LT(r.mean, r.fastest);
}

// Against pairs counted in packings. 25 %: what the estimate claims.
TEST(CostEstimate, PairsAreThoseOfAPacking) {
  for (const std::string& text :
       {coating("{thickness: 8 um, solids: 65 wt%, width: 5 um}"),
        std::string("layer: {thickness: 8 um, solids: 65 wt%, width: 5 um}\n"
                    "particles: [{size: {law: monodisperse, diameter: 0.5 um}}]\n")}) {
    const Scene s = read(text + "colloidal: {van_der_waals: {cutoff: 200 nm}}\n");
    const auto packing = packing::pack_layer({*s.layer, s.packing, s.species, s.liquid.density, 1});
    const auto pairs = neighbours::find_pairs(packing.layer.cell, packing.layer.position, packing.layer.particles.radius,
                                              {s.hydrodynamics.taper.squeeze_end, 0.2, 0});
    const auto c = estimate_cost(s, estimate_layer(s), 500);
    EXPECT_NEAR(c.pairs / static_cast<double>(pairs.size()), 1, 0.25) << c.pairs << " against " << pairs.size();
  }
}

TEST(CostEstimate, FollowsStepsAndFrames) {
  const Scene s = read(coating("{thickness: 10 um, solids: 65 wt%, width: 5 um}") +
                       "stepping: {time_step: 0.2 ms}\noutput: {every: 10 ms}\n");
  const auto e = estimate_layer(s);
  const auto c = estimate_cost(s, e, 500);
  EXPECT_DOUBLE_EQ(c.steps, 2500);
  EXPECT_DOUBLE_EQ(c.frames, 51);
  EXPECT_GT(c.pairs, c.particles);
  EXPECT_GT(c.seconds, 0);
}

}  // namespace
}  // namespace pigment::scene
