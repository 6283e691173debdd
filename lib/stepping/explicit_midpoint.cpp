#include "stepping/integrator.h"

namespace pigment::stepping {

namespace {

// U at x0 moves the layer half a step; U there moves it the whole step. The difference of the two is the error of the first.
class ExplicitMidpoint final : public Integrator {
 public:
  Attempt attempt(StepContext& context, const RunState& state, double dt, bool with_error) const override {
    Attempt a;
    const StepSolution first = context.solve({state.position, state.protrusion, state.time, 0.5 * dt, {state.step}, state.surface_height, state.surface_velocity},
                                             assembly::Treatment::Explicit, context.extrapolated_velocity(state));
    a.last = first;
    a.iterations = first.iterations;
    a.solves = first.solves;
    if (!first.good) return a;
    context.in_file_order(first.velocity, a.velocity, a.angular_velocity);
    const Vec3Array middle = moved(state.position, a.velocity, 0.5 * dt);
    const std::vector<double> gap = context.gaps_of_last_step();
    // From the middle on the surroundings are those of the second half.
    a.last = context.solve({middle, first.protrusion, state.time + 0.5 * dt, 0.5 * dt, {state.step}, first.check.surface_height, state.surface_velocity},
                           assembly::Treatment::Explicit, first.velocity);
    a.iterations += a.last.iterations;
    a.solves += a.last.solves;
    if (!a.last.good) return a;
    if (with_error) {
      std::vector<double> rate = context.gap_rates(a.last.velocity);
      const std::vector<double> before = context.gap_rates(first.velocity);
      for (std::size_t p = 0; p < rate.size(); ++p) rate[p] = dt * (rate[p] - before[p]);
      a.error = context.gap_error(gap, rate);
    }
    context.in_file_order(a.last.velocity, a.velocity, a.angular_velocity);
    a.position = moved(state.position, a.velocity, dt);
    // A gap that was open stays open, or the step is one too long.
    const std::vector<double> end = context.gaps(a.position);
    for (std::size_t p = 0; p < end.size(); ++p)
      if (gap[p] > 0 && end[p] <= 0 && context.problem().interactions.lubrication()) {
        a.last.good = false;
        a.last.check.crossed = true;
        a.last.check.worst_pair = p;
        a.last.check.smallest_gap = end[p];
      }
    for (std::size_t k = 0; k < a.position.size(); ++k)
      if (context.too_near_substrate(k, a.position[k], state.position[k])) {
        a.last.good = false;
        a.last.check.crossed = true;
      }
    return a;
  }
  bool is_explicit() const override { return true; }
};

}  // namespace

std::unique_ptr<Integrator> explicit_midpoint() { return std::make_unique<ExplicitMidpoint>(); }

}  // namespace pigment::stepping
