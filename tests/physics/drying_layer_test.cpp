// A small drying layer: what is conserved, what is imposed, and what must not depend on threads, steps or interruptions.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstring>

#include "model/layer_measures.h"
#include "packing/pack_layer.h"
#include "stepping/consolidate.h"
#include "support/one_layer.h"
#include "support/small_layer.h"

using namespace pigment;

namespace {

struct SmallLayer {
  stepping::Problem problem;
  Vec3Array position;
};

SmallLayer small_layer(bool brownian) {
  SmallLayer small;
  SizeLaw law;
  law.mean = 1.5;
  law.standard_deviation = 10;
  law.median = 0.2225;
  law.geometric_standard_deviation = 7.05;
  law.min = 0.25;
  law.max = 1.0;
  const packing::Packing packed = packing::pack_layer(test::lognormal_recipe(4, 0.65, law));
  stepping::Problem& problem = small.problem = test::charged_layer(packed);
  small.position = packed.layer.position;
  if (brownian) problem.interactions.brownian.emplace();
  problem.dewatering.time = {0, 10, 50};
  problem.dewatering.absorption_flux = {0.02, 0.01, 0.01};
  problem.dewatering.evaporation_flux = {0.01, 0.02, 0.01};
  return small;
}

void hinder(SmallLayer& small) {
  small.problem.interactions.hydrodynamics.drag = resistance::HydrodynamicsParameters::Drag::Hindered;
}

void limit(SmallLayer& small, double pressure) {
  small.problem.interactions.free_surface->model = forces::FreeSurfaceParameters::Model::PressureLimited;
  small.problem.interactions.free_surface->max_pressure = pressure;
}

// Bends the substrate, and lifts all that stands on it above the crests.
void roughen(SmallLayer& small, const Roughness& roughness) {
  const auto field = std::make_shared<const HeightField>(height_map(roughness), small.problem.cell);
  small.problem.interactions.height_field = field;
  small.problem.cell.height += field->crest();
  for (Vec3& p : small.position) p.z() += field->crest();
}

struct Recorded {
  stepping::RunState state;
  std::vector<std::vector<double>> observables;
  std::string outcome;
};

// Runs to `until` ms; stops after `interrupt_after` steps each time and goes on from the state's arrays, if asked to.
Recorded run(const SmallLayer& small, int interrupt_after = 0, double until = 30) {
  Recorded recorded;
  recorded.state = stepping::initial_state(small.problem, small.position);
  int steps = 0;
  stepping::RunCallbacks callbacks;
  callbacks.on_frame = [&](const stepping::RunState&, double, const std::vector<double>& o) { recorded.observables.push_back(o); };
  callbacks.on_step = [&](const stepping::RunState&) { return interrupt_after > 0 && ++steps % interrupt_after == 0; };
  do {
    recorded.outcome = stepping::consolidate(small.problem, {5, until}, recorded.state, callbacks);
    if (recorded.outcome == "interrupted") recorded.state = stepping::RunState::from(recorded.state.arrays(), recorded.state.integers());
  } while (recorded.outcome == "interrupted");
  return recorded;
}

bool same_bytes(const Vec3Array& a, const Vec3Array& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

}  // namespace

TEST(DryingLayer, ThicknessIsWhatTheDewateringLeaves) {
  const SmallLayer small = small_layer(false);
  const Recorded r = run(small);
  EXPECT_EQ(r.outcome, "until");
  ASSERT_EQ(r.observables.size(), 7u);
  for (std::size_t k = 0; k < r.observables.size(); ++k) {
    const double t = 5.0 * static_cast<double>(k);
    // Integral of the piecewise linear fluxes, by hand: q + e is 0.03 throughout, then falls linearly to 0.02 at 50.
    const double lost = t <= 10 ? 0.03 * t : 0.3 + 0.03 * (t - 10) - 0.5 * (0.01 / 40) * (t - 10) * (t - 10);
    EXPECT_NEAR(r.observables[k][0], small.problem.cell.height - lost, 1e-12 * small.problem.cell.height);
  }
}

TEST(DryingLayer, ParticlesStayBetweenSubstrateAndSurfaceAndNeverOverlap) {
  const SmallLayer small = small_layer(false);
  const Recorded r = run(small);
  const auto& radius = small.problem.particles.radius;
  const double surface = r.observables.back()[0];
  for (std::size_t k = 0; k < radius.size(); ++k) {
    EXPECT_GT(r.state.position[k].z(), radius[k]);
    // held at the roughness, 2 nm below the surface; a step's catch may err by a thousandth of that
    EXPECT_LT(r.state.position[k].z() + radius[k], surface - 0.002 + 2e-6);
  }
  EXPECT_TRUE(neighbours::find_pairs(small.problem.cell, r.state.position, radius, {0, 0, 0}).empty());
  EXPECT_GT(r.observables.back()[11], 0);  // the surface holds some
}

TEST(DryingLayer, SameBytesAtAnyThreadCountAndHoweverOftenInterrupted) {
  for (const char* scene : {"smooth", "brownian", "hindered", "pressure_limited", "thermal", "thermal_limited", "rough"}) {
    const bool thermal = std::string(scene).starts_with("thermal");
    SmallLayer small = small_layer(thermal || scene == std::string("brownian"));
    if (thermal) small.problem.interactions.brownian->model = forces::BrownianParameters::Model::FluctuationDissipation;
    if (scene == std::string("hindered")) hinder(small);
    if (scene == std::string("rough")) roughen(small, {0.5, 1.25, {}});
    if (std::string(scene).ends_with("limited")) limit(small, 1.5);
    // The limited one lags from the start: there the surface presses with 3 Pa.
    const double until = thermal ? 2 : scene == std::string("rough") ? 5 : small.problem.interactions.pressure_limited() ? 5 : 30;
    omp_set_num_threads(2);
    const Recorded whole = run(small, 0, until);
    omp_set_num_threads(1);
    const Recorded single = run(small, 0, until), broken = run(small, 3, until);
    omp_set_num_threads(2);
    EXPECT_TRUE(same_bytes(whole.state.position, single.state.position));
    EXPECT_TRUE(same_bytes(whole.state.position, broken.state.position));
    EXPECT_EQ(whole.observables, single.observables);
    EXPECT_EQ(whole.observables, broken.observables);
  }
}

// The network of a layer carries the surface's load to the substrate: what the surface presses with must come out below, but
// for the drag of the liquid that flows through, which is a tenth of it here once the layer is dense.
TEST(DryingLayer, ForcesBalance) {
  SmallLayer small = small_layer(false);
  small.problem.dewatering.absorption_flux = {0, 0, 0};  // evaporation alone: no drag but that of particles through liquid
  small.problem.stepping.integrator = stepping::SteppingParameters::Integrator::NewtonImplicit;  // its velocities are one solve's
  small.problem.stepping.tolerance = 1e-4;
  small.problem.stepping.solver_tolerance = 1e-8;
  stepping::RunState state = stepping::initial_state(small.problem, small.position);
  stepping::Stepper stepper(small.problem, state);
  stepping::StepReport report;
  while (state.time < 20) report = stepper.advance(state, 20 - state.time);
  // Exact: surface pressure = substrate pressure + sum of Stokes drag over the area (the liquid rests).
  const double mu = liquid_at({}, 298.15).viscosity;
  double drag = 0;
  for (std::size_t k = 0; k < state.velocity.size(); ++k)
    drag += 6 * M_PI * mu * small.problem.particles.radius[k] * -state.velocity[k].z();
  drag /= small.problem.cell.area();
  EXPECT_NEAR(report.pressures.surface, report.pressures.substrate + drag, 1e-4 * report.pressures.surface);
  EXPECT_GT(report.pressures.surface, 0);
  // The extrapolated step reports pressures of the same kind, drag among them.
  small.problem.stepping.integrator = stepping::SteppingParameters::Integrator::Extrapolated;
  stepping::Stepper extrapolated(small.problem, state);
  report = extrapolated.advance(state, 1);
  EXPECT_NEAR(report.pressures.surface, report.pressures.substrate + report.pressures.liquid, 1e-4 * report.pressures.surface);
}

// Surface, substrate and the liquid that flows through carry what there is to carry: nothing. Absorption this time, and the
// drag that grows with the solids. To the solver's tolerance.
TEST(DryingLayer, ForcesBalanceWithTheLiquidsPressure) {
  for (bool hindered : {false, true}) {
    SmallLayer small = small_layer(false);
    if (hindered) hinder(small);
    small.problem.stepping.tolerance = 1e-3;
    small.problem.stepping.solver_tolerance = 1e-9;
    stepping::RunState state = stepping::initial_state(small.problem, small.position);
    stepping::Stepper stepper(small.problem, state);
    stepping::StepReport report;
    while (state.time < 10) report = stepper.advance(state, 10 - state.time);
    const assembly::BoundaryPressures& p = report.pressures;
    EXPECT_NEAR(p.surface, p.substrate + p.liquid, 1e-6 * (std::abs(p.surface) + std::abs(p.liquid)));
    EXPECT_GT(std::abs(p.liquid), 1e-3 * p.surface);
  }
}

// Absorbed through solids that the substrate stops, the liquid sucks; where the surface presses the solids down through it, it
// pushes.
TEST(DryingLayer, RecordsTheLiquidsPressureWithHinderedDrag) {
  SmallLayer small = small_layer(false);
  hinder(small);
  small.problem.dewatering.evaporation_flux = {0, 0, 0};
  const auto names = stepping::observable_names(small.problem.interactions);
  EXPECT_STREQ(names.back().name, "liquid_pressure");
  const Recorded r = run(small);
  for (const auto& values : r.observables) EXPECT_EQ(values.size(), names.size());
  EXPECT_LT(r.observables.back().back(), 0);
  small.problem.dewatering.evaporation_flux = small.problem.dewatering.absorption_flux;
  small.problem.dewatering.absorption_flux = {0, 0, 0};
  EXPECT_GT(run(small).observables.back().back(), 0);
  EXPECT_EQ(stepping::observable_names(small_layer(false).problem.interactions).size(), names.size() - 1);
}

// The surface follows the dewatering until it would press harder than the entry pressure; then it lags, pressing just so, while
// the liquid goes on leaving: the solids' share follows the liquid that is left.
TEST(DryingLayer, PressureLimitedSurfaceLagsAtTheEntryPressure) {
  SmallLayer small = small_layer(false);
  const double entry = 1.5;  // Pa; the spring presses with more at the very beginning, and from 16 ms on
  limit(small, entry);
  stepping::RunState state = stepping::initial_state(small.problem, small.position);
  stepping::Stepper stepper(small.problem, state);
  int following = 0, lagging = 0;
  double impulse = 0, duration = 0;
  while (state.time < 20) {
    const stepping::StepReport report = stepper.advance(state, 20 - state.time);
    const double drained = stepper.height_at(state.time);
    EXPECT_GE(report.height, drained);
    EXPECT_EQ(report.height, state.surface_height);
    if (report.height > drained) {
      ++lagging;
      impulse += report.step * report.pressures.surface;
      duration += report.step;
    } else {
      ++following;
      EXPECT_LE(report.pressures.surface, 1.01 * entry);  // 0.3 % in each of the three solves that a step extrapolates from
    }
  }
  EXPECT_GT(following, 5);
  EXPECT_GT(lagging, 5);
  // A few particles carry all of this small layer's load, and its pressure jumps where one is caught: held on the lower side.
  EXPECT_LT(impulse / duration, 1.01 * entry);
  EXPECT_GT(impulse / duration, 0.9 * entry);
  EXPECT_GT(state.surface_height, stepper.height_at(20) + 0.001);
  const Recorded r = run(small, 0, 20);
  double solids = 0;
  for (double m : small.problem.particles.mass) solids += m;
  const double liquid = small.problem.cell.area() * stepper.height_at(20) - solids_volume(small.problem.particles.radius);
  EXPECT_NEAR(r.observables.back()[3], solids / (solids + 1e-3 * liquid), 1e-9);
  EXPECT_NEAR(r.observables.back()[0], state.surface_height, 0.05);  // other steps, the same course
}

// With thermal noise, whose steps may be taken in parts, the limited surface starts every step where the last one left it, never
// stands below what is drained, and where it keeps up presses with no more than the entry pressure.
TEST(DryingLayer, PressureLimitedSurfaceBearsThermalNoise) {
  SmallLayer small = small_layer(true);
  small.problem.interactions.brownian->model = forces::BrownianParameters::Model::FluctuationDissipation;
  const double entry = 1.5;
  limit(small, entry);
  stepping::RunState state = stepping::initial_state(small.problem, small.position);
  stepping::Stepper stepper(small.problem, state);
  int lagging = 0;
  while (state.time < 1.5) {
    const stepping::StepReport report = stepper.advance(state, 1.5 - state.time);
    EXPECT_GE(report.height, stepper.height_at(state.time));
    EXPECT_EQ(report.height, state.surface_height);
    if (report.height > stepper.height_at(state.time)) ++lagging;
    else EXPECT_LE(report.pressures.surface, 1.01 * entry);
    for (std::size_t k = 0; k < state.position.size(); ++k) ASSERT_TRUE(std::isfinite(state.position[k].z()));
  }
  EXPECT_GT(lagging, 0);
}
