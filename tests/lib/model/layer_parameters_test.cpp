#include "model/layer_parameters.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace pigment {
namespace {

Species species_of(double parts, double density) {
  Species s;
  s.parts = parts, s.density = density;
  return s;
}

LayerParameters read(const std::string& block) {
  auto scene = config::Document::from_text("layer: " + block);
  const LayerParameters layer = read_layer(scene.root().block("layer"));
  scene.check();
  return layer;
}

std::string refusal(const std::string& block) {
  try {
    read(block);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no refusal";
}

TEST(LayerParameters, SolidsByWeightAndByVolumeAreInverse) {
  // 65 wt% at 2700 and 1000 kg/m3: (65/2.7) / (65/2.7 + 35) = 0.407524 by hand
  EXPECT_NEAR(volume_fraction_of(0.65, 2.7e-3, 1e-3), 0.407524, 5e-7);
  EXPECT_NEAR(volume_fraction_of(0.78, 2.7e-3, 1e-3), 0.567686, 5e-7);
  for (const double w : {0.01, 0.5, 0.99})
    EXPECT_NEAR(mass_fraction_of(volume_fraction_of(w, 2.7e-3, 1.1e-3), 2.7e-3, 1.1e-3), w, 1e-15);
}

TEST(LayerParameters, DryDensityWeighsByVolume) {
  // 100 parts of 2700 and 10 parts of 1000: 110 / (100/2700 + 10/1000) = 2338.58 kg/m3 by hand
  EXPECT_NEAR(dry_density({species_of(100, 2.7e-3), species_of(10, 1e-3)}), 2.33858e-3, 5e-9);
}

TEST(LayerParameters, CoatWeightGivesTheThickness) {
  const std::vector<Species> pigment{species_of(100, 2.7e-3)};
  LayerParameters layer;
  layer.solids = 0.65, layer.coat_weight = 0.0275079;  // 27.5079 g/m2
  // phi rho H = 0.407524 * 2.7 * 25 = 27.5079 g/m2 for 25 um
  const LayerTarget target = layer_target(layer, pigment, 1e-3);
  EXPECT_NEAR(target.thickness, 25, 1e-4);
  EXPECT_NEAR(target.mass_fraction, 0.65, 1e-15);
  layer.solids_by_weight = false;
  EXPECT_NEAR(layer_target(layer, pigment, 1e-3).volume_fraction, 0.65, 1e-15);
}

TEST(LayerParameters, ReadsBothWaysOfWritingEach) {
  const LayerParameters first = read("{thickness: 25 um, solids: 65 wt%, width: 5 um}");
  EXPECT_DOUBLE_EQ(*first.thickness, 25);
  EXPECT_FALSE(first.coat_weight);
  EXPECT_TRUE(first.solids_by_weight);
  EXPECT_DOUBLE_EQ(first.solids, 0.65);
  EXPECT_DOUBLE_EQ(first.width, 5);
  const LayerParameters second = read("{coat_weight: 26 g/m2, solids: 40 vol%, width: 5000 nm}");
  // 26 g/m2 = 0.026 kg/m2; a mass of 1e-12 kg on 1e-12 m2 is 1 kg/m2
  EXPECT_NEAR(*second.coat_weight, 0.026, 1e-16);
  EXPECT_FALSE(second.solids_by_weight);
  EXPECT_DOUBLE_EQ(second.solids, 0.4);
}

TEST(LayerParameters, RefusesWithTheKey) {
  EXPECT_NE(refusal("{solids: 65 wt%, width: 5 um}").find("layer.thickness"), std::string::npos);
  EXPECT_NE(refusal("{thickness: 1 um, coat_weight: 26 g/m2, solids: 65 wt%, width: 5 um}")
                .find("layer.coat_weight"),
            std::string::npos);
  EXPECT_NE(refusal("{thickness: 1 um, width: 5 um}").find("layer.solids"), std::string::npos);
  EXPECT_NE(refusal("{thickness: 1 um, solids: 65, width: 5 um}").find("layer.solids: \"65\""),
            std::string::npos);
  EXPECT_NE(refusal("{thickness: 1 um, solids: 100 wt%, width: 5 um}").find("layer.solids"),
            std::string::npos);
  EXPECT_NE(refusal("{thickness: 1 um, solids: 0 vol%, width: 5 um}").find("layer.solids"),
            std::string::npos);
  EXPECT_NE(refusal("{thickness: 1 um, solids: 65 wt%, width: 0 um}").find("layer.width"), std::string::npos);
}

}  // namespace
}  // namespace pigment
