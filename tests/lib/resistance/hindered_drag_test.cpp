#include "resistance/hindered_drag.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pigment::resistance;

// Carman and Kozeny: pressure gradient 180 mu U phi^2/((1 - phi)^3 d^2) at the superficial velocity U, so per sphere
// 3 pi mu d U times 10 phi/(1 - phi)^3. Their constant is good to some 5 %, and they lack the second term, 6 % at phi = 0.4.
TEST(HinderedDrag, IsCarmanAndKozenysInDenseBeds) {
  for (double phi : {0.4, 0.5, 0.6}) {
    const double kozeny = 10 * phi / std::pow(1 - phi, 3), whole = bed_drag_factor(phi) / (1 - phi);
    EXPECT_NEAR(whole / kozeny, 1, 0.07) << phi;
  }
}

// Random arrays, dilute [kim1985]: 1 + 3/sqrt(2) phi^(1/2) + 135/64 phi ln phi + 16.456 phi, the whole force over 3 pi mu d U. The
// bed's own fit is for phi >= 0.1; at 0.01 and 0.05 it is 4 and 7 % off.
TEST(HinderedDrag, FollowsTheDiluteExpansionOfRandomArrays) {
  for (double phi : {0.01, 0.05}) {
    const double expansion = 1 + 3 / std::sqrt(2) * std::sqrt(phi) + 135.0 / 64 * phi * std::log(phi) + 16.456 * phi;
    EXPECT_NEAR(bed_drag_factor(phi) / (1 - phi) / expansion, 1, 0.08) << phi;
  }
}

// By hand: phi = 0.5: 20 + 0.25 (1 + 1.5 sqrt(0.5)).
TEST(HinderedDrag, HandValue) { EXPECT_NEAR(bed_drag_factor(0.5), 20.5151650429, 1e-9); }

TEST(HinderedDrag, SingleSpheresOfAnySizeHaveStokesDrag) {
  for (double ratio : {0.2, 1.0, 5.0}) EXPECT_NEAR(hindered_drag_factor(0, ratio), 1, 1e-15);
  // Continuous where the sizes begin to count, and in full from phi = 0.1 on.
  EXPECT_NEAR(hindered_drag_factor(1e-3, 5) / hindered_drag_factor(1e-3, 1), 1, 1e-4);
  EXPECT_NEAR(hindered_drag_factor(0.1, 5) / hindered_drag_factor(0.1, 1), 5, 1e-12);
}
