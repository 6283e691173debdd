#include "stepping/stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "stepping/step_control.h"

namespace pigment::stepping {

namespace {
constexpr double shortest_step = 1e-9;  // ms
// A step whose error is that many times what was asked for is taken again, shorter.
constexpr double intolerable = 4;
// Times are sums that round: what is left over by less than this share of a step is no step of its own.
constexpr double rounding = 1e-9;
// A noisy step that failed is made in halves, and so are those that follow: in an uncharged layer three quarters of the time went into steps as
// long as the noise allows, of which all failed. They grow back slowly, by half in 20 steps. What takes more than two halvings is one mishap,
// and no reason for ever shorter steps, unless the two steps before took more as well.
constexpr double growth_after_failure = 1.02, remembered = 0.25;
// Every so many steps a layer that its bonds make stiff is tried without the solver's network.
constexpr int look_again = 16;

// The particle that a step would carry furthest, where that is beyond the layer's width and height: it was thrown there by a step far too
// long for its forces; what settles or flows along comes to no such distance. -1: none. With lubrication no step does that; without,
// nothing else says so of one whose gaps are all open again.
std::int64_t thrown_particle(const Vec3Array& from, const Vec3Array& to, double size) {
  double farthest = size * size;
  std::int64_t thrown = -1;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const double moved = (to[k] - from[k]).squaredNorm();
    if (moved <= farthest) continue;
    thrown = static_cast<std::int64_t>(k);
    if (!std::isfinite(moved)) break;
    farthest = moved;
  }
  return thrown;
}

double noise_step(const Problem& p, const Liquid& liquid) {
  const double scale = gap_scale(p.interactions, liquid);
  return p.interactions.brownian->model == forces::BrownianParameters::Model::FluctuationDissipation
             ? thermal_step(p.particles, liquid, scale, p.interactions.lubrication())
             : brownian_step(p.particles, liquid, scale);
}
}  // namespace

Stepper::Stepper(const Problem& problem, const RunState& state) : context_(problem, state), integrator_(make_integrator(problem)) {}

double Stepper::height_at(double time) const { return context_.height_at(time); }

double Stepper::first_step(const Problem& p) {
  if (p.stepping.time_step) return *p.stepping.time_step;
  const Liquid liquid = liquid_at(p.interactions.liquid, p.dewatering.temperature_at(0, p.interactions.liquid.temperature));
  if (p.interactions.brownian) return noise_step(p, liquid);
  return 1e-3;
}

StepReport Stepper::advance(RunState& state, double longest) {
  const Problem& problem = context_.problem();
  const bool fixed = problem.stepping.time_step.has_value(), noisy = problem.interactions.brownian.has_value();
  const bool controlled = !fixed && !noisy;
  context_.refresh_list(state);
  // Chosen before the noise is drawn, and never after, by the temperature, which may have changed, and by what earlier steps came to.
  if (noisy && !fixed) {
    const double most = noise_step(problem, context_.liquid_at_time(state.time));
    const double least = std::min(remembered * most, std::max(state.last_step, state.previous_step));
    state.preferred_step = std::clamp(growth_after_failure * state.preferred_step, least, most);
  }
  double dt = std::min(state.preferred_step, longest);
  if (longest - dt < rounding * dt) dt = longest;
  else if (dt > 0.5 * longest) dt = 0.5 * longest;  // two even steps rather than a sliver at the end
  StepReport report;
  for (;; ++report.rejected) {
    context_.remember({state.solver.stiff && state.step % look_again != 0, state.solver.network_cost});
    Attempt attempt = integrator_->attempt(context_, state, dt, controlled);
    report.iterations += attempt.iterations;
    report.solves += attempt.solves;
    const double layer_size = std::max({problem.cell.width_x, problem.cell.width_y, problem.cell.height});
    const std::int64_t thrown = attempt.last.good ? thrown_particle(state.position, attempt.position, layer_size) : -1;
    const bool good = attempt.last.good && thrown < 0;
    const double error = controlled ? attempt.error / problem.stepping.tolerance : 0;
    if (good && error < intolerable) {
      report.step = dt;
      report.error = error;
      report.smallest_gap = attempt.last.check.smallest_gap;
      report.pressures = attempt.last.pressures;
      report.height = context_.surface_height(attempt.last, state.time + dt);
      state.surface_velocity = (report.height - state.surface_height) / dt;
      state.surface_height = report.height;
      state.end_pressure = attempt.end_pressure;
      state.solver = context_.memory();
      state.previous_velocity = std::move(state.velocity);
      state.previous_angular_velocity = std::move(state.angular_velocity);
      state.velocity = std::move(attempt.velocity);
      state.angular_velocity = std::move(attempt.angular_velocity);
      state.position = std::move(attempt.position);
      state.protrusion = std::move(attempt.last.protrusion);
      state.previous_step = state.last_step;
      state.last_step = dt;
      state.time += dt;
      ++state.step;
      if (controlled) {
        // A step cut short to meet an output time says nothing against the longer one, unless even it was too long.
        const double wanted = std::min(next_step(dt, error), attempt.largest_growth * dt);
        state.preferred_step = dt < state.preferred_step && error < 1 ? std::max(wanted, std::min(state.preferred_step, 4 * wanted)) : wanted;
      }
      return report;
    }
    const double shorter = good ? std::max(0.3, 0.9 / std::sqrt(error)) * dt : 0.5 * dt;
    // An explicit step of a length that the scene insists on is a matter for its user.
    if (shorter < shortest_step || (fixed && integrator_->is_explicit()))
      throw NumericsError(context_.describe_failure(state, dt, attempt.last) +
                          (thrown < 0 ? ""
                                      : fmt::format("; id {}, of radius {:.4g} um, would move by {:.3g} um, further than the layer is wide or high",
                                                    problem.particles.id[thrown], problem.particles.radius[thrown],
                                                    (attempt.position[thrown] - state.position[thrown]).norm())));
    dt = shorter;
    if (!fixed) state.preferred_step = dt;
  }
}

RunState initial_state(const Problem& problem, const Vec3Array& position) {
  RunState s;
  const std::size_t n = position.size();
  s.position = s.list_reference = s.frame_position = position;
  s.velocity = s.angular_velocity = s.previous_velocity = s.previous_angular_velocity = Vec3Array(n, Vec3::Zero());
  s.protrusion.assign(n, 0.0);
  s.frame_height = s.surface_height = problem.cell.height;
  s.preferred_step = Stepper::first_step(problem);
  s.list_temperature = problem.dewatering.temperature_at(0, problem.interactions.liquid.temperature);
  return s;
}

}  // namespace pigment::stepping
