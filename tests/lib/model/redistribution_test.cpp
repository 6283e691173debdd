#include "model/redistribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace pigment;

namespace {

// Some spheres in each tenth of a layer of this height, lowest first.
struct Spheres {
  Vec3Array position;
  std::vector<double> radius;
};
Spheres spheres(double height) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform;
  Spheres s;
  for (int b = 0; b < redistribution_slices; ++b)
    for (int k = 0; k < 7; ++k) {
      s.position.emplace_back(uniform(random), uniform(random), height * (b + uniform(random)) / redistribution_slices);
      s.radius.push_back(0.1 + uniform(random));
    }
  return s;
}

Redistribution interval(double residual, double fall, double height) {
  return {std::vector<double>(redistribution_slices, residual), fall, height};
}

constexpr double share = 0.03;  // of the height, a window

// Ten intervals in which a layer of 10 um falls by 0.1 um each: 4.5 % of the height at their beginning are 0.45 um at first and
// 0.41 in the end, five intervals each.
TEST(Redistribution, WindowHoldsWhatTheLayerNeedsToShrinkByAShareAndAHalf) {
  std::deque<Redistribution> window;
  double height = 10;
  for (int k = 0; k < 10; ++k, height -= 0.1) {
    const bool whole = add_to_window(window, interval(k, 0.1, height), share);
    EXPECT_EQ(whole, k >= 4);
    EXPECT_EQ(window.size(), static_cast<std::size_t>(std::min(k + 1, 5)));
    EXPECT_EQ(window.back().residual[0], k);
  }
  // One that takes it all at once needs a second half beside it; one that rests adds nothing.
  EXPECT_TRUE(add_to_window(window, interval(0, 0.5, 9), share));
  EXPECT_EQ(window.size(), 2u);
  EXPECT_TRUE(add_to_window(window, interval(0, 0, 8.5), share));
  EXPECT_EQ(window.size(), 2u);
  std::deque<Redistribution> one;
  EXPECT_FALSE(add_to_window(one, interval(0, 0.5, 9), share));
}

// Intervals of 1 % of 100 um each: windows of three of them, halves of one and two, and the last one and a half are two windows.
std::deque<Redistribution> intervals(const std::vector<double>& residual) {
  std::deque<Redistribution> all;
  for (double r : residual) all.push_back(interval(r, 1, 100));
  return all;
}

}  // namespace

TEST(Redistribution, IsNothingInALayerThatShrinksEvenly) {
  const Spheres s = spheres(20);
  Vec3Array after = s.position;
  for (Vec3& p : after) p.z() *= 19.0 / 20;
  for (Vec3& p : after) p.x() += 3;  // sideways does not count
  const Redistribution one = redistribution_between(s.position, after, s.radius, 20, 19);
  EXPECT_LT(redistribution_ratio({one, one}, share), 1e-14);  // rounding
}

// Every particle falls with the surface: in slice b of ten, at height (b + 1/2) H/10, even shrinking takes (b + 1/2)/10 of that,
// and the root mean square of 1 - (b + 1/2)/10 is sqrt(0.3325).
TEST(Redistribution, OfALayerThatFallsBodilyIsByHand) {
  Vec3Array before;
  std::vector<double> radius;
  for (int b = 0; b < 10; ++b) {
    before.emplace_back(0, 0, (b + 0.5) * 2);
    radius.push_back(0.2 + 0.1 * b);
  }
  Vec3Array after = before;
  for (Vec3& p : after) p.z() -= 0.5;
  const Redistribution one = redistribution_between(before, after, radius, 20, 19.5);
  EXPECT_DOUBLE_EQ(one.fall, 0.5);
  for (int b = 0; b < 10; ++b) EXPECT_NEAR(one.residual[b], -0.5 * (1 - (b + 0.5) / 10), 1e-15);
  EXPECT_NEAR(redistribution_ratio({one, one}, share), std::sqrt(0.3325), 1e-14);
  EXPECT_NEAR(redistribution_ratio({one, one, one, one, one}, share), std::sqrt(0.3325), 1e-14);  // the window does not change it
}

TEST(Redistribution, WeighsBySolidVolumeWithinASlice) {
  // Radii 1 and 2 in the lowest slice: volumes 1 and 8; only the small one moves, the surface rests but for 1e-3 um.
  const Vec3Array before{{0, 0, 0.5}, {1, 0, 0.5}}, after{{0, 0, 1.4}, {1, 0, 0.5}};
  const Redistribution r = redistribution_between(before, after, {1, 2}, 20, 19.999);
  EXPECT_NEAR(r.residual[0], 0.9 / 9 + 0.5 * 1e-3 / 20, 1e-15);
  for (int b = 1; b < 10; ++b) EXPECT_EQ(r.residual[b], 0);  // empty slices
}

TEST(Redistribution, IsTheProductOfTheHalvesOfTheLastWindowsByHand) {
  // The last two windows: {3 | 4, 5} and {2 | 3, 4}.
  const double newer = std::sqrt(3 * 4.5), older = std::sqrt(2 * 3.5);
  EXPECT_NEAR(redistribution_ratio(intervals({1, 2, 3, 4, 5}), share), std::sqrt((newer * newer + older * older) / 2), 1e-14);
  // Weighed by what the layer falls at their ends: {6 | 5} by 1 um, {2 | 6} by 2 um.
  const std::deque<Redistribution> unequal{interval(2, 2, 100), interval(6, 2, 100), interval(5, 1, 100)};
  EXPECT_NEAR(redistribution_ratio(unequal, share), std::sqrt((3.0 * 5 * 1 + 1 * 3 * 2) / 3), 1e-14);
}

TEST(Redistribution, IsNothingWhereTheHalvesMoveAgainstEachOther) {
  const Spheres s = spheres(20);
  Vec3Array there = s.position;
  for (std::size_t k = 0; k < there.size(); ++k) there[k].z() += 1e-3 * (k % 3);
  const Redistribution away = redistribution_between(s.position, there, s.radius, 20, 20 - 1e-9),
                       back = redistribution_between(there, s.position, s.radius, 20 - 1e-9, 20 - 2e-9);
  EXPECT_GT(redistribution_ratio({away, away}, share), 1e4);
  EXPECT_EQ(redistribution_ratio({away, back}, share), 0);
}

TEST(Redistribution, IsOneWhereTheSurfaceDidNotFall) {
  const Spheres s = spheres(20);
  const Redistribution rest = redistribution_between(s.position, s.position, s.radius, 20, 20), fall = interval(0, 1, 20);
  EXPECT_EQ(redistribution_ratio({rest, rest}, share), 1);
  EXPECT_EQ(redistribution_ratio({fall, rest}, share), 1);
  EXPECT_EQ(redistribution_ratio({fall}, share), 1);
  EXPECT_EQ(redistribution_ratio({}, share), 1);
}

// 200 spheres in a layer that falls by 0.1 um at a time, each moving by 0.02 um at random: the mean of 20 spheres of unequal size
// moves by 0.02/sqrt(8), 7 % of the fall. What is common to the layer is told from it: nothing in one, 0.03 um everywhere in the other.
TEST(Redistribution, DoesNotCountWhatChanceMoves) {
  constexpr int layers = 400;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal(0, 0.02);
  double plain = 0, drifting = 0;
  int none = 0;
  for (int n = 0; n < layers; ++n) {
    std::deque<Redistribution> by_chance, with_drift;
    std::vector<double> radius;
    Vec3Array before;
    for (int k = 0; k < 200; ++k) {
      before.emplace_back(5 * uniform(random), 5 * uniform(random), 20 * uniform(random));
      radius.push_back(0.2 + uniform(random));
    }
    for (int half = 0; half < 2; ++half) {
      Vec3Array after, drifted;
      for (const Vec3& p : before) {
        after.emplace_back(p.x(), p.y(), p.z() * 19.9 / 20 + normal(random));
        drifted.push_back(after.back() + Vec3(0, 0, 0.03));
      }
      by_chance.push_back(redistribution_between(before, after, radius, 20, 19.9));
      with_drift.push_back(redistribution_between(before, drifted, radius, 20, 19.9));
    }
    for (double r : by_chance[0].residual) plain += r * r / redistribution_slices;
    none += redistribution_ratio(by_chance, share) == 0;
    drifting += std::pow(redistribution_ratio(with_drift, share), 2);
  }
  EXPECT_GT(std::sqrt(plain / layers) / 0.1, 0.05);
  EXPECT_NEAR(none, layers / 2, 4 * std::sqrt(layers) / 2);  // below nothing half the time, to four standard deviations
  EXPECT_NEAR(std::sqrt(drifting / layers), 0.3, 0.01);
}
