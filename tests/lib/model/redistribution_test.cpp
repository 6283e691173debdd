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

Cell cell_of(double height) { return {1, 1, height}; }

Redistribution interval(double residual, double fall, double height) {
  return {std::vector<double>(redistribution_slices, residual), std::vector<double>(redistribution_slices * redistribution_quarters, 0.0), fall,
          height};
}

// Ten intervals in which a layer of 10 um falls by 0.1 um each: 3 % of the height at a window's beginning are 0.30 um at first and
// 0.28 in the end, three intervals each.
TEST(Redistribution, WindowHoldsWhatTheLayerNeedsToShrinkByAShare) {
  std::deque<Redistribution> window;
  double height = 10;
  for (int k = 0; k < 10; ++k, height -= 0.1) {
    const bool whole = add_to_window(window, interval(k, 0.1, height), 0.03 - 1e-12);
    EXPECT_EQ(whole, k >= 2);
    EXPECT_EQ(window.size(), static_cast<std::size_t>(std::min(k + 1, 3)));
    EXPECT_EQ(window.back().residual[0], k);
  }
  // One that takes it all at once is a window by itself; one that rests adds nothing.
  EXPECT_TRUE(add_to_window(window, interval(0, 0.5, 9), 0.03));
  EXPECT_EQ(window.size(), 1u);
  EXPECT_TRUE(add_to_window(window, interval(0, 0, 8.5), 0.03));
  EXPECT_EQ(window.size(), 2u);
}

}  // namespace

TEST(Redistribution, IsNothingInALayerThatShrinksEvenly) {
  const Spheres s = spheres(20);
  Vec3Array after = s.position;
  for (Vec3& p : after) p.z() *= 19.0 / 20;
  for (Vec3& p : after) p.x() += 3;  // sideways does not count
  EXPECT_LT(redistribution_ratio({redistribution_between(s.position, after, s.radius, cell_of(20), 19)}), 1e-14);  // rounding
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
  const Redistribution one = redistribution_between(before, after, radius, cell_of(20), 19.5);
  EXPECT_DOUBLE_EQ(one.fall, 0.5);
  for (int b = 0; b < 10; ++b) EXPECT_NEAR(one.residual[b], -0.5 * (1 - (b + 0.5) / 10), 1e-15);
  EXPECT_NEAR(redistribution_ratio({one}), std::sqrt(0.3325), 1e-14);
  EXPECT_NEAR(redistribution_ratio({one, one, one}), std::sqrt(0.3325), 1e-14);  // the window does not change it
}

TEST(Redistribution, WeighsBySolidVolumeWithinASlice) {
  // Radii 1 and 2 in the lowest slice: volumes 1 and 8; only the small one moves, the surface rests but for 1e-3 um.
  const Vec3Array before{{0, 0, 0.5}, {1, 0, 0.5}}, after{{0, 0, 1.4}, {1, 0, 0.5}};
  const Redistribution r = redistribution_between(before, after, {1, 2}, cell_of(20), 19.999);
  EXPECT_NEAR(r.residual[0], 0.9 / 9 + 0.5 * 1e-3 / 20, 1e-15);
  for (int b = 1; b < 10; ++b) EXPECT_EQ(r.residual[b], 0);  // empty slices
}

TEST(Redistribution, CancelsWhereParticlesGiveWayAndComeBack) {
  const Spheres s = spheres(20);
  Vec3Array there = s.position;
  for (std::size_t k = 0; k < there.size(); ++k) there[k].z() += 1e-3 * (k % 3);
  const Redistribution away = redistribution_between(s.position, there, s.radius, cell_of(20), 20 - 1e-9),
                       back = redistribution_between(there, s.position, s.radius, cell_of(20 - 1e-9), 20 - 2e-9);
  const double alone = redistribution_ratio({away}), both = redistribution_ratio({away, back});
  EXPECT_GT(alone, 1e4);
  // Spheres near a border may be counted in the next slice on the way back: none is that near here.
  EXPECT_LT(both, 1e-3 * alone);
}

TEST(Redistribution, IsOneWhereTheSurfaceDidNotFall) {
  const Spheres s = spheres(20);
  EXPECT_EQ(redistribution_ratio({redistribution_between(s.position, s.position, s.radius, cell_of(20), 20)}), 1);
  EXPECT_EQ(redistribution_ratio({}), 1);
}

// 200 spheres in a layer that falls by 0.1 um, each moving by 0.02 um at random: the plain mean of 20 spheres of unequal size moves by
// 0.02/sqrt(8), 7 % of the fall. What is common to the layer is told from it: nothing in one, 0.03 um everywhere in the other.
TEST(Redistribution, DoesNotCountWhatChanceMoves) {
  constexpr int layers = 400;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal(0, 0.02);
  const Cell cell{5, 5, 20};
  double plain = 0, still = 0, drifting = 0, square = 0;
  int none = 0;
  for (int n = 0; n < layers; ++n) {
    Vec3Array before, after, drifted;
    std::vector<double> radius;
    for (int k = 0; k < 200; ++k) {
      before.emplace_back(15 * uniform(random) - 5, 15 * uniform(random) - 5, 20 * uniform(random));  // unwrapped
      radius.push_back(0.2 + uniform(random));
      const Vec3 even{before[k].x(), before[k].y(), before[k].z() * 19.9 / 20};
      after.push_back(even + Vec3(0, 0, normal(random)));
      drifted.push_back(after[k] + Vec3(0, 0, 0.03));
    }
    const Redistribution by_chance = redistribution_between(before, after, radius, cell, 19.9);
    double sum = 0, scatter = 0;
    for (double r : by_chance.residual) sum += r * r / redistribution_slices;
    for (double r : by_chance.scatter) scatter += r * r / redistribution_slices;
    plain += sum;
    square += std::pow(sum - scatter, 2);
    still += sum - scatter;
    none += redistribution_ratio({by_chance}) == 0;
    drifting += std::pow(redistribution_ratio({redistribution_between(before, drifted, radius, cell, 19.9)}), 2);
  }
  EXPECT_GT(std::sqrt(plain / layers) / 0.1, 0.05);
  EXPECT_LT(std::abs(still), 4 * std::sqrt(square));  // four standard errors
  EXPECT_NEAR(none, layers / 2, layers / 5);          // a difference that is nothing is below nothing half the time
  EXPECT_NEAR(std::sqrt(drifting / layers), 0.3, 0.01);
}

TEST(Redistribution, TakesAQuarterThatMovesAloneForChance) {
  // One sphere in each quarter of the lowest slice; one of them moves: mean m/4 with parts of 3m/16 and three times -m/16, times sqrt(4/3).
  Vec3Array before{{0.2, 0.2, 1}, {0.7, 0.2, 1}, {0.2, 0.7, 1}, {-0.3, 1.7, 1}}, after = before;
  after[3].z() += 0.4;
  const Redistribution r = redistribution_between(before, after, {1, 1, 1, 1}, {1, 1, 20}, 20 - 1e-9);
  EXPECT_NEAR(r.residual[0], 0.1, 1e-9);
  for (int q = 0; q < 3; ++q) EXPECT_NEAR(r.scatter[q], -0.025 * std::sqrt(4.0 / 3), 1e-9);
  EXPECT_NEAR(r.scatter[3], 0.075 * std::sqrt(4.0 / 3), 1e-9);
  EXPECT_LT(redistribution_ratio({r}) * 1e-9, 1e-5);  // the mean's square is its variance, 4/3 (3 + 9) m2/256
}
