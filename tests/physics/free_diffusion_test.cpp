// Brownian motion of a sphere that meets no other: in the open, and pressed onto the substrate.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "resistance/boundary_resistance.h"
#include "support/one_layer.h"

using namespace pigment;

namespace {

constexpr double pi = 3.14159265358979323846;

stepping::Problem thermal_problem() {
  stepping::Problem problem = test::empty_problem();
  problem.stepping = {};
  problem.interactions.brownian.emplace();
  problem.interactions.brownian->model = forces::BrownianParameters::Model::FluctuationDissipation;
  return problem;
}

}  // namespace

// <dx^2> = 2 kT t/(6 pi mu a) and <dphi^2> = 2 kT t/(8 pi mu a^3), every component, two sizes. Displacements of a lone sphere are
// Gaussian and independent: the mean square of n has a relative standard error of sqrt(2/n); 4 of them, 6e-5 each.
TEST(FreeDiffusion, OfTranslationAndRotationIsStokesEinstein) {
  stepping::Problem problem = thermal_problem();
  problem.cell = {400, 400, 400};
  Vec3Array position;
  constexpr int each = 100;
  for (double a : {0.1, 1.0})
    for (int k = 0; k < each; ++k) test::add_particle(problem, position, a, Vec3(20 + 40 * (k % 10), 20 + 40 * (k / 10), a < 0.5 ? 100 : 300));
  problem.stepping.time_step = 0.1;
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper stepper(problem, state);
  const Liquid liquid = liquid_at(problem.interactions.liquid, 298.15);
  constexpr int blocks = 20, steps = 3;  // of 0.1 ms
  double square[2][6] = {};
  for (int b = 0; b < blocks; ++b) {
    const Vec3Array before = state.position;
    Vec3Array turned(position.size(), Vec3::Zero());
    for (int s = 0; s < steps; ++s) {
      stepper.advance(state, 0.1);
      for (std::size_t k = 0; k < turned.size(); ++k) turned[k] += 0.1 * state.angular_velocity[k];
    }
    for (std::size_t k = 0; k < turned.size(); ++k)
      for (int d = 0; d < 3; ++d) {
        square[k / each][d] += std::pow(state.position[k][d] - before[k][d], 2);
        square[k / each][3 + d] += turned[k][d] * turned[k][d];
      }
  }
  constexpr double n = blocks * each;
  for (int size : {0, 1}) {
    const double a = size == 0 ? 0.1 : 1.0, t = 0.1 * steps, kT = liquid.thermal_energy();
    for (int d = 0; d < 6; ++d) {
      const double expected = 2 * kT * t / (d < 3 ? 6 * pi * liquid.viscosity * a : 8 * pi * liquid.viscosity * a * a * a);
      EXPECT_NEAR(square[size][d] / n, expected, 4 * std::sqrt(2 / n) * expected) << "radius " << a << ", component " << d;
    }
  }
}

// A sphere that the liquid carries onto the substrate, against the double layer: p(h) ~ exp(-(U(h) + F h)/kT). Without the drift
// p ~ R(h) exp(...); of k_brown p ~ R^2 exp(integral of F R/(kT R0)).
TEST(SphereAboveSubstrate, HasBoltzmannsDistributionAndWrongSchemesHaveTheirs) {
  constexpr double a = 0.25, q = 0.095;  // 95 um/s: 0.4 pN, so that it stays within the reach of lubrication
  stepping::Problem problem = thermal_problem();
  problem.interactions.substrate.emplace();
  problem.dewatering = test::steady_absorption(q);
  auto document = config::Document::from_text("colloidal: {electrostatic: {debye_length: 5 nm}}");
  problem.interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  constexpr int count = 400, side = 20;
  problem.cell = {side * 4.0, side * 4.0, 10};
  Vec3Array position;
  for (int k = 0; k < count; ++k) test::add_particle(problem, position, a, Vec3(4.0 * (k % side), 4.0 * (k / side), a + 0.03));
  problem.stepping.time_step = 0.02;
  const Liquid liquid = liquid_at(problem.interactions.liquid, 298.15);
  const double kT = liquid.thermal_energy(), drag = liquid.viscosity * resistance::stokes_drag(a), press = drag * q;

  const auto law = problem.interactions.colloidal[0].law->prepare(liquid);
  const auto term = [&](double h) { return law->switched({h, a, std::numeric_limits<double>::infinity(), -25, -25}); };
  const auto wall = [&](double h) { return drag + liquid.viscosity * resistance::wall_increment(a, h).perpendicular; };
  struct Moments {
    double mean, deviation;
  };
  // power of R: 0 exact, 1 without drift, 2 k_brown.
  const auto moments = [&](int power) {
    double w0 = 0, w1 = 0, w2 = 0, exponent = 0, top = -1e300;
    constexpr int n = 20000;
    std::vector<double> value(n);
    const double dh = 0.2 / n;
    for (int k = 0; k < n; ++k) {
      const double h = dh * (k + 0.5), force = term(h).force - press;
      exponent += dh * force / kT * (power == 2 ? wall(h) / drag : 1);
      top = std::max(top, value[k] = exponent + power * std::log(wall(h)));
    }
    for (int k = 0; k < n; ++k) {
      const double h = dh * (k + 0.5), w = std::exp(value[k] - top);
      w0 += w;
      w1 += w * h;
      w2 += w * h * h;
    }
    return Moments{w1 / w0, std::sqrt(w2 / w0 - w1 * w1 / (w0 * w0))};
  };
  const Moments expected[3] = {moments(0), moments(1), moments(2)};

  for (int scheme : {0, 1, 2}) {
    problem.interactions.brownian->drift = scheme != 1;
    problem.interactions.brownian->model = scheme == 2 ? forces::BrownianParameters::Model::KBrown
                                                       : forces::BrownianParameters::Model::FluctuationDissipation;
    stepping::RunState state = stepping::initial_state(problem, position);
    stepping::Stepper stepper(problem, state);
    std::vector<double> mean(count, 0.0);
    double square = 0;
    int samples = 0;
    for (double next = 2; next < 12; next += 0.2, ++samples) {
      while (state.time < next - 1e-9) stepper.advance(state, next - state.time);
      for (int k = 0; k < count; ++k) {
        const double h = state.position[k].z() - a;
        mean[k] += h;
        square += h * h;
      }
    }
    double all = 0, spread = 0;
    for (double& m : mean) all += (m /= samples) / count;
    for (double m : mean) spread += (m - all) * (m - all);
    const double error = std::sqrt(spread / (count * (count - 1.0))), deviation = std::sqrt(square / (count * samples) - all * all);
    // 1 % (k_brown, whose step is implicit, 6 %) is the step's error at 0.02 ms; 4 standard errors are chance, 6e-5.
    const double bias = scheme == 2 ? 0.06 : 0.01;
    EXPECT_NEAR(all, expected[scheme].mean, 4 * error + bias * all) << "scheme " << scheme;
    EXPECT_NEAR(deviation, expected[scheme].deviation, 4 * error + 2 * bias * deviation) << "scheme " << scheme;
    for (int other : {(scheme + 1) % 3, (scheme + 2) % 3})
      EXPECT_GT(std::abs(all - expected[other].mean), 4 * error + 0.01 * all) << scheme << " taken for " << other;
  }
}
