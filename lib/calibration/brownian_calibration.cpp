#include "calibration/brownian_calibration.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pigment::calibration {

namespace {

// A problem with one sphere per simulation, far apart, and nothing but drag: they do not interact, so that all simulations of
// a temperature advance in one system, each with random numbers of its own (its id).
stepping::Problem lone_spheres(const LiquidParameters& liquid, double temperature, const CalibrationSettings& settings) {
  stepping::Problem problem;
  const int n = settings.simulations;
  problem.interactions.hydrodynamics.model = resistance::HydrodynamicsParameters::Model::Drag;
  problem.interactions.brownian.emplace();
  problem.interactions.liquid = liquid;
  problem.interactions.liquid.temperature = temperature;
  problem.interactions.surface_potential = {0};
  problem.stepping.time_step = settings.time_step;
  problem.stepping.solver_tolerance = 1e-12;
  problem.seed = settings.seed;
  problem.cell = {1e6, 1e6, 1e6};
  problem.particles.radius.assign(n, settings.radius);
  problem.particles.mass.assign(n, 0.0);
  problem.particles.species.assign(n, 0);
  for (int k = 0; k < n; ++k) problem.particles.id.push_back(k);
  // One unit of K at this step, whatever the temperature.
  problem.calibration = BrownianCalibration{{temperature}, {settings.time_step}, {1.0}, {0.0}, {1.0}};
  return problem;
}

}  // namespace

BrownianCalibration calibrate(const LiquidParameters& parameters, const CalibrationSettings& settings,
                              const std::function<void(double)>& on_progress) {
  BrownianCalibration result;
  const double dt = settings.time_step;
  for (std::size_t t = 0; t < settings.temperatures.size(); ++t) {
    CalibrationSettings own = settings;
    own.seed = settings.seed + 1000003 * t;  // other temperatures, other displacements
    const Liquid liquid = liquid_at(parameters, settings.temperatures[t]);
    const stepping::Problem problem = lone_spheres(parameters, settings.temperatures[t], own);
    Vec3Array position(settings.simulations);
    for (int k = 0; k < settings.simulations; ++k) position[k] = Vec3(1000.0 * k, 0, 5e5);
    stepping::RunState state = stepping::initial_state(problem, position);
    stepping::Stepper stepper(problem, state);
    std::vector<double> square(settings.simulations, 0.0);
    for (int s = 0; s < settings.displacements; ++s) {
      const Vec3Array before = state.position;
      stepper.advance(state, dt);
      for (int k = 0; k < settings.simulations; ++k) {
        const double dx = state.position[k].x() - before[k].x();
        square[k] += dx * dx;
      }
      if (on_progress && s % 1000 == 0)
        on_progress((static_cast<double>(t) + static_cast<double>(s) / settings.displacements) / static_cast<double>(settings.temperatures.size()));
    }
    // (24): D = kT/(6 pi mu a), and (23) a component: <dx^2> = 2 D dt.
    const double diffusivity = liquid.thermal_energy() / (6 * std::numbers::pi * liquid.viscosity * settings.radius);
    double sum = 0, sum_of_squares = 0;
    for (double q : square) {
      const double k = std::sqrt(2 * diffusivity * dt / (q / settings.displacements));
      sum += k;
      sum_of_squares += k * k;
    }
    const double n = settings.simulations, mean = sum / n;
    result.temperature.push_back(settings.temperatures[t]);
    result.time_step.push_back(dt);
    result.value.push_back(mean);
    result.standard_deviation.push_back(std::sqrt(std::max(0.0, (sum_of_squares - n * mean * mean) / (n - 1))));
    result.closed_form.push_back(brownian_constant(liquid.viscosity, liquid.thermal_energy(), dt));
  }
  return result;
}

}  // namespace pigment::calibration
