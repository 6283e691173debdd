// Steps with noise that obeys fluctuation and dissipation (assembly/thermal_force.h, assembly/path_average.cpp).
#include "stepping/integrator.h"

namespace pigment::stepping {

namespace {

// 2^-12 of a step: below it something else is wrong.
constexpr int deepest = 12;

void accumulate(Vec3Array& sum, const Vec3Array& velocity, double share) {
  if (sum.empty()) sum.assign(velocity.size(), Vec3::Zero());
  for (std::size_t k = 0; k < velocity.size(); ++k) sum[k] += share * velocity[k];
}

class Fluctuating final : public Integrator {
 public:
  explicit Fluctuating(assembly::Treatment treatment) : treatment_(treatment) {}

  Attempt attempt(StepContext& context, const RunState& state, double dt, bool) const override {
    Attempt a;
    a.position = state.position;
    a.last.protrusion = state.protrusion;
    a.last.check.smallest_gap = 1e300;
    a.last.check.surface_height = state.surface_height;
    go(context, state, dt, {state.step}, a);
    return a;
  }

 private:
  // Appends one interval of the step to the attempt. One that does not come out is taken in two halves of the same path: a step
  // thrown away for what its noise did, and drawn anew, would be a choice among noises.
  void go(StepContext& context, const RunState& state, double dt, const assembly::NoiseInterval& noise, Attempt& a) const {
    const auto parts = static_cast<double>(std::uint64_t{1} << noise.level);
    const double begin = state.time + dt * static_cast<double>(noise.part) / parts;
    StepSolution s;
    Vec3Array u, w, end;
    // Pairs that were not listed are met only in steps in which spheres diffuse over their own size: once listed, or in a shorter part.
    for (bool again : {true, false}) {
      s = context.solve({a.position, a.last.protrusion, begin, dt / parts, noise, a.last.check.surface_height, state.surface_velocity},
                        treatment_, {});
      a.iterations += s.iterations;
      a.solves += s.solves;
      if (!s.good) break;
      context.in_file_order(s.velocity, u, w);
      end = moved(a.position, u, dt / parts);
      if (!context.overlaps_unseen(a.position, end)) break;
      s.good = noise.level == deepest;
      if (again) context.list_at(a.position, begin);
    }
    if (s.good) {
      a.position = std::move(end);
      accumulate(a.velocity, u, 1 / parts);
      accumulate(a.angular_velocity, w, 1 / parts);
      s.check.smallest_gap = std::min(s.check.smallest_gap, a.last.check.smallest_gap);
      a.last = std::move(s);
      return;
    }
    if (noise.level == deepest) {
      a.last = std::move(s);
      return;
    }
    for (std::uint64_t half : {0, 1}) {
      go(context, state, dt, {noise.step, noise.level + 1, 2 * noise.part + half}, a);
      if (!a.last.good) return;
    }
  }

  assembly::Treatment treatment_;
};

}  // namespace

std::unique_ptr<Integrator> fluctuating(assembly::Treatment treatment) { return std::make_unique<Fluctuating>(treatment); }

}  // namespace pigment::stepping
