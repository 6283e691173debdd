#include <algorithm>

#include "stepping/integrator.h"

namespace pigment::stepping {

namespace {

// The second-order backward differentiation formula for variable steps [hairer1996]: with w = dt/dt_last the velocity at the step's end is
//   ((1 + 2w)/(1 + w) x1 - (1 + w) x0 + w^2/(1 + w) x_before)/dt,
// so that a step is Euler's from x0 + w^2/(1 + 2w) (x0 - x_before) over (1 + w)/(1 + 2w) dt. What does not depend on a gap is taken where the
// velocities of the last two steps, extrapolated, lead. L-stable, as Euler's own step, so that stiff gaps follow what moves them.
class BackwardDifferentiation final : public Integrator {
 public:
  Attempt attempt(StepContext& context, const RunState& state, double dt, bool with_error) const override {
    if (!(state.last_step > 0)) {
      Attempt first = single_step(context, state, dt, assembly::Treatment::Newton, with_error);
      first.end_pressure = at_end(first);
      return first;
    }
    const double w = dt / state.last_step, share = w * w / (1 + 2 * w), span = dt * (1 + w) / (1 + 2 * w);
    // Mean velocities belong to the middles of their steps.
    const double ahead = state.previous_step > 0 ? std::min((dt + state.last_step) / (state.last_step + state.previous_step), furthest) : 0;
    const std::size_t n = state.position.size();
    Vec3Array before(n), from(n), predicted(n);
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3& u = state.velocity[k];
      const Vec3 expected = u + ahead * (u - state.previous_velocity[k]);
      before[k] = state.position[k] - state.last_step * u;
      from[k] = state.position[k] + share * state.last_step * u;
      predicted[k] = state.position[k] + dt * expected;
    }
    const assembly::TwoStep two_step{share, before, from, predicted, context.gap_scale_at(state.time)};
    StepStart start{state.position, state.protrusion, state.time, dt, {state.step}, state.surface_height, state.surface_velocity};
    start.two_step = &two_step;
    start.last_step = state.last_step;
    start.span = span;
    Attempt a;
    a.last = context.solve(start, assembly::Treatment::Newton, starting_velocity(context, state, two_step, span, std::min(w, furthest)));
    a.iterations = a.last.iterations;
    a.solves = a.last.solves;
    if (!a.last.good) return a;
    // Forces are those at the step's end; reported are means over it.
    a.end_pressure = at_end(a);
    a.last.pressures.surface = 0.5 * (state.end_pressure[0] + a.end_pressure[0]);
    a.last.pressures.substrate = 0.5 * (state.end_pressure[1] + a.end_pressure[1]);
    a.last.pressures.liquid = 0.5 * (state.end_pressure[2] + a.end_pressure[2]);
    Vec3Array u;
    context.in_file_order(a.last.velocity, u, a.angular_velocity);
    a.position = moved(from, u, span);
    a.velocity.resize(n);
    for (std::size_t k = 0; k < n; ++k) a.velocity[k] = (a.position[k] - state.position[k]) / dt;
    // Not its own error, which is of third order, but that of Euler's step in its place: motion with kinks, as of pairs that meet, has no
    // third derivative to estimate. Damped by each gap's own stiffness, as the step damps it [hairer1996], IV.8.
    if (with_error) {
      std::vector<double> rate = context.gap_rates(context.in_engine_order(a.velocity, a.angular_velocity));
      const std::vector<double> rate_before = context.gap_rates(context.in_engine_order(state.velocity, state.angular_velocity));
      const double factor = dt * dt / (dt + state.last_step);
      for (std::size_t p = 0; p < rate.size(); ++p) rate[p] = factor * context.memory_of_last_step()[p] * (rate[p] - rate_before[p]);
      a.error = context.gap_error(context.gaps_of_last_step(), rate);
    }
    return a;
  }

 private:
  // Where the extrapolated velocities lead, as the velocity of the step from two_step.from; spins extrapolated by `ahead` of the last change.
  static std::vector<double> starting_velocity(const StepContext& context, const RunState& state, const assembly::TwoStep& two_step, double span,
                                               double ahead) {
    const std::size_t n = state.position.size();
    Vec3Array first(n), spin(n);
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < n; ++k) {
      first[k] = (two_step.predicted[k] - two_step.from[k]) / span;
      spin[k] = state.angular_velocity[k] + ahead * (state.angular_velocity[k] - state.previous_angular_velocity[k]);
    }
    return context.in_engine_order(first, spin);
  }
  static std::array<double, 3> at_end(const Attempt& a) { return {a.last.pressures.surface, a.last.pressures.substrate, a.last.pressures.liquid}; }
  static constexpr double furthest = 1.5;  // what is extrapolated further is no guess
};

}  // namespace

std::unique_ptr<Integrator> backward_differentiation() { return std::make_unique<BackwardDifferentiation>(); }

}  // namespace pigment::stepping
