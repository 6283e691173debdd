#include "assembly/surface_search.h"

#include <gtest/gtest.h>

using pigment::assembly::SurfaceSearch;

namespace {

// Looks at heights until one stands; says how many it looked at.
template <typename Pressure>
int find(SurfaceSearch& search, Pressure pressure) {
  for (int tries = 1; tries <= 60; ++tries)
    if (search.settle(pressure(search.height()))) return tries;
  return -1;
}

}  // namespace

TEST(SurfaceSearch, FollowsTheDewateringWhileItPressesLess) {
  SurfaceSearch search(9.9, 9.9, 0.02, 500);
  EXPECT_EQ(find(search, [](double) { return 300.0; }), 1);
  EXPECT_EQ(search.height(), 9.9);
}

// A viscous layer, P proportional to how far it falls from 10; a stiff one, as (10 - h)^-2 grows; and air-entry reached by a rise.
TEST(SurfaceSearch, FindsTheEntryPressure) {
  const auto viscous = [](double h) { return 1e5 * (10 - h); };
  const auto stiff = [](double h) { return 1e-2 / ((h - 9.899) * (h - 9.899)); };
  for (double guess : {9.9001, 9.99, 9.9951, 9.9999, 10.0, 10.05}) {
    SurfaceSearch a(9.9, guess, 1e-3, 500), b(9.9, guess, 1e-3, 500);
    const int tries = find(a, viscous);
    EXPECT_GT(tries, 0);
    EXPECT_LE(tries, 15) << guess;
    EXPECT_NEAR(viscous(a.height()), 500, 5);
    EXPECT_LE(find(b, stiff), 25) << guess;
    EXPECT_NEAR(stiff(b.height()), 500, 5);
  }
}

TEST(SurfaceSearch, GoesBackToTheDewateringsHeight) {
  SurfaceSearch search(9.9, 10, 0.02, 500);  // it lagged, and the layer has given way
  EXPECT_GT(find(search, [](double h) { return 100 * (10 - h); }), 0);
  EXPECT_EQ(search.height(), 9.9);
}

// A pressure that jumps over the entry pressure leaves no height where they agree: the search ends where the jump is.
TEST(SurfaceSearch, EndsAtAJump) {
  SurfaceSearch search(9.9, 9.95, 0.02, 500);
  const auto jump = [](double h) { return h < 9.97 ? 800.0 : 0.0; };
  const int tries = find(search, jump);
  EXPECT_GT(tries, 0);
  EXPECT_LE(tries, 15);
  EXPECT_NEAR(search.height(), 9.97, 0.01 * 0.02);
  EXPECT_EQ(jump(search.height()), 0);  // on the side where it does not press too hard
}
