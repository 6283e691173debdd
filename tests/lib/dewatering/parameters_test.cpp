#include "dewatering/parameters.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace pigment::dewatering {
namespace {

const Coating coating{0.4075, 25, 2.7e-3, {298.15, 0.89, 78.4, 1e-3}};

DewateringParameters read(const std::string& block) {
  auto document = config::Document::from_text("dewatering: " + block);
  auto node = document.root().block("dewatering");
  const auto p = read_dewatering(node);
  check_dewatering(node, p, coating);
  document.check();
  return p;
}

std::string complaint(const std::string& block) {
  try {
    read(block);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

void expect_complaint(const std::string& block, const std::string& key, const std::string& words) {
  const std::string text = complaint(block);
  EXPECT_NE(text.find(key), std::string::npos) << block << " gave: " << text;
  EXPECT_NE(text.find(words), std::string::npos) << block << " gave: " << text;
}

TEST(DewateringBlock, IsReadInEngineUnits) {
  const auto p = read(R"({strategy: LLH, duration: 0.5 s, final_solids: 85 wt%, reference_thickness: 30 um,
      absorption: {permeability: 2e-18 m2, cake_solids: 70 vol%, capillary_pressure: 40 kPa, external_pressure: 5 kPa},
      evaporation: {high: 50 g/m2/s, low: 5 g/m2/s}})");
  EXPECT_EQ(p.strategy, Strategy::LowLowHigh);
  EXPECT_DOUBLE_EQ(*p.duration, 500);
  EXPECT_DOUBLE_EQ(p.final_solids->fraction, 0.85);
  EXPECT_DOUBLE_EQ(*p.reference_thickness, 30);
  EXPECT_DOUBLE_EQ(p.absorption->permeability, 2e-6);
  EXPECT_DOUBLE_EQ(p.absorption->capillary_pressure, 4e4);
  EXPECT_DOUBLE_EQ(p.evaporation->high / 1e-3, 0.05);  // um/ms of water
}

TEST(DewateringBlock, ServesEveryStrategyUnchanged) {
  for (const char* strategy : {"HLL", "LLH", "ABS", "EVA"})
    EXPECT_NO_THROW(read(std::string("{duration: 0.5 s, absorption: {}, evaporation: {}, strategy: ") + strategy + "}"));
}

TEST(DewateringBlock, AsksOnlyForWhatTheStrategyUses) {
  EXPECT_FALSE(read("{strategy: EVA, duration: 0.5 s}").absorption);
  EXPECT_FALSE(read("{strategy: ABS, duration: 0.5 s}").evaporation);
}

TEST(DewateringBlock, RefusesWhatCannotBe) {
  expect_complaint("{duration: 0.5 s}", "dewatering.strategy", "is missing");
  expect_complaint("{strategy: HHL, duration: 0.5 s}", "dewatering.strategy", "HLL");
  expect_complaint("{strategy: HLL}", "dewatering.duration", "missing");
  expect_complaint("{strategy: HLL, duration: 0.5}", "dewatering.duration", "0.5");
  expect_complaint("{strategy: HLL, duration: 0 s}", "dewatering.duration", "0");
  expect_complaint("{strategy: HLL, file: t.csv, duration: 0.5 s}", "dewatering.strategy", "one of them");
  expect_complaint("{file: t.csv, evaporation: {high: 1 g/m2/s}}", "dewatering.evaporation", "come from file");
  expect_complaint("{strategy: EVA, duration: 1 s, evaporation: {high: 1 g/m2/s, low: 2 g/m2/s}}",
                   "dewatering.evaporation.low", "high");
  expect_complaint("{strategy: ABS, duration: 1 s, reference_thickness: 25 um}", "dewatering.reference_thickness",
                   "final_solids");
  expect_complaint("{strategy: ABS, duration: 1 s, absorption: {permeability: 0 m2}}",
                   "dewatering.absorption.permeability", "0");
}

TEST(DewateringBlock, RefusesWhatCannotBeForThisCoating) {
  expect_complaint("{strategy: ABS, duration: 1 s, absorption: {cake_solids: 40 vol%}}",
                   "dewatering.absorption.cake_solids", "40.75 vol%");
  expect_complaint("{strategy: ABS, duration: 1 s, final_solids: 60 wt%}", "dewatering.final_solids", "65 wt%");
  // Not used, so not held against it.
  EXPECT_EQ(complaint("{strategy: EVA, duration: 1 s, absorption: {cake_solids: 40 vol%}}"), "");
}

}  // namespace
}  // namespace pigment::dewatering
