#include "resistance/boundary_resistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/table.h"

using namespace pigment;
using namespace pigment::resistance;
using std::numbers::pi;

// Exact solutions in bispherical coordinates; radius 1, so that columns are in 6 pi and 8 pi.
TEST(BoundaryResistance, WallIsExactAtEveryGap) {
  const auto table = test::read_table("wall_resistance.csv");
  for (std::size_t k = 0; k < table.at("gap_over_a").size(); ++k) {
    const double gap = table.at("gap_over_a")[k];
    const BoundaryScalars w = wall_increment(1, gap);
    const double parallel = table.at("F_par(Ft*)")[k], rolling = table.at("T_rot(Tr*)")[k];
    EXPECT_NEAR(1 + w.perpendicular / (6 * pi), table.at("F_perp")[k], 2e-4 * table.at("F_perp")[k]) << gap;
    EXPECT_NEAR(1 + w.parallel / (6 * pi), parallel, 2e-4 * parallel) << gap;
    EXPECT_NEAR(1 + w.rolling / (8 * pi), rolling, 2e-4 * rolling) << gap;
    EXPECT_NEAR(1 + w.twist / (8 * pi), table.at("T_twist")[k], 2e-4 * table.at("T_twist")[k]) << gap;
    EXPECT_NEAR(w.coupling / (6 * pi), table.at("F_rot(Fr*)")[k], 2e-4 * std::sqrt(parallel * rolling)) << gap;
    // Reciprocity: the torque of a sliding sphere is the force of a spinning one.
    EXPECT_NEAR(w.coupling / (8 * pi), table.at("T_trans(Tt*)")[k], 2e-4 * std::sqrt(parallel * rolling)) << gap;
  }
}

TEST(BoundaryResistance, FreeSurfaceIsExactAtEveryGap) {
  const auto table = test::read_table("free_surface.csv");
  for (std::size_t k = 0; k < table.at("gap_over_a").size(); ++k) {
    const double gap = table.at("gap_over_a")[k];
    const BoundaryScalars w = free_surface_increment(1, gap);
    EXPECT_NEAR(1 + w.perpendicular / (6 * pi), table.at("F_perp")[k], 2e-4 * table.at("F_perp")[k]) << gap;
    EXPECT_NEAR(1 + w.parallel / (6 * pi), table.at("F_par")[k], 2e-4 * table.at("F_par")[k]) << gap;
    EXPECT_NEAR(1 + w.rolling / (8 * pi), table.at("T_rot")[k], 2e-4 * table.at("T_rot")[k]) << gap;
    EXPECT_NEAR(1 + w.twist / (8 * pi), table.at("T_twist")[k], 2e-4 * table.at("T_twist")[k]) << gap;
    EXPECT_NEAR(-w.coupling / (6 * pi), table.at("F_rot")[k], 2e-4) << gap;  // the table's surface lies below
  }
}

// The sum with isolated drag must be positive definite, between the rows of the tables as well, for both boundaries at once.
TEST(BoundaryResistance, DragNearBothBoundariesIsPositiveDefinite) {
  for (double low = 1e-6; low < 100; low *= 1.3)
    for (double high = 1e-6; high < 100; high *= 1.3) {
      const BoundaryScalars w = wall_increment(1, low), s = free_surface_increment(1, high);
      const double parallel = 6 * pi + w.parallel + s.parallel, rolling = 8 * pi + w.rolling + s.rolling, c = w.coupling + s.coupling;
      ASSERT_GT(parallel * rolling, c * c) << low << " " << high;
      ASSERT_GT(8 * pi + w.twist + s.twist, 0);
    }
}

TEST(BoundaryResistance, LorentzFarField) {
  // 1 + 9/8 a/z and 1 + 9/16 a/z to first order in a/z: at z = 1e4 a the next terms are 1e-8.
  EXPECT_NEAR(wall_increment(1, 1e4).perpendicular / (6 * pi) * 1e4, 9.0 / 8, 2e-3);
  EXPECT_NEAR(wall_increment(1, 1e4).parallel / (6 * pi) * 1e4, 9.0 / 16, 2e-3);
}
