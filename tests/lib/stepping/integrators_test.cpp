// Each integrator against its own limit of small steps: the order it claims, and what it does where steps are too long.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assembly/interaction_curves.h"
#include "base/error.h"
#include "base/random.h"
#include "stepping/step_context.h"
#include "support/one_layer.h"

using namespace pigment;
using Integrator = stepping::SteppingParameters::Integrator;

namespace {

struct Setting {
  stepping::Problem problem;
  Vec3Array position;
};

// Three charged spheres of different sizes, pressed onto each other askew by weight: every gap, force and resistance changes
// smoothly in time.
Setting settling_triplet() {
  Setting s;
  s.problem = test::empty_problem();
  s.problem.interactions.gravity = forces::GravityParameters{300};
  auto document = config::Document::from_text("colloidal: {electrostatic: {debye_length: 20 nm}}");
  s.problem.interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  test::add_particle(s.problem, s.position, 0.5, Vec3(50, 50, 50));
  test::add_particle(s.problem, s.position, 0.3, Vec3(50.35, 50, 50.78));
  test::add_particle(s.problem, s.position, 0.4, Vec3(49.9, 50.75, 50.6));
  s.problem.particles.mass[0] = 1e-3 * Particles::sphere_volume(0.5);
  return s;
}

Vec3Array after(const Setting& s, Integrator integrator, double step, int steps) {
  stepping::Problem problem = s.problem;
  problem.stepping.integrator = integrator;
  problem.stepping.time_step = step;
  stepping::RunState state = stepping::initial_state(problem, s.position);
  stepping::Stepper stepper(problem, state);
  for (int k = 0; k < steps; ++k) stepper.advance(state, step);
  return state.position;
}

double distance(const Vec3Array& a, const Vec3Array& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, (a[k] - b[k]).norm());
  return most;
}

class Order : public testing::TestWithParam<std::pair<Integrator, double>> {};

// Van der Waals and Born forces alone, no particle yet, stepped by convex splitting.
Setting uncharged() {
  Setting s;
  s.problem = test::empty_problem();
  auto document = config::Document::from_text("colloidal: {van_der_waals: {hamaker_constant: 1e-20 J}, born: {collision_diameter: 0.5 nm, hamaker_constant: 1e-20 J}}");
  s.problem.interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  s.problem.interactions.surface_potential = {0};
  s.problem.stepping.integrator = Integrator::ConvexSplitting;
  return s;
}

// Adds four spheres of 0.2 um, each so far (um) from the others, and gravity, by which one that has more mass than the liquid in its place is
// pulled at: the mass returned.
double add_tetrahedron(Setting& s, double gap) {
  const double a = 0.2, side = 2 * a + gap;
  test::add_particle(s.problem, s.position, a, Vec3(50, 50, 50));
  test::add_particle(s.problem, s.position, a, Vec3(50 + side, 50, 50));
  test::add_particle(s.problem, s.position, a, Vec3(50 + side / 2, 50 + side * std::sqrt(0.75), 50));
  test::add_particle(s.problem, s.position, a, Vec3(50 + side / 2, 50 + side * std::sqrt(1.0 / 12), 50 - side * std::sqrt(2.0 / 3)));
  s.problem.interactions.gravity = forces::GravityParameters{};
  return liquid_at(s.problem.interactions.liquid, s.problem.interactions.liquid.temperature).density * Particles::sphere_volume(a);
}

}  // namespace

// The error against the converged path falls as step^order: halving the step four times over must show it within a sixth. The
// reference is the explicit midpoint rule at a hundredth of the finest step, an independent method.
TEST_P(Order, IsAsClaimed) {
  const auto [integrator, order] = GetParam();
  const Setting s = settling_triplet();
  const double duration = 0.4;
  const Vec3Array reference = after(s, Integrator::ExplicitMidpoint, duration / 12800, 12800);
  const double coarse = distance(after(s, integrator, duration / 32, 32), reference);
  const double fine = distance(after(s, integrator, duration / 128, 128), reference);
  EXPECT_GT(coarse, 1e-9);  // um: there is an error to speak of
  EXPECT_NEAR(std::log2(coarse / fine) / 2, order, order / 6);
}

INSTANTIATE_TEST_SUITE_P(Integrators, Order,
                         testing::Values(std::pair{Integrator::ExplicitEuler, 1.0}, std::pair{Integrator::LinearlyImplicit, 1.0},
                                         std::pair{Integrator::NewtonImplicit, 1.0}, std::pair{Integrator::ExplicitMidpoint, 2.0},
                                         std::pair{Integrator::Extrapolated, 2.0}, std::pair{Integrator::BackwardDifferentiation, 2.0},
                                         std::pair{Integrator::ConvexSplitting, 1.0}));

// A pair pressed together by a load that would carry it through itself in one step: the Newton and the extrapolated step keep
// it open at the length asked for, the linearly implicit one takes a shorter step, the explicit ones refuse.
TEST(Integrators, LongStepsNeverOverlap) {
  Setting s;
  s.problem = test::empty_problem();
  s.problem.interactions.gravity = forces::GravityParameters{1e4};  // closes the gap by e^7 in the step
  test::add_particle(s.problem, s.position, 0.5, Vec3(50, 50, 50));
  test::add_particle(s.problem, s.position, 0.5, Vec3(50, 50, 51.05));
  s.problem.particles.mass[0] = 1e-3 * Particles::sphere_volume(0.5);
  for (Integrator integrator : {Integrator::NewtonImplicit, Integrator::Extrapolated, Integrator::LinearlyImplicit}) {
    s.problem.stepping.integrator = integrator;
    s.problem.stepping.time_step = 1.0;
    stepping::RunState state = stepping::initial_state(s.problem, s.position);
    stepping::Stepper stepper(s.problem, state);
    const stepping::StepReport report = stepper.advance(state, 1.0);
    EXPECT_GT((state.position[1] - state.position[0]).norm(), 1.0);
    if (integrator == Integrator::LinearlyImplicit) EXPECT_LT(report.step, 1.0);
    else EXPECT_EQ(report.step, 1.0);
  }
  for (Integrator integrator : {Integrator::ExplicitEuler, Integrator::ExplicitMidpoint}) {
    s.problem.stepping.integrator = integrator;
    stepping::RunState state = stepping::initial_state(s.problem, s.position);
    stepping::Stepper stepper(s.problem, state);
    EXPECT_THROW(stepper.advance(state, 1.0), NumericsError);
  }
}

// Without lubrication no gap has to stay open, and a step far too long for a force throws its particles away without one that is closed.
TEST(Stepper, NamesAParticleThatAStepThrowsAway) {
  Setting s = settling_triplet();
  s.problem.interactions.hydrodynamics.model = resistance::HydrodynamicsParameters::Model::Drag;
  s.problem.interactions.gravity.reset();
  test::add_particle(s.problem, s.position, 0.3, Vec3(10, 10, 50));
  test::add_particle(s.problem, s.position, 0.3, Vec3(10, 10, 50.6001));
  s.problem.stepping.integrator = Integrator::ExplicitEuler;
  s.problem.stepping.time_step = 1e3;
  stepping::RunState state = stepping::initial_state(s.problem, s.position);
  stepping::Stepper stepper(s.problem, state);
  try {
    stepper.advance(state, 1e3);
    ADD_FAILURE() << "it went on";
  } catch (const NumericsError& e) {
    EXPECT_NE(std::string(e.what()).find("further than the layer is wide"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("of radius 0.3 um"), std::string::npos) << e.what();
  }
  EXPECT_EQ(state.position, s.position);  // as it was before the step
  // Steps that may be shorter are.
  s.problem.stepping.integrator = Integrator::LinearlyImplicit;
  state = stepping::initial_state(s.problem, s.position);
  stepping::Stepper implicit(s.problem, state);
  implicit.advance(state, 1e3);
  EXPECT_LT(distance(state.position, s.position), s.problem.cell.width_x);
}

// Of three gaps one is off by a tenth of itself, another has snapped: that counts as 0.3, however far it went. (Before the first step the scale
// beside the gaps is zero.)
TEST(Integrators, OneGapThatSnapsCountsForNoMoreThanAnError) {
  const Setting s = settling_triplet();
  const stepping::RunState state = stepping::initial_state(s.problem, s.position);
  const stepping::StepContext context(s.problem, state);
  std::vector<double> gap(context.gaps(s.position).size(), 0.01), difference(gap.size(), 0.0);
  ASSERT_EQ(gap.size(), 3u);
  difference[0] = 1e-3;  // um
  EXPECT_NEAR(context.gap_error(gap, difference), 0.1 / std::sqrt(3.0), 1e-12);
  difference[1] = -5;
  EXPECT_NEAR(context.gap_error(gap, difference), std::sqrt((0.01 + 0.09) / 3), 1e-12);
}

// The controlled step's error, measured against a far tighter run, is of the order of what was asked for.
TEST(Integrators, ToleranceBoundsTheError) {
  for (Integrator integrator : {Integrator::NewtonImplicit, Integrator::Extrapolated, Integrator::BackwardDifferentiation, Integrator::ConvexSplitting}) {
    Vec3Array end[2];
    for (int k = 0; k < 2; ++k) {
      Setting s = settling_triplet();
      s.problem.stepping.integrator = integrator;
      s.problem.stepping.tolerance = k == 0 ? 1e-2 : 1e-6;
      stepping::RunState state = stepping::initial_state(s.problem, s.position);
      stepping::Stepper stepper(s.problem, state);
      while (state.time < 0.4) stepper.advance(state, 0.4 - state.time);
      end[k] = state.position;
    }
    // 1e-2 of gap + Debye length (20 nm and more) a step, first-order errors adding up over some tens of steps.
    EXPECT_LT(distance(end[0], end[1]), 0.3 * 0.02);
    EXPECT_GT(distance(end[0], end[1]), 0);
  }
}

// Uncharged spheres that fall together, in steps ten times as long as a pair takes to do so: whatever the length, the energy of van der Waals and Born
// forces never rises from step to step (that is what the splitting is for), nothing overlaps, and in the end there are bonds.
TEST(Integrators, ConvexSplittingNeverGainsEnergy) {
  Setting s = uncharged();
  s.problem.stepping.tolerance = 1e-4;
  s.problem.stepping.solver_tolerance = 1e-6;
  for (int k = 0; k < 27; ++k) {
    const auto u = random_uniforms({5, Stream::BrownianForce}, 0, static_cast<std::uint64_t>(k));
    const Vec3 jitter(u[0], u[1], u[2]);
    test::add_particle(s.problem, s.position, 0.2 + 0.04 * (k % 3), Vec3(50 + 0.6 * (k % 3), 50 + 0.6 * (k / 3 % 3), 50 + 0.6 * (k / 9)) + 0.05 * jitter);
  }
  const Liquid liquid = liquid_at(s.problem.interactions.liquid, s.problem.interactions.liquid.temperature);
  const assembly::InteractionEvaluator pair(s.problem.interactions, liquid);
  double smallest = 0;
  const auto energy = [&](const Vec3Array& x) {
    double sum = 0;
    smallest = 1;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double a = s.problem.particles.radius[i], b = s.problem.particles.radius[j], gap = (x[i] - x[j]).norm() - a - b;
        smallest = std::min(smallest, gap);
        sum += pair.total({assembly::Partner::Sphere, a, b, 0, 0}, gap).energy;
      }
    return sum;
  };
  for (const double step : {0.5, 5.0}) {
    s.problem.stepping.time_step = step;
    stepping::RunState state = stepping::initial_state(s.problem, s.position);
    stepping::Stepper stepper(s.problem, state);
    double before = energy(state.position);
    const double first = before;
    for (int k = 0; k < 12; ++k) {
      const double taken = stepper.advance(state, step).step;
      EXPECT_GE(taken, 0.5 * step) << "step " << k;
      const double now = energy(state.position);
      EXPECT_GT(smallest, 0) << "step " << k << " of " << step << " ms";
      EXPECT_LT(now, before) << "step " << k << " of " << step << " ms";
      before = now;
    }
    EXPECT_LT(before, first - 5 * 0.67);  // pN um: five bonds
    EXPECT_LT(smallest, 5e-4);
  }
}

// Four spheres bonded into a tetrahedron, one of them pulled at by from less than its bonds hold to far more, straight away from the others or
// to the side, where it swings round two of them while the third bond tears: steps of any length find their solution, in a few passes.
TEST(Integrators, ConvexSplittingTearsBondsInAFewPasses) {
  Setting s = uncharged();
  const double liquid_mass = add_tetrahedron(s, 3e-4);
  s.problem.particles.mass.assign(4, liquid_mass);  // none has any weight but the one that is pulled at
  int most = 0;
  double farthest = 0;
  for (const int pulled : {3, 0})
    for (const double pull : {1.0, 30.0, 100.0, 300.0, 1000.0})  // pN
      for (const double step : {0.01, 0.1, 1.0}) {
        if (pulled == 0 && pull * step > 1) continue;  // it would swing by more than its radius
        Setting here = s;
        here.problem.particles.mass[static_cast<std::size_t>(pulled)] = liquid_mass + pull / s.problem.interactions.gravity->acceleration;
        here.problem.stepping.time_step = step;
        stepping::RunState state = stepping::initial_state(here.problem, here.position);
        stepping::Stepper stepper(here.problem, state);
        for (int k = 0; k < 4; ++k) {
          const stepping::StepReport report = stepper.advance(state, step);
          EXPECT_EQ(report.rejected, 0) << pulled << " " << pull << " pN, " << step << " ms, step " << k;
          EXPECT_GT(report.smallest_gap, 0);
          most = std::max(most, report.solves);
        }
        farthest = std::max(farthest, distance(state.position, here.position));
      }
  EXPECT_LE(most, 12);
  EXPECT_GT(farthest, 1);  // um: torn off indeed
}

// A charged sphere in the hollow between three that attract it beyond their double layers, pulled out of it sideways, so that it swings round
// them by many times the range of the forces that hold it off: steps of either formula find their solution in a few passes, since axes turn with it.
TEST(Integrators, NewtonFollowsASwingingSphereInAFewPasses) {
  Setting s = uncharged();
  auto document = config::Document::from_text(
      "colloidal: {electrostatic: {debye_length: 1 nm}, van_der_waals: {hamaker_constant: 1e-20 J}, born: {collision_diameter: 0.5 nm, hamaker_constant: 1e-20 J}}");
  s.problem.interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  s.problem.interactions.surface_potential = {-25};
  const double liquid_mass = add_tetrahedron(s, 4e-4);
  for (const Integrator integrator : {Integrator::NewtonImplicit, Integrator::BackwardDifferentiation}) {
    int most = 0;
    for (const double pull : {10.0, 30.0, 100.0})  // pN
      for (const double step : {0.01, 0.03, 0.1, 0.3}) {
        if (pull * step > 3) continue;
        Setting here = s;
        here.problem.particles.mass.assign(4, liquid_mass);
        here.problem.particles.mass[0] += pull / s.problem.interactions.gravity->acceleration;
        here.problem.stepping.integrator = integrator;
        here.problem.stepping.time_step = step;
        stepping::RunState state = stepping::initial_state(here.problem, here.position);
        stepping::Stepper stepper(here.problem, state);
        for (int k = 0; k < 20; ++k) {
          const stepping::StepReport report = stepper.advance(state, step);
          EXPECT_EQ(report.rejected, 0) << pull << " pN, " << step << " ms, step " << k;
          EXPECT_GT(report.smallest_gap, 0);
          most = std::max(most, report.solves);
        }
        EXPECT_GT(distance(state.position, here.position), 0.1);  // um
      }
    EXPECT_LE(most, 20);
  }
}
