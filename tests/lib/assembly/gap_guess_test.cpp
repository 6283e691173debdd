#include "assembly/gap_guess.h"

#include <gtest/gtest.h>

namespace pigment::assembly {
namespace {

// A Born wall with a well before it, 1/h^8 - 1/h^2 in units in which they are equal at 1, among surroundings that answer a force f with
// the gap rest + f/stiffness; and Newton's method as the engine has it, tangents without negative stiffness.
struct OnePair {
  double rest, stiffness;

  static double force(double h) { return std::pow(h, -8) - std::pow(h, -2); }
  static double slope(double h) { return std::max(8 * std::pow(h, -9) - 2 * std::pow(h, -3), 0.0); }
  // Passes until the gap is what the force was linearised about; 100 where it never is.
  int passes(double guess, double& gap) const {
    GapBracket bracket;
    for (int pass = 1; pass < 100; ++pass) {
      const double k = slope(guess), f = force(guess);
      gap = (rest * stiffness + f + k * guess) / (stiffness + k);
      if (!off_guess(gap, guess, true)) return pass;
      guess = bracket.take(next_gap(gap, guess, f + k * (guess - gap), [](double h) { return force(h); }), guess);
    }
    return 100;
  }
};

// Soft surroundings that press with 10, 100, 1000 from a gap of 30: the force is imposed, and its gap on the wall known.
TEST(NextGap, FindsTheWallUnderAnImposedForceInAFewPasses) {
  for (double load : {10.0, 100.0, 1000.0}) {
    const double stiffness = 1e-3, rest = 1 - load / stiffness;
    double gap = 0;
    EXPECT_LE((OnePair{rest, stiffness}.passes(30, gap)), 6) << load;
    EXPECT_NEAR(gap, std::pow(load, -1.0 / 8), 0.05);  // the well's 1/h^2 and the criterion of 5 %
  }
}

// Stiff surroundings impose the gap.
TEST(NextGap, TakesAnImposedGap) {
  for (double rest : {0.8, 1.2, 5.0}) {
    double gap = 0;
    EXPECT_LE((OnePair{rest, 1e6}.passes(20, gap)), 6) << rest;
    EXPECT_NEAR(gap, rest, 1e-4 * rest);
  }
}

// From deep inside the wall, where plain iterations come out by an eighth of the gap at a time.
TEST(NextGap, ComesOutOfAWallInAFewPasses) {
  double gap = 0;
  EXPECT_LE((OnePair{1 - 1e3, 1e-2}.passes(0.2, gap)), 7);  // load 10
  EXPECT_NEAR(gap, std::pow(10.0, -1.0 / 8), 0.05);
}

// Between closed and open the well has no tangent that leads to the solution, and plain iterations go from one side to the other for ever.
TEST(NextGap, SettlesInAWell) {
  for (double pull : {0.0, 0.1, 0.2, 0.3, 0.4})
    for (double stiffness : {0.01, 0.1, 1.0})
      for (double guess : {0.7, 1.1, 1.5, 3.0}) {
        double gap = 0;
        EXPECT_LT((OnePair{1.1 + pull / stiffness, stiffness}.passes(guess, gap)), 25) << pull << " " << stiffness << " " << guess;
        EXPECT_GT(gap, 0);
      }
}

// A double layer of 1 nm, its attraction and a Born wall, um and pN: the most that keeps a pair apart is felt at 0.6 nm, and what is
// pressed nearer comes to rest on the wall. From before the barrier it takes two guesses to get there, not one for every gap on the way.
TEST(NextGap, FallsOverABarrierToTheWall) {
  const auto force = [](double h) { return 400 * std::exp(-h / 1e-3) - 80 * std::pow(5e-4 / h, 2) + 20 * std::pow(3e-4 / h, 9); };
  ASSERT_LT(force(4e-4), force(6e-4));
  const double load = force(6e-4) + 5;
  double wall = 4e-4;
  while (force(wall) < load) wall *= 0.9999;
  for (double came_out : {4.4e-4, 4e-4, 3e-4}) EXPECT_NEAR(next_gap(came_out, 7e-4, load, force), wall, 0.01 * wall) << came_out;
  // One that is let go comes out as far as it says.
  EXPECT_EQ(next_gap(9e-4, 7e-4, force(9e-4), force), 9e-4);
}

TEST(GapBracket, HalvesWhatLeavesIt) {
  GapBracket bracket;
  EXPECT_EQ(bracket.take(2, 1), 2);              // the solution lies above 1
  EXPECT_NEAR(bracket.take(0.5, 2), std::sqrt(2.0), 1e-6);  // and below 2
  EXPECT_EQ(bracket.take(1.2, 1.4), 1.2);
  EXPECT_NEAR(bracket.take(5, 1.2), std::sqrt(1.2 * 1.4), 1e-6);
}

// Other gaps move as well: a solution that has left an end of the bracket twice running is not held back by it.
TEST(GapBracket, LetsGoOfAnEndThatTwoPassesWouldLeave) {
  GapBracket stale;
  EXPECT_EQ(stale.take(2.0, 1.0), 2.0);                    // above 1
  EXPECT_DOUBLE_EQ(stale.take(0.5, 2.0), std::sqrt(2.0));  // below 2, and below 1, which was not so
  EXPECT_EQ(stale.take(0.5, std::sqrt(2.0)), 0.5);         // nor is it
  EXPECT_EQ(stale.take(0.4, 0.5), 0.4);
  // One that leaves it on either side in turn does not count.
  GapBracket turns;
  turns.take(2.0, 1.0);
  EXPECT_DOUBLE_EQ(turns.take(0.5, 2.0), std::sqrt(2.0));
  EXPECT_EQ(turns.take(1.9, std::sqrt(2.0)), 1.9);
  EXPECT_DOUBLE_EQ(turns.take(0.5, 1.9), std::sqrt(1.9 * static_cast<double>(std::sqrt(2.0f))));
}

// A gap that is foretold is believed where no force is felt, and to half the range or 15 % where one is.
TEST(FirstGuess, KeepsNearWhereForcesAreFelt) {
  const double range = 1;
  EXPECT_EQ(first_guess(20, 15, range), 15);
  EXPECT_EQ(first_guess(20, 30, range), 30);
  EXPECT_EQ(first_guess(20, 2, range), 8);        // to where forces begin
  EXPECT_EQ(first_guess(20, -5, range), 8);
  EXPECT_DOUBLE_EQ(first_guess(6.5, 12, range), 7);  // held there by what little is felt
  EXPECT_DOUBLE_EQ(first_guess(5, 3, range), 4.5);
  EXPECT_DOUBLE_EQ(first_guess(5, 9, range), 5.5);
  EXPECT_DOUBLE_EQ(first_guess(5, 4.8, range), 4.8);
  EXPECT_DOUBLE_EQ(first_guess(0.32, 0.06, range), 0.272);
  EXPECT_DOUBLE_EQ(first_guess(0.32, 9, range), 0.368);
  for (double gap = 0.01; gap < 30; gap *= 1.1)
    for (double foretold = -1; foretold < 40; foretold += 0.7) EXPECT_GT(first_guess(gap, foretold, range), 0.19 * gap);
}

}  // namespace
}  // namespace pigment::assembly
