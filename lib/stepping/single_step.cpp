// The three integrators that solve once (or until Newton has converged) from the step's beginning.
#include "stepping/integrator.h"

namespace pigment::stepping {

namespace {
// Where Newton's method has a long way to go (passes) bonds are about to tear, and a much longer step is likely to fail, which costs more
// than it would bring.
double growth_among_bonds(int passes) { return passes > 9 ? 1 : passes > 3 ? 1.1 : std::numeric_limits<double>::infinity(); }
}  // namespace

Attempt single_step(StepContext& context, const RunState& state, double dt, assembly::Treatment treatment, bool with_error) {
  Attempt a;
  a.last = context.solve({state.position, state.protrusion, state.time, dt, {state.step}, state.surface_height, state.surface_velocity}, treatment,
                         context.extrapolated_velocity(state));
  a.iterations = a.last.iterations;
  a.solves = a.last.solves;
  if (!a.last.good) return a;
  if (treatment == assembly::Treatment::ConvexSplitting) a.largest_growth = growth_among_bonds(a.solves);
  if (with_error && state.last_step > 0) {
    std::vector<double> rate = context.gap_rates(a.last.velocity);
    const std::vector<double> before = context.gap_rates(context.in_engine_order(state.velocity, state.angular_velocity));
    // The rates are means over steps whose middles lie (dt + last)/2 apart.
    const double factor = dt * dt / (dt + state.last_step);
    for (std::size_t p = 0; p < rate.size(); ++p) rate[p] = factor * (rate[p] - before[p]);
    // A pair that fell into contact is where its forces balance, whatever its way there: the estimate as the step's own stiffness damps it
    // [hairer1996], IV.8, gap by gap.
    if (treatment == assembly::Treatment::ConvexSplitting)
      for (std::size_t p = 0; p < rate.size(); ++p) rate[p] *= context.memory_of_last_step()[p];
    a.error = context.gap_error(context.gaps_of_last_step(), rate);
  }
  context.in_file_order(a.last.velocity, a.velocity, a.angular_velocity);
  a.position = moved(state.position, a.velocity, dt);
  return a;
}

namespace {

class SingleStep final : public Integrator {
 public:
  explicit SingleStep(assembly::Treatment treatment) : treatment_(treatment) {}
  Attempt attempt(StepContext& context, const RunState& state, double dt, bool with_error) const override {
    return single_step(context, state, dt, treatment_, with_error);
  }
  bool is_explicit() const override { return treatment_ == assembly::Treatment::Explicit; }

 private:
  assembly::Treatment treatment_;
};

}  // namespace

std::unique_ptr<Integrator> explicit_euler() { return std::make_unique<SingleStep>(assembly::Treatment::Explicit); }
std::unique_ptr<Integrator> linearly_implicit() { return std::make_unique<SingleStep>(assembly::Treatment::LinearlyImplicit); }
std::unique_ptr<Integrator> convex_splitting() { return std::make_unique<SingleStep>(assembly::Treatment::ConvexSplitting); }
std::unique_ptr<Integrator> newton_implicit() { return std::make_unique<SingleStep>(assembly::Treatment::Newton); }

}  // namespace pigment::stepping
