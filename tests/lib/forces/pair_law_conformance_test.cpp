// What every registered law must satisfy, whatever its physics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "base/error.h"
#include "forces/pair_law.h"

using namespace pigment;
using namespace pigment::forces;

namespace {

std::unique_ptr<PreparedPairLaw> prepared(const PairLawEntry& entry, const std::string& block) {
  auto document = config::Document::from_text("colloidal: {" + entry.name + ": " + block + "}");
  config::Node colloidal = document.root().block("colloidal");
  auto law = entry.read(colloidal.block(entry.name), colloidal);
  document.check();
  return law->prepare(liquid_at({}, 298.15));
}

const PairGeometry pairs[] = {{0, 0.5, 0.5, -25, -25}, {0, 0.125, 1.0, -25, -40}, {0, 0.5, std::numeric_limits<double>::infinity(), -25, -25}};

class EveryLaw : public testing::TestWithParam<std::size_t> {
 protected:
  const PairLawEntry& entry() const { return pair_laws()[GetParam()]; }
};

}  // namespace

// Central differences of the switched law at steps of 1e-5 of the gap: their error is 1e-9 relative by truncation plus rounding.
TEST_P(EveryLaw, ForceAndStiffnessAreSlopes) {
  const auto law = prepared(entry(), entry().example);
  for (PairGeometry g : pairs)
    for (double gap = -0.002; gap < 1.1 * law->cutoff_gap(); gap += law->cutoff_gap() / 377) {
      const double step = 1e-5 * std::max(std::abs(gap), 1e-4);
      PairGeometry low = g, high = g;
      g.gap = gap;
      low.gap = gap - step;
      high.gap = gap + step;
      const PairTerm a = law->switched(low), b = law->switched(high), c = law->switched(g);
      const double force = -(b.energy - a.energy) / (2 * step), stiffness = -(b.force - a.force) / (2 * step);
      const double force_noise = 1e-14 * std::abs(c.energy) / step, stiffness_noise = 1e-14 * std::abs(c.force) / step;
      // A law may have a kink in its stiffness (steric layers touch, the floor): there the difference lies between both sides.
      EXPECT_NEAR(c.force, force, 1e-4 * std::abs(force) + force_noise + 2 * step * std::abs(c.stiffness) + 1e-12) << entry().name << " " << gap;
      if (std::abs(a.stiffness - b.stiffness) < 1e-2 * std::abs(c.stiffness) + 1e-9) {
        EXPECT_NEAR(c.stiffness, stiffness, 1e-3 * std::abs(stiffness) + stiffness_noise + 1e-9) << entry().name << " " << gap;
      }
    }
}

TEST_P(EveryLaw, ExchangingTheSpheresChangesNothing) {
  const auto law = prepared(entry(), entry().example);
  for (double gap : {-0.001, 0.0005, 0.003, 0.02}) {
    const PairTerm a = law->switched({gap, 0.2, 0.9, -25, -40}), b = law->switched({gap, 0.9, 0.2, -40, -25});
    EXPECT_NEAR(a.energy, b.energy, 1e-12 * std::abs(a.energy));
    EXPECT_NEAR(a.force, b.force, 1e-12 * std::abs(a.force));
    EXPECT_NEAR(a.stiffness, b.stiffness, 1e-12 * std::abs(a.stiffness));
  }
}

TEST_P(EveryLaw, NothingBeyondTheCutoffAndFiniteInOverlap) {
  const auto law = prepared(entry(), entry().example);
  for (PairGeometry g : pairs) {
    g.gap = law->cutoff_gap();
    EXPECT_EQ(law->switched(g).force, 0);
    for (double gap : {0.0, -1e-6, -0.01, -1.0}) {
      g.gap = gap;
      EXPECT_TRUE(std::isfinite(law->switched(g).energy) && std::isfinite(law->switched(g).force) && std::isfinite(law->switched(g).stiffness));
    }
  }
}

TEST_P(EveryLaw, LoopEqualsSingleEvaluation) {
  const auto law = prepared(entry(), entry().example);
  std::vector<PairGeometry> many;
  for (double gap = -0.001; gap < 1.2 * law->cutoff_gap(); gap += law->cutoff_gap() / 91) {
    many.push_back(pairs[many.size() % 3]);
    many.back().gap = gap;
  }
  std::vector<double> force(many.size(), 1.0), stiffness(many.size(), 2.0);
  law->add(many, force, stiffness);
  for (std::size_t k = 0; k < many.size(); ++k) {
    EXPECT_DOUBLE_EQ(force[k], 1.0 + law->switched(many[k]).force);
    EXPECT_DOUBLE_EQ(stiffness[k], 2.0 + law->switched(many[k]).stiffness);
  }
}

TEST_P(EveryLaw, UnknownKeyIsRefused) {
  std::string block = entry().example;
  block.insert(1, "no_such_key: 1, ");
  EXPECT_THROW(prepared(entry(), block), InputError);
}

// Every example has a length; in a unit of another dimension, without a unit, or negative it is none.
TEST_P(EveryLaw, LengthOfAnotherDimensionOrSignIsRefused) {
  const std::string block = entry().example;
  const std::size_t unit = block.find(" nm"), number = block.rfind(": ", unit);
  ASSERT_NE(unit, std::string::npos);
  EXPECT_THROW(prepared(entry(), std::string(block).replace(unit, 3, " kPa")), InputError);
  EXPECT_THROW(prepared(entry(), std::string(block).replace(unit, 3, "")), InputError);
  EXPECT_THROW(prepared(entry(), std::string(block).insert(number + 2, "-")), InputError);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryLaw, testing::Range<std::size_t>(0, pair_laws().size()),
                         [](const auto& info) { return pair_laws()[info.param].name; });

// A line without a file does not link; a file without its line is found here.
TEST(PairLaws, EveryFileWithALawHasItsLine) {
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::string(PIGMENT_SOURCE_DIR) + "/lib/forces")) {
    if (file.path().extension() != ".cpp") continue;
    std::ifstream in(file.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}}, stem = file.path().stem().string();
    if (text.find("PairLawEntry " + stem + "_law()") == std::string::npos) continue;
    ++files;
    EXPECT_TRUE(std::any_of(pair_laws().begin(), pair_laws().end(), [&](const PairLawEntry& entry) { return entry.name == stem; })) << stem;
  }
  EXPECT_EQ(files, static_cast<int>(pair_laws().size()));
}
