#include "stepping/consolidate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/layer_measures.h"
#include "stepping/stationary.h"

namespace pigment::stepping {

namespace {

// What accumulates between two frames; kept in RunState::interval, so that a resumed run has it.
enum Sum { Steps, Iterations, Duration, SurfaceImpulse, SubstrateImpulse, SmallestGap, Contacts, LiquidImpulse, SumCount };

std::vector<double> empty_interval() {
  std::vector<double> interval(SumCount, 0.0);
  interval[SmallestGap] = std::numeric_limits<double>::max();
  return interval;
}

void add_step(std::vector<double>& interval, const StepReport& report) {
  interval[Steps] += 1;
  interval[Iterations] += report.iterations;
  interval[Duration] += report.step;
  interval[SurfaceImpulse] += report.step * report.pressures.surface;
  interval[SubstrateImpulse] += report.step * report.pressures.substrate;
  interval[LiquidImpulse] += report.step * report.pressures.liquid;
  interval[SmallestGap] = std::min(interval[SmallestGap], report.smallest_gap);
  interval[Contacts] = report.pressures.contacts;
}

// Non-affine part of the vertical motion since the last frame, over the surface's own: 0 is a layer that shrinks evenly.
double non_affine_rate(const RunState& state, double height) {
  const double fall = std::abs(height - state.frame_height);
  if (fall <= 0) return 0;
  std::vector<double> displacement(state.position.size());
  for (std::size_t k = 0; k < displacement.size(); ++k) displacement[k] = state.position[k].z() - state.frame_position[k].z();
  const int slices = std::clamp(static_cast<int>(state.position.size() / 50), 1, 30);
  return non_affine_motion(state.position, displacement, height, slices).rms / fall;
}

// Smallest gap of any pair; the cell's width where there is none.
double smallest_gap(const Problem& problem, const RunState& state) {
  const auto& radius = problem.particles.radius;
  double gap = std::numeric_limits<double>::max();
  double reach = 0.1 * *std::min_element(radius.begin(), radius.end());
  for (; gap == std::numeric_limits<double>::max() && reach < problem.cell.width_x; reach *= 4)
    for (const auto& [i, j] : neighbours::find_pairs(problem.cell, state.position, radius, {0, reach, 0}))
      gap = std::min(gap, problem.cell.minimum_image(state.position[j] - state.position[i]).norm() - radius[i] - radius[j]);
  return gap == std::numeric_limits<double>::max() ? problem.cell.width_x : gap;
}

// Over a substrate that is not flat; the cell's width where no particle is nearer than that.
double smallest_gap_to_substrate(const Problem& problem, const RunState& state) {
  double gap = problem.cell.width_x;
  for (double reach = 0.05; gap > reach && reach < problem.cell.width_x; reach *= 4)
    for (std::size_t k = 0; k < state.position.size(); ++k)
      gap = std::min(gap, problem.interactions.height_field->gap(state.position[k], problem.particles.radius[k], std::min(gap, reach)));
  return gap;
}

// height: of the surface; drained: what the dewatering leaves, lower where a pressure-limited surface lags.
// Pressures, step and iterations are means over the frame's interval, the smallest gap its minimum; the rest is of the instant.
std::vector<double> observe(const Problem& problem, const RunState& state, double height, double drained) {
  const auto& radius = problem.particles.radius;
  const std::vector<double>& sum = state.interval;
  const bool surface = problem.interactions.free_surface.has_value();
  const double top = surface ? height : height_below_which(1, state.position, radius);
  double solid_mass = 0;
  for (double m : problem.particles.mass) solid_mass += m;
  // Below the surface; without one, below the top of the highest particle.
  const double liquid_volume = std::max(0.0, problem.cell.area() * problem.interactions.space_below(surface ? drained : top) - solids_volume(radius));
  const bool stepped = sum[Steps] > 0;
  std::vector<double> observables = {
          problem.interactions.space_below(top),
          height_below_which(0.95, state.position, radius),
          height_below_which(0.99, state.position, radius),
          solid_mass / (solid_mass + problem.interactions.liquid.density * liquid_volume),
          mass_centre(state.position, radius, problem.particles.mass),
          stepped ? sum[SurfaceImpulse] / sum[Duration] : 0.0,
          stepped ? sum[SubstrateImpulse] / sum[Duration] : 0.0,
          surface ? protruding_fraction(height, state.position, radius) : 0.0,
          stepped ? sum[SmallestGap] : smallest_gap(problem, state),
          stepped ? sum[Duration] / sum[Steps] : 0.0,
          stepped ? sum[Iterations] / sum[Steps] : 0.0,
          sum[Contacts],
          surface ? non_affine_rate(state, height) : 0.0,
          surface && state.frame > 0 ? redistribution_ratio(state.redistribution, problem.stepping.immobile_shrinkage) : 1.0};
  if (problem.interactions.hindered()) observables.push_back(stepped ? sum[LiquidImpulse] / sum[Duration] : 0.0);
  if (problem.interactions.height_field) observables.push_back(smallest_gap_to_substrate(problem, state));
  return observables;
}

}  // namespace

std::vector<ObservableName> observable_names(const assembly::Interactions& interactions) {
  std::vector<ObservableName> names = {
      {Observable::Thickness, "thickness", Dimension::Length},
      {Observable::Z95, "z95", Dimension::Length},
      {Observable::Z99, "z99", Dimension::Length},
      {Observable::SolidsMassFraction, "solids_mass_fraction", Dimension::Number},
      {Observable::MassCentre, "mass_centre", Dimension::Length},
      {Observable::SurfacePressure, "surface_pressure", Dimension::Pressure},
      {Observable::SubstratePressure, "substrate_pressure", Dimension::Pressure},
      {Observable::ProtrudingFraction, "protruding_fraction", Dimension::Number},
      {Observable::MinimumGap, "minimum_gap", Dimension::Length},
      {Observable::StepSize, "step_size", Dimension::Time},
      {Observable::SolverIterations, "solver_iterations", Dimension::Number},
      {Observable::Contacts, "contacts", Dimension::Number},
      {Observable::NonAffineRate, "non_affine_rate", Dimension::Number},
      {Observable::Redistribution, "redistribution", Dimension::Number},
  };
  if (interactions.hindered()) names.push_back({Observable::LiquidPressure, "liquid_pressure", Dimension::Pressure});
  if (interactions.height_field) names.push_back({Observable::MinimumSubstrateGap, "minimum_substrate_gap", Dimension::Length});
  return names;
}

std::string consolidate(const Problem& problem, const RunSettings& settings, RunState& state, const RunCallbacks& callbacks) {
  Stepper stepper(problem, state);
  const bool surface = problem.interactions.free_surface.has_value();
  const double critical_pressure = problem.interactions.pressure_limited() ? std::numeric_limits<double>::infinity()
                                                                           : problem.stepping.critical_pressure.value_or(
                                                                                 default_critical_pressure(problem.interactions.liquid));
  bool shrunk = false;  // by a whole window of immobility
  const auto drift_window = static_cast<std::size_t>(std::max(5.0, std::ceil(problem.stepping.stationary_window / settings.output_every - 1e-9)));
  const bool until_stationary = problem.stepping.stop_when == SteppingParameters::StopWhen::Stationary;
  const double steady_from = problem.dewatering.steady_from();
  const bool lags = problem.interactions.pressure_limited();
  const auto store_frame = [&] {
    const double drained = stepper.height_at(state.time), height = lags ? state.surface_height : drained;
    if (state.frame > 0) {
      Redistribution last = redistribution_between(state.frame_position, state.position, problem.particles.radius, state.frame_height, height);
      // A surface that lags is held against what the dewatering takes.
      if (lags) last.fall = stepper.height_at(static_cast<double>(state.frame - 1) * settings.output_every) - drained;
      shrunk = add_to_window(state.redistribution, std::move(last), problem.stepping.immobile_shrinkage);
    }
    const std::vector<double> observables = observe(problem, state, height, drained);
    if (until_stationary && state.time >= steady_from) {
      state.mass_centre.push_back(observables[static_cast<int>(Observable::MassCentre)]);
      if (state.mass_centre.size() > 2 * drift_window) state.mass_centre.pop_front();
    }
    ++state.frame;
    callbacks.on_frame(state, height, observables);
    state.frame_position = state.position;
    state.frame_height = height;
    state.interval = empty_interval();
    return observables;
  };
  if (state.frame == 0) {
    state.interval = empty_interval();
    store_frame();
  }
  // Frame k stands at k * every, computed as a product so that no rounding builds up; the last one at `until`.
  for (;;) {
    if (state.time >= settings.until) return "until";
    const double next_frame = std::min(static_cast<double>(state.frame) * settings.output_every, settings.until);
    if (state.interval[Steps] > 0 || state.frame > 1)
      if (callbacks.on_step && callbacks.on_step(state)) return "interrupted";
    // Rounding may leave a sliver that no step can resolve: the frame is then reached.
    const double left = next_frame - state.time;
    bool critical = false;
    if (left > 1e-12 * settings.until) {
      const StepReport report = stepper.advance(state, left);
      if (report.step == left) state.time = next_frame;
      add_step(state.interval, report);
      critical = surface && report.pressures.surface > critical_pressure;
      if (callbacks.on_progress)
        callbacks.on_progress(state.time / settings.until,
                              fmt::format("t {:.4f} s, dt {:.3g} ms, {} iterations{}", state.time * 1e-3, report.step, report.iterations,
                                          surface ? fmt::format(", surface {:.3g} kPa", report.pressures.surface * 1e-3) : ""));
    } else {
      state.time = next_frame;
    }
    if (state.time < next_frame && !critical) continue;
    const std::vector<double> observables = store_frame();
    if (critical) return "first_critical_concentration";  // within a frame: the pressure of a jam would end all steps before the next
    if (is_stationary(state.mass_centre, drift_window, problem.stepping.stationary_tolerance)) return "stationary";
    if (!surface) continue;
    if (observables[static_cast<int>(Observable::ProtrudingFraction)] > problem.stepping.protruding_limit)
      return "first_critical_concentration";
    if (problem.stepping.stop_when == SteppingParameters::StopWhen::Immobile && shrunk &&
        observables[static_cast<int>(Observable::Redistribution)] < problem.stepping.immobile_rate)
      return "immobile";
  }
}

}  // namespace pigment::stepping
