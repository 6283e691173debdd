#include "stepping/integrator.h"

namespace pigment::stepping {

namespace {

// Extrapolated Euler, [deuflhard1987]: the Newton-implicit step is Euler's up to a second-order term, so twice the result of two
// half steps less that of one whole step is of second order; their difference is the error of the half steps' result, which the
// step control holds. Where the extrapolated gap of a pair would leave the bracket of a fifth of what the half steps give (both
// are far apart near contact, where a gap closes within the step), the half steps' result stands for the whole step: it is
// first order there, and never crosses.
class Extrapolated final : public Integrator {
 public:
  Attempt attempt(StepContext& context, const RunState& state, double dt, bool with_error) const override {
    Attempt a;
    const std::vector<double> guess = context.extrapolated_velocity(state);
    const StepSolution whole = context.solve({state.position, state.protrusion, state.time, dt, state.step}, assembly::Treatment::Newton, guess);
    if (!take(a, whole)) return a;
    const std::vector<double> gap = context.gaps_of_last_step();
    const StepSolution first = context.solve({state.position, state.protrusion, state.time, 0.5 * dt, state.step},
                                             assembly::Treatment::Newton, guess.empty() ? guess : whole.velocity);
    if (!take(a, first)) return a;
    Vec3Array u, w;
    context.in_file_order(first.velocity, u, w);
    const Vec3Array middle = moved(state.position, u, 0.5 * dt);
    // The whole step's velocity is nearly that of its middle: the second half's is extrapolated from the two.
    std::vector<double> second_guess = whole.velocity;
    for (std::size_t q = 0; q < second_guess.size(); ++q) second_guess[q] += whole.velocity[q] - first.velocity[q];
    const StepSolution second = context.solve({middle, first.protrusion, state.time + 0.5 * dt, 0.5 * dt, state.step},
                                              assembly::Treatment::Newton, std::move(second_guess));
    if (!take(a, second)) return a;
    a.last.pressures.surface = 0.5 * (first.pressures.surface + second.pressures.surface);
    a.last.pressures.substrate = 0.5 * (first.pressures.substrate + second.pressures.substrate);

    std::vector<double> mean(whole.velocity.size()), better(whole.velocity.size());
    for (std::size_t q = 0; q < mean.size(); ++q) {
      mean[q] = 0.5 * (first.velocity[q] + second.velocity[q]);
      better[q] = 2 * mean[q] - whole.velocity[q];
    }
    context.in_file_order(whole.velocity, u, w);
    const std::vector<double> gap_whole = context.gaps(moved(state.position, u, dt));
    context.in_file_order(mean, u, w);
    const Vec3Array halves = moved(state.position, u, dt);
    const std::vector<double> gap_halves = context.gaps(halves);
    if (with_error) {
      std::vector<double> difference(gap.size());
      for (std::size_t p = 0; p < gap.size(); ++p) difference[p] = gap_halves[p] - gap_whole[p];
      a.error = context.gap_error(gap, difference);
    }
    context.in_file_order(better, a.velocity, a.angular_velocity);
    a.position = moved(state.position, a.velocity, dt);
    const std::vector<double> gap_better = context.gaps(a.position);
    double smallest = gap_better.empty() ? a.last.check.smallest_gap : gap_better[0];
    bool safe = true;
    for (std::size_t p = 0; p < gap.size(); ++p) {
      smallest = std::min(smallest, gap_better[p]);
      if (gap_halves[p] > 0 && gap_better[p] < 0.2 * gap_halves[p]) safe = false;
    }
    if (safe) {
      a.last.check.smallest_gap = smallest;
    } else {
      a.position = halves;
      context.in_file_order(mean, a.velocity, a.angular_velocity);
    }
    return a;
  }

 private:
  static bool take(Attempt& a, const StepSolution& s) {
    a.last = s;
    a.iterations += s.iterations;
    a.solves += s.solves;
    return s.good;
  }
};

}  // namespace

std::unique_ptr<Integrator> extrapolated() { return std::make_unique<Extrapolated>(); }

}  // namespace pigment::stepping
