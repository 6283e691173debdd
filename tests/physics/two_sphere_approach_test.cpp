// Two spheres settling head-on onto each other, pressed by a constant force: the gap against an accurate solution of the
// ordinary differential equation made from the exact resistance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/one_layer.h"
#include "support/table.h"

using namespace pigment;
using std::numbers::pi;

// Only the upper sphere is heavier than the liquid. Its load F moves the pair as a whole and presses it together: with equal
// drags half of F is internal, and d gap/dt = -(F/2)/(K_iso + K(h)), K_iso = 3 pi mu a the isolated drags in series and K the
// exact relative squeeze resistance of the table.
TEST(TwoSphereApproach, FollowsTheExactLubricationSolution) {
  const auto table = test::read_table("relative_K_basis.csv");
  // Exact Kn at lambda = 1 in units of 6 pi R against h/b.
  std::vector<double> gap_over_a, kn;
  for (std::size_t k = 0; k < table.at("lambda").size(); ++k)
    if (table.at("lambda")[k] == 1) {
      gap_over_a.push_back(table.at("gap_over_b")[k]);
      kn.push_back(table.at("Kn/(6piR)")[k]);
    }
  const auto exact_kn = [&](double y) {
    // 1/x dominates: interpolate Kn x linearly in ln y between the table's rows (8 a decade; error 1e-4).
    const auto it = std::upper_bound(gap_over_a.begin(), gap_over_a.end(), y);
    const std::size_t k = std::clamp<std::size_t>(static_cast<std::size_t>(it - gap_over_a.begin()), 1, gap_over_a.size() - 1);
    const double w = std::log(y / gap_over_a[k - 1]) / std::log(gap_over_a[k] / gap_over_a[k - 1]);
    const double a = kn[k - 1] * gap_over_a[k - 1], b = kn[k] * gap_over_a[k];
    return (a + w * (b - a)) / y;
  };
  stepping::Problem problem = test::empty_problem();
  problem.interactions.gravity = forces::GravityParameters{2000};  // strong, for a short run
  Vec3Array position;
  const double a = 0.5, h0 = 0.1 * a;
  test::add_particle(problem, position, a, Vec3(50, 50, 50));
  test::add_particle(problem, position, a, Vec3(50, 50, 50 + 2 * a + h0));
  problem.particles.mass[0] = 1e-3 * Particles::sphere_volume(a);
  const double mu = liquid_at({}, 298.15).viscosity;
  const double load = 0.5 * (problem.particles.mass[1] - problem.particles.mass[0]) * 2000;

  problem.stepping.tolerance = 1e-7;  // first order: the gap's error goes with the square root
  stepping::RunState state = stepping::initial_state(problem, position);
  stepping::Stepper stepper(problem, state);
  double exact = h0, exact_time = 0;
  for (double target : {0.05 * a, 0.01 * a, 1e-3 * a, 1e-4 * a}) {
    double gap = h0;
    while (gap > target) {
      stepper.advance(state, 1e3);
      gap = (state.position[1] - state.position[0]).norm() - 2 * a;
    }
    // Classical Runge-Kutta in ln h: d(ln h)/dt = -load/(h (K_iso + K)), steps far below the time scale.
    const auto rate = [&](double l) {
      const double h = std::exp(l), R = a / 2;
      return -load / (h * mu * (3 * pi * a + 6 * pi * R * exact_kn(h / a)));
    };
    double l = std::log(exact);
    const int steps = 20000;
    const double dt = (state.time - exact_time) / steps;
    for (int s = 0; s < steps; ++s) {
      const double k1 = rate(l), k2 = rate(l + dt / 2 * k1), k3 = rate(l + dt / 2 * k2), k4 = rate(l + dt * k3);
      l += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    exact = std::exp(l);
    exact_time = state.time;
    EXPECT_NEAR(gap, exact, 0.005 * exact) << "gap/a " << gap / a << " at t " << state.time;
  }
}
