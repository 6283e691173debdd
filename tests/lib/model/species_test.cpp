#include "model/species.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace pigment {
namespace {

std::vector<Species> read(const std::string& text) {
  config::Document d = config::Document::from_text(text, "s.yaml");
  auto species = read_species(d.root());
  d.check();
  return species;
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

std::string one(const std::string& size) { return "particles: [{species: p, size: " + size + "}]"; }

// The law of the source: mean 1.5 um, s.d. 10 um, both lengths.
TEST(Species, LognormalFromItsMoments) {
  const SizeLaw law =
      read(one("{law: lognormal, mean: 1.5 um, standard_deviation: 10 um, min: 0.25 um, max: 2 um}"))[0].size;
  EXPECT_NEAR(law.median, 0.2225, 5e-5);
  EXPECT_NEAR(law.geometric_standard_deviation, 7.05, 5e-3);
  // Independent of the way there: the moments of the log-normal with this median and spread are those asked for.
  const double variance = std::pow(std::log(law.geometric_standard_deviation), 2);
  EXPECT_NEAR(law.median * std::exp(variance / 2), 1.5, 1e-12);
  EXPECT_NEAR(law.median * law.median * std::exp(variance) * (std::exp(variance) - 1), 100, 1e-9);
}

TEST(Species, BothWaysOfWritingALognormalAgree) {
  const SizeLaw a = read(one("{law: lognormal, mean: 1 um, standard_deviation: 0.5 um, min: 0.1 um, max: 3 um}"))[0].size;
  char text[200];
  std::snprintf(text, sizeof text, "{law: lognormal, median: %.17g um, geometric_standard_deviation: %.17g, min: 0.1 um, max: 3 um}",
                a.median, a.geometric_standard_deviation);
  const SizeLaw b = read(one(text))[0].size;
  EXPECT_NEAR(b.mean, 1, 1e-12);
  EXPECT_NEAR(b.standard_deviation, 0.5, 1e-12);
}

TEST(Species, DefaultsAndEngineUnits) {
  const auto species = read("particles: [{size: {law: monodisperse, diameter: 1 um}}]");
  ASSERT_EQ(species.size(), 1u);
  EXPECT_EQ(species[0].name, "pigment");
  EXPECT_DOUBLE_EQ(species[0].density, 2.7e-3);
  EXPECT_DOUBLE_EQ(species[0].surface_potential, -25);
  EXPECT_DOUBLE_EQ(species[0].parts, 100);
  EXPECT_DOUBLE_EQ(species[0].size.diameter, 1);
}

TEST(Species, NormalIsCutAtThreeStandardDeviations) {
  const SizeLaw law = read(one("{law: normal, mean: 1 um, standard_deviation: 0.1 um}"))[0].size;
  EXPECT_NEAR(law.min, 0.7, 1e-12);
  EXPECT_NEAR(law.max, 1.3, 1e-12);
  EXPECT_NE(refusal(one("{law: normal, mean: 1 um, standard_deviation: 0.5 um}")).find("size.min: missing"),
            std::string::npos);
}

TEST(Species, TablesMayBeCut) {
  const SizeLaw whole = read(one("{law: table, file: F.csv}"))[0].size;
  EXPECT_EQ(whole.file, "F.csv");
  EXPECT_EQ(whole.min, 0);
  EXPECT_EQ(whole.max, 0);
  const SizeLaw cut = read(one("{law: table, file: F.csv, min: 0.2 um, max: 2 um}"))[0].size;
  EXPECT_DOUBLE_EQ(cut.min, 0.2);
  EXPECT_DOUBLE_EQ(cut.max, 2);
  EXPECT_NE(refusal(one("{law: table, file: F.csv, min: 3 um, max: 2 um}")).find("must be below max"), std::string::npos);
}

TEST(Species, RefusesWhatCannotBe) {
  EXPECT_NE(refusal(one("{law: lognormal, mean: 1 um, standard_deviation: 1 um, min: 3 um, max: 2 um}"))
                .find("particles.0.size.min: must be below max"),
            std::string::npos);
  EXPECT_NE(refusal(one("{law: lognormal, mean: 1 um, median: 1 um, standard_deviation: 1 um, min: 1 um, max: 2 um}"))
                .find("give either mean"),
            std::string::npos);
  EXPECT_NE(refusal(one("{law: lognormal, median: 1 um, geometric_standard_deviation: 1, min: 1 um, max: 2 um}"))
                .find("above 1"),
            std::string::npos);
  EXPECT_NE(refusal(one("{law: monodisperse, diameter: 1 m}")).find("out of range"), std::string::npos);
  EXPECT_NE(refusal(one("{law: monodisperse, diameter: 0 um}")).find("out of range"), std::string::npos);
  EXPECT_NE(refusal(one("{law: lognorml, mean: 1 um}")).find("did you mean \"lognormal\""), std::string::npos);
  EXPECT_NE(refusal("particles: [{species: p}]").find("particles.0.size: missing"), std::string::npos);
  EXPECT_NE(refusal("particles: []").find("the list is empty"), std::string::npos);
  EXPECT_NE(refusal("particles: {species: p}").find("expected a list"), std::string::npos);
}

TEST(Species, SeveralNeedPartsAndNamesOfTheirOwn) {
  const std::string size = "size: {law: monodisperse, diameter: 1 um}";
  EXPECT_EQ(read("particles: [{species: a, parts: 70, " + size + "}, {species: b, parts: 30, " + size + "}]").size(), 2u);
  EXPECT_NE(refusal("particles: [{species: a, " + size + "}, {species: b, parts: 30, " + size + "}]")
                .find("particles.0.parts: missing"),
            std::string::npos);
  EXPECT_NE(refusal("particles: [{species: a, parts: 1, " + size + "}, {species: a, parts: 1, " + size + "}]")
                .find("particles.1.species: \"a\" is the name of an earlier species"),
            std::string::npos);
}

}  // namespace
}  // namespace pigment
