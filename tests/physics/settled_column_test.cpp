// Repelling spheres that a uniform flow presses onto the substrate, against the equation of state of hard spheres: a column from
// half full to empty. Isolated drag, since the equilibrium does not know the resistance (tests/physics/boltzmann_separation_test.cpp
// has that it does not); the study of Brownian motion has the same with lubrication.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/one_layer.h"

using namespace pigment;

namespace {

constexpr double pi = 3.14159265358979323846;

// Pressure over n kT [carnahan1969].
double compressibility(double phi) { return (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3); }

}  // namespace

// What lies above a height presses with its drag, f each: Pi(z) = f N(z)/A. So the solids at z follow from N(z) by the equation of state, with nothing fitted.
TEST(SettledColumn, FollowsCarnahanAndStarling) {
  constexpr double a = 0.25, q = 1.5e-3, width = 1.8, debye = 0.005, potential = 25;
  stepping::Problem problem = test::empty_problem();
  problem.stepping = {};
  problem.stepping.time_step = 0.2;
  problem.interactions.hydrodynamics.model = resistance::HydrodynamicsParameters::Model::Drag;
  problem.interactions.brownian.emplace();
  problem.interactions.brownian->model = forces::BrownianParameters::Model::FluctuationDissipation;
  problem.interactions.substrate.emplace();
  problem.interactions.liquid.viscosity = 0.89;
  problem.interactions.liquid.relative_permittivity = 80;
  auto document = config::Document::from_text("colloidal: {electrostatic: {debye_length: 5 nm}}");
  problem.interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  problem.dewatering = test::steady_absorption(q);
  problem.cell = {width, width, 20};
  const double kT = 1.380649e-5 * 298.15, decay = kT / (6 * pi * 0.89 * a * q);

  // Diameter of hard spheres that stands for the repulsion [barker1967].
  const double contact = 2 * pi * 80 * 8.8541878e-6 * a * potential * potential / kT;
  double diameter = 2 * a;
  for (double h = 0.5e-5; h < 0.4; h += 1e-5) diameter += 1e-5 * (1 - std::exp(-contact * std::log1p(std::exp(-h / debye))));
  const double volume = pi / 6 * std::pow(diameter, 3);

  // Layers of nine over each other's holes, spaced so that the column begins near its equilibrium: down from a sphere's worth of pressure.
  Vec3Array position;
  constexpr int layers = 12, across = 3;
  std::vector<double> spacing;
  for (int k = 0; k < layers; ++k) {  // k-th from the top
    const double pressure = (k + 0.5) * across * across * volume / (width * width) / decay;
    double low = 0, high = 0.6;
    for (int b = 0; b < 60; ++b) (0.5 * (low + high) * compressibility(0.5 * (low + high)) < pressure ? low : high) = 0.5 * (low + high);
    spacing.push_back(across * across * volume / (width * width) / low);
  }
  double z = 0.35;
  for (int k = layers - 1; k >= 0; z += spacing[k--])
    for (int s = 0; s < across * across; ++s)
      test::add_particle(problem, position, a, Vec3(0.6 * (s % across) + 0.3 * (k % 2), 0.6 * (s / across) + 0.3 * (k % 2), z));

  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper stepper(problem, state);
  // Slices of 1 um from 1.5 um on: the plane orders the spheres below.
  constexpr int slices = 6, blocks = 8;
  constexpr double from = 1.5, settle = 600, block = 150;  // ms; in a block a lone sphere diffuses over its diameter
  double count[blocks][slices] = {}, above[blocks][slices] = {};
  for (int b = -1; b < blocks; ++b) {
    const double until = settle + (b + 1) * block;
    int samples = 0;
    for (double next = state.time + 2; state.time < until - 1e-6; next += 2) {
      while (state.time < next - 1e-6) stepper.advance(state, next - state.time);
      if (b < 0) continue;
      ++samples;
      for (const Vec3& p : state.position)
        for (int s = 0; s < slices; ++s) {
          const double low = from + s;
          if (p.z() >= low && p.z() < low + 1) count[b][s] += 1;
          // The mean over the slice of the number above a height.
          above[b][s] += std::clamp(p.z() - low, 0.0, 1.0);
        }
    }
    if (b >= 0)
      for (int s = 0; s < slices; ++s) {
        count[b][s] /= samples;
        above[b][s] /= samples;
      }
  }
  for (int s = 0; s < slices; ++s) {
    double phi = 0, pressure = 0, square = 0;
    for (int b = 0; b < blocks; ++b) {
      phi += count[b][s] * volume / (width * width) / blocks;
      pressure += above[b][s] * volume / (width * width) / decay / blocks;
    }
    double low = 0, high = 0.6;
    for (int b = 0; b < 60; ++b) (0.5 * (low + high) * compressibility(0.5 * (low + high)) < pressure ? low : high) = 0.5 * (low + high);
    for (int b = 0; b < blocks; ++b) square += std::pow(count[b][s] * volume / (width * width) - phi, 2);
    const double error = std::sqrt(square / (blocks * (blocks - 1.0)));
    // Four standard errors of block means: 0.5 % false alarms a slice by Student's law of seven degrees, 3 % for the six; the seed
    // is fixed. 0.015 is the step's error, under which spheres come nearer than they should: a step a tenth as long leaves a third of it.
    // Noise colder by a quarter, which raises solids by 0.03, is out of it.
    EXPECT_NEAR(phi, low, 4 * error + 0.015) << "slice " << s << ", error " << error;
  }
}

// A step in which spheres diffuse over their own size: pairs that noise brings together from beyond the reach of lubrication are known
// before it. Unseen, they came to overlap, and the noise of their contact threw them a thousand diameters away.
class CoarseStep : public testing::TestWithParam<std::uint64_t> {};

TEST_P(CoarseStep, NoPairPassesUnseen) {
  constexpr double a = 0.1, spacing = 0.4;
  constexpr int side = 4;
  stepping::Problem problem = test::empty_problem();
  problem.stepping = {};
  problem.stepping.time_step = 0.4;
  problem.seed = GetParam();
  problem.interactions.liquid.temperature = 353.15;
  problem.interactions.brownian.emplace();
  problem.interactions.brownian->model = forces::BrownianParameters::Model::FluctuationDissipation;
  auto document = config::Document::from_text("colloidal: {electrostatic: {debye_length: 5 nm}}");
  problem.interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  problem.cell = {side * spacing, side * spacing, 100};
  Vec3Array position;
  for (int k = 0; k < side * side * side; ++k)
    test::add_particle(problem, position, a, spacing * Vec3(k % side, k / side % side, 20 + k / (side * side)));
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper stepper(problem, state);
  for (int s = 0; s < 150; ++s) {
    const Vec3Array before = state.position;
    stepper.advance(state, 0.4);
    double smallest = spacing;
    // The noise of a contact that is made or left in so coarse a step is not Gaussian. Of 235 seeds (2.3 million displacements) 80 displacements
    // were beyond 7 radii, 29 beyond 10, 15 beyond 14, 2 beyond 20 and none beyond 40: a tail that falls as the fourth power of
    // the size leaves 50 radii to chance in 0.1 % of six runs. Pairs unseen threw each other two thousand.
    for (std::size_t k = 0; k < before.size(); ++k)
      ASSERT_LT((state.position[k] - before[k]).cwiseAbs().maxCoeff(), 50 * a) << "step " << s << ", particle " << k;
    for (std::size_t i = 0; i < before.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        smallest = std::min(smallest, problem.cell.minimum_image(state.position[i] - state.position[j]).norm());
    ASSERT_GT(smallest, 2 * a) << "step " << s;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, CoarseStep, testing::Range<std::uint64_t>(1, 7));
