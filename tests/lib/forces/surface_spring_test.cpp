#include "forces/surface_spring.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "config/node.h"

using namespace pigment;
using namespace pigment::forces;

namespace {

FreeSurfaceParameters surface(const std::string& block) {
  auto document = config::Document::from_text("free_surface: " + block);
  const FreeSurfaceParameters p = read_free_surface(document.root().block("free_surface"));
  document.check();
  return p;
}

const FreeSurfaceParameters arc = surface("{}"), gain = surface("{elongation: arc_minus_chord}");

}  // namespace

// (14), (15) as printed, and what the arc is longer than its chord, by the plain formulas.
TEST(SurfaceSpring, IsTheSourcesForce) {
  const double a = 0.5, sigma = 72000;
  for (double h : {1e-3, 0.02, 0.3, 0.5, 0.8}) {
    const double theta = std::acos((a - h) / a);
    EXPECT_NEAR(surface_spring(arc, a, h).force, sigma * 2 * a * theta, 1e-11 * sigma);
    EXPECT_NEAR(surface_spring(gain, a, h).force, sigma * 2 * a * (theta - std::sin(theta)), 1e-11 * sigma);
  }
  // The largest is 2 pi a sigma: 2.3e-7 N at 0.5 um.
  EXPECT_NEAR(surface_spring(arc, a, 2 * a * (1 - 1e-12)).force, 2 * M_PI * a * sigma, 1e-4 * sigma);
}

// Central differences over h/1000: their error is some 1e-6 of the slope.
TEST(SurfaceSpring, StiffnessIsTheForcesSlope) {
  for (const auto& p : {arc, gain})
    for (double h : {1e-4, 1e-3, 0.02, 0.3, 0.8}) {
      const double step = 1e-3 * h, slope = (surface_spring(p, 0.5, h + step).force - surface_spring(p, 0.5, h - step).force) / (2 * step);
      EXPECT_NEAR(surface_spring(p, 0.5, h).stiffness, slope, 1e-5 * slope);
    }
}

// Taking over at the roughness the spring begins with nothing, by either elongation: nothing jumps there. Out of the liquid
// (2 a), nothing pulls.
TEST(SurfaceSpring, BeginsAtZeroAndEndsWhenTheParticleHasLeft) {
  for (const auto& p : {arc, gain}) {
    EXPECT_EQ(surface_spring(p, 0.5, 0).force, 0);
    EXPECT_EQ(surface_spring(p, 0.5, -0.1).force, 0);
    EXPECT_EQ(surface_spring(p, 0.5, 1.0).force, 0);
    double before = 0;
    for (double h = 1e-18; h < 1e-3; h *= 10) {
      const double f = surface_spring(p, 0.5, h).force;
      EXPECT_GT(f, before);
      EXPECT_LT(f, 72000 * 2 * std::sqrt(2 * 0.5 * h) * 1.001);  // the arc's leading term, 2 sigma sqrt(2 a h)
      before = f;
    }
  }
  // Inverted the arc is h = a (1 - cos(F/(2 a sigma))): a load of 0.3 pN lifts by 4e-12 um.
  const double h = 0.5 * 2 * std::pow(std::sin(0.3 / (2 * 2 * 0.5 * 72000)), 2);
  EXPECT_NEAR(h, 4.3e-12, 1e-13);
  EXPECT_NEAR(surface_spring(arc, 0.5, h).force, 0.3, 1e-12);
}

TEST(SurfaceSpring, HoldsExactlyUpToHalfOfWhatWouldLiftByAHundredthOfANanometre) {
  EXPECT_NEAR(rigid_load(arc, 0.5), 72000 * 0.5 * std::acos(1 - 1e-5 / 0.5), 1e-6);
  EXPECT_LT(rigid_load(gain, 0.5), rigid_load(arc, 0.5));
  EXPECT_TRUE(std::isinf(rigid_load(surface("{model: constraint}"), 0.5)));
}

// Each load above what is held has one height, and none is skipped: the force rises all the way up, from what is held, without a jump, and
// where the spring takes over from its tangent the arc's slope does not jump either.
TEST(SurfaceSpring, WhatIsLiftedIsPulledBackMoreThanWhatIsHeld) {
  for (const auto& p : {arc, gain}) {
    const double load = rigid_load(p, 0.2);
    EXPECT_EQ(lifted_spring(p, 0.2, 0).force, load);
    double before = load;
    for (double h = 1e-7; h < 0.1; h *= 1.1) {
      const double f = lifted_spring(p, 0.2, h).force;
      EXPECT_GT(f, before);
      EXPECT_LT(f, 1.2 * before);  // 1.1 to the power of 3/2 (arc minus chord) or 1/2
      before = f;
    }
  }
  const double below = lifted_spring(arc, 0.2, 0.999 * rigid_protrusion).stiffness, above = lifted_spring(arc, 0.2, 1.001 * rigid_protrusion).stiffness;
  EXPECT_NEAR(below, above, 2e-3 * above);
}

TEST(SurfaceSpring, LiftsToWhereItBearsTheLoad) {
  for (const auto& p : {arc, gain})
    for (double h = 0.6 * rigid_protrusion; h < 0.2; h *= 3) EXPECT_NEAR(lifted_height(p, 0.2, lifted_spring(p, 0.2, h).force), h, 1e-3 * h);
  EXPECT_NEAR(lifted_height(arc, 0.2, 1e9), 0.2, 1e-3);
  EXPECT_NEAR(lifted_height(arc, 0.2, 0), 0.5 * rigid_protrusion, 1e-3 * rigid_protrusion);
}

// 6 sigma/d32 by hand: diameters 1 (twice) and 2: d32 = (2 + 8)/(2 + 4) = 5/3 um.
TEST(SurfaceSpring, EntryPressureIsTheScenesOrTheSolidsSurfaceTimesTension) {
  EXPECT_NEAR(entry_pressure(surface("{model: pressure_limited}"), {0.5, 1, 0.5}), 6 * 72000 / (5.0 / 3), 1e-6);
  EXPECT_EQ(entry_pressure(surface("{model: pressure_limited, max: 500 kPa}"), {0.5}), 500e3);
  EXPECT_EQ(entry_pressure(surface("{model: pressure_limited, max: auto}"), {0.5}), 6 * 72000);
  EXPECT_THROW(surface("{model: spring, max: 500 kPa}"), InputError);
  EXPECT_THROW(surface("{model: pressure_limited, max: 500 nm}"), InputError);
}
