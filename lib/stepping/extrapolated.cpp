#include <algorithm>

#include "stepping/integrator.h"

namespace pigment::stepping {

namespace {

// Extrapolated Euler, [deuflhard1987]: the Newton-implicit step is Euler's up to a second-order term, so twice the result of two
// half steps less that of one whole step is of second order; their difference is the error of the half steps' result, which the
// step control holds.
// Extrapolating knows nothing of contact. A particle that it would bring nearer to another than a fifth of the gap that the half
// steps leave (which never cross; nine tenths where that is a tenth of a Debye length) stays where the half steps put it; one that it would bring through the surface, or nearer to
// the substrate than that, stops there.
class Extrapolated final : public Integrator {
 public:
  Attempt attempt(StepContext& context, const RunState& state, double dt, bool with_error) const override {
    Attempt a;
    const std::vector<double> guess = context.extrapolated_velocity(state);
    const StepSolution whole = context.solve({state.position, state.protrusion, state.time, dt, {state.step}, state.surface_height, state.surface_velocity},
                                              assembly::Treatment::Newton, guess);
    if (!take(a, whole)) return a;
    const std::vector<double> gap = context.gaps_of_last_step();
    const StepSolution first = context.solve({state.position, state.protrusion, state.time, 0.5 * dt, {state.step}, state.surface_height, state.surface_velocity},
                                             assembly::Treatment::Newton, guess.empty() ? guess : whole.velocity);
    if (!take(a, first)) return a;
    Vec3Array u, w;
    context.in_file_order(first.velocity, u, w);
    const Vec3Array middle = moved(state.position, u, 0.5 * dt);
    // The whole step's velocity is nearly that of its middle: the second half's is extrapolated from the two.
    std::vector<double> second_guess = whole.velocity;
    for (std::size_t q = 0; q < second_guess.size(); ++q) second_guess[q] += whole.velocity[q] - first.velocity[q];
    const StepSolution second = context.solve({middle, first.protrusion, state.time + 0.5 * dt, 0.5 * dt, {state.step}, first.check.surface_height,
                                               state.surface_velocity}, assembly::Treatment::Newton, std::move(second_guess));
    if (!take(a, second)) return a;
    // Extrapolated as the velocities are, so that the forces on the layer balance.
    const auto extrapolate = [&](double assembly::BoundaryPressures::*p) {
      a.last.pressures.*p = first.pressures.*p + second.pressures.*p - whole.pressures.*p;
    };
    extrapolate(&assembly::BoundaryPressures::surface);
    extrapolate(&assembly::BoundaryPressures::substrate);
    extrapolate(&assembly::BoundaryPressures::liquid);

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
    const Vec3Array mean_velocity = u, mean_angular = w;
    context.in_file_order(better, a.velocity, a.angular_velocity);
    a.position = moved(state.position, a.velocity, dt);
    const auto keep_halves = [&](std::size_t k) {
      if (a.position[k] == halves[k]) return false;
      a.position[k] = halves[k];
      a.velocity[k] = mean_velocity[k];
      a.angular_velocity[k] = mean_angular[k];
      return true;
    };
    const double surface = context.surface_height(second, state.time + dt);
    for (std::size_t k = 0; k < halves.size(); ++k) {
      const double z = context.height_within(k, a.position[k].z(), halves[k].z(), surface);
      if (z == a.position[k].z()) continue;
      a.position[k].z() = z;
      a.velocity[k].z() = (z - state.position[k].z()) / dt;
    }
    for (std::size_t k = 0; k < halves.size(); ++k)
      if (context.too_near_substrate(k, a.position[k], halves[k])) keep_halves(k);
    // Moving one back can bring it near a neighbour that went on: until none is, or all are back.
    for (bool settled = false; !settled;) {
      settled = true;
      const std::vector<double> end = context.gaps(a.position);
      a.last.check.smallest_gap = end.empty() ? a.last.check.smallest_gap : *std::min_element(end.begin(), end.end());
      for (std::size_t p = 0; p < gap.size(); ++p)
        if (gap_halves[p] > 0 && end[p] < context.nearest_share_at(gap_halves[p]) * gap_halves[p]) {
          const auto [i, j] = context.pair(p);
          const bool i_moved = keep_halves(i), j_moved = keep_halves(j);
          if (i_moved || j_moved) settled = false;
        }
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
