// Equilibrium of two spheres under DLVO and depletion forces and full lubrication: the gap's statistics against Boltzmann's
// integral, for the noise that obeys fluctuation and dissipation; and against the integrals of what two wrong schemes sample,
// the same noise without its drift and k_brown. Near contact all three are told apart; where the well is wide the drift's two
// parts, along and across the line of centres, nearly cancel.
//
// Seeds are fixed. A check fails by chance, for another seed, where a mean over independent pairs is off by more than 4 standard
// errors: 6e-5 each. `bias` is what the step adds to it, relative.
#include <gtest/gtest.h>

#include "support/thermal_pairs.h"

using namespace pigment;
using test::GapStatistics;
using test::ThermalPairs;

namespace {

void expect_near(const GapStatistics& run, const GapStatistics& exact, double bias, const char* what) {
  EXPECT_NEAR(run.mean, exact.mean, 4 * run.mean_error + bias * exact.mean) << what;
  EXPECT_NEAR(run.deviation, exact.deviation, 4 * run.deviation_error + bias * exact.deviation) << what;
}

// Whether a run is off in its mean or its deviation by more than chance and bias allow.
bool is_off(const GapStatistics& run, const GapStatistics& exact, double bias) {
  return std::abs(run.mean - exact.mean) > 4 * run.mean_error + bias * exact.mean ||
         std::abs(run.deviation - exact.deviation) > 4 * run.deviation_error + bias * exact.deviation;
}

struct Case {
  std::string colloidal;
  double radius_a, radius_b;
  ThermalPairs::Range range;     // of gaps: outside the primary minimum, inside the reach of the attraction
  double start, step, duration;  // um, ms, ms
  int pairs;
};

// A well of 14 kT with its bottom at 27 nm: double layer of 5 nm, weak attraction over 200 nm.
const Case wide{"{electrostatic: {debye_length: 5 nm}, van_der_waals: {hamaker_constant: 1e-21 J}, born: {}, "
                "depletion: {depletant_radius: 100 nm, osmotic_pressure: 4 Pa}}",
                0.25, 0.25, {0.002, 0.2}, 0.03, 1.0 / 64, 8, 200};
// Contact range: a double layer of 1 nm, bottom of the well at 5 nm, gaps from 3 nm on, unequal spheres. Here the mobility changes
// by its own size within the well, so that the drift moves the mean gap by a tenth of it.
const Case near{"{electrostatic: {debye_length: 1 nm}, depletion: {depletant_radius: 100 nm, osmotic_pressure: 4 Pa}}",
                0.3, 0.2, {0.0005, 0.2}, 0.012, 1.0 / 128, 8, 200};

ThermalPairs pairs_of(const Case& c) {
  ThermalPairs pairs(c.colloidal, c.radius_a, c.radius_b, c.pairs, c.start);
  pairs.problem.stepping.time_step = c.step;
  return pairs;
}

// Steps and times are powers of two, so that samples fall on whole steps and none is cut short.
GapStatistics run(const ThermalPairs& pairs, const Case& c) { return pairs.run(c.duration / 4, c.duration, c.duration / 64); }

}  // namespace

TEST(BoltzmannSeparation, OfFluctuationDissipationIsExact) {
  for (const Case& c : {wide, near}) {
    const ThermalPairs pairs = pairs_of(c);
    const GapStatistics s = run(pairs, c);
    expect_near(s, pairs.exact(c.range), 0.01, "fluctuation and dissipation");
    if (c.step == near.step) {
      EXPECT_TRUE(is_off(s, pairs.without_drift(c.range), 0.01)) << s.mean << " " << s.deviation;
    }
    EXPECT_TRUE(is_off(s, pairs.of_k_brown(c.range), 0.01)) << s.mean << " " << s.deviation;
  }
}

TEST(BoltzmannSeparation, NoiseWithoutDriftSamplesWhatItsItoEquationSays) {
  for (const Case& c : {wide, near}) {
    ThermalPairs pairs = pairs_of(c);
    pairs.problem.interactions.brownian->drift = false;
    const GapStatistics s = run(pairs, c);
    expect_near(s, pairs.without_drift(c.range), 0.01, "without drift");
    if (c.step == near.step) {
      EXPECT_TRUE(is_off(s, pairs.exact(c.range), 0.01)) << s.mean << " " << s.deviation;
    }
  }
}

// The source's noise has the strength of isolated drag: a near pair is far too cold. Its own step error is larger,
// since the step is implicit.
TEST(BoltzmannSeparation, KBrownIsTooCold) {
  for (const Case& c : {wide, near}) {
    ThermalPairs pairs = pairs_of(c);
    pairs.problem.interactions.brownian->model = forces::BrownianParameters::Model::KBrown;
    const GapStatistics s = run(pairs, c), exact = pairs.exact(c.range);
    expect_near(s, pairs.of_k_brown(c.range), 0.06, "k_brown");
    EXPECT_LT(s.deviation, 0.5 * exact.deviation);
    EXPECT_LT(s.mean, 0.95 * exact.mean);
  }
}

// At the step that the engine chooses the mean gap is at most 3 % off, at a Debye length of 5 nm and of 1 nm.
TEST(BoltzmannSeparation, AtTheDefaultStepIsWithinThreePercent) {
  for (Case c : {wide, near}) {
    ThermalPairs pairs = pairs_of(c);
    pairs.problem.stepping.time_step.reset();
    c.duration *= 2;
    const GapStatistics s = pairs.run(c.duration / 4, c.duration, c.duration / 16);  // far apart: few steps are cut short
    EXPECT_NEAR(s.mean, pairs.exact(c.range).mean, 0.03 * s.mean);
  }
}
