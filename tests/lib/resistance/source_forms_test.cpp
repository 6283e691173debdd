#include "resistance/source_forms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/table.h"

using namespace pigment::resistance;
using std::numbers::pi;

// The errors that the exact tables give the source's boundary forms: stated where the model is offered, and so held here.
TEST(SourceForms, BoundaryErrorsAreThoseStated) {
  const auto error = [](const std::string& file, bool wall, double gap) {
    const auto table = pigment::test::read_table(file);
    for (std::size_t k = 0; k < table.at("gap_over_a").size(); ++k)
      if (std::abs(table.at("gap_over_a")[k] / gap - 1) < 1e-9) {
        const double increment = wall ? source_wall_increment(1, gap, {}).perpendicular : source_free_surface_increment(1, gap).perpendicular;
        return 100 * ((1 + increment / (6 * pi)) / table.at("F_perp")[k] - 1);
      }
    return std::nan("");
  };
  EXPECT_NEAR(error("wall_resistance.csv", true, 1e-4), -0.26, 0.01);
  EXPECT_NEAR(error("wall_resistance.csv", true, 1e-3), -1.9, 0.05);
  EXPECT_NEAR(error("wall_resistance.csv", true, 1e-2), -11, 0.5);
  EXPECT_NEAR(error("wall_resistance.csv", true, 1e-1), -43, 0.5);
  EXPECT_NEAR(error("free_surface.csv", false, 1e-4), -0.41, 0.01);
  EXPECT_NEAR(error("free_surface.csv", false, 1e-2), -17, 0.5);
}

TEST(SourceForms, PairsShareTheLeadingTermsWithTheExactForm) {
  for (double ratio : {1.0, 4.0, 10.0}) {
    const PairScalars s = source_pair_scalars(ratio, 1, 1e-6, {}), e = tapered_pair_scalars(ratio, 1, 1e-6, {});
    EXPECT_NEAR(s.squeeze, e.squeeze, 1e-4 * e.squeeze);
    EXPECT_NEAR(s.shear, e.shear, 0.2 * e.shear);  // what the constants are worth at ln 1e6
    EXPECT_EQ(s.shear_pump, 0);
  }
}

TEST(SourceForms, WallIsPositiveDefiniteWithDrag) {
  for (double gap = 1e-6; gap < 10; gap *= 1.3) {
    const BoundaryScalars w = source_wall_increment(1, gap, {});
    EXPECT_GE(w.perpendicular, 0);
    EXPECT_GE(w.parallel * w.rolling - w.coupling * w.coupling, -1e-9);
  }
}
