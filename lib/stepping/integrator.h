#pragma once
// One way of taking a step of R(x) x' = F(x, t). An integrator tries a step of a given length and says how it came out; the
// stepper (stepping/stepper.h) chooses the length, accepts or tries again. One file each:
//   explicit_euler      x1 = x0 + dt R^-1 F, first order; stable only where dt is below the stiffest gap's relaxation time
//   explicit_midpoint   the same with R and F half a step ahead, second order
//   linearly_implicit   (R + dt K) U = F, one solve, first order
//   newton_implicit     the force at the gap that comes out and the squeeze resistance averaged over the step, which no gap
//                       can cross; first order
//   extrapolated        newton_implicit once over dt and twice over dt/2, x = 2 x_half - x_full: second order
//                       (LIMEX; [deuflhard1987])
//   convex_splitting    newton_implicit with the attractions of the beginning; first order
//   backward_differentiation  newton_implicit with the velocity of the step before: second order, one solution a step
//                       (BDF2 with variable steps; [hairer1996])
#include <array>
#include <limits>
#include <memory>

#include "stepping/step_context.h"

namespace pigment::stepping {

struct Attempt {
  StepSolution last;               // of the solve made last: good or why not, mean pressures over the step, protrusion
  std::array<double, 3> end_pressure{};  // at the step's end: on surface and substrate, of the liquid; backward_differentiation alone
  Vec3Array position;              // at the step's end, file order
  Vec3Array velocity, angular_velocity;  // means over the step
  double error = 0;                // estimated, root mean square over near pairs, in units of gap + Debye length
  double largest_growth = std::numeric_limits<double>::infinity();  // of the next step over this one, whatever its error
  int iterations = 0, solves = 0;
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  // dt: ms. with_error: whether `error` is asked for. A step that cannot be taken comes back with last.good false.
  virtual Attempt attempt(StepContext&, const RunState&, double dt, bool with_error) const = 0;
  virtual bool is_explicit() const { return false; }
};

// Throws nothing; `automatic` is resolved for the scene: see integrators.cpp.
std::unique_ptr<Integrator> make_integrator(const Problem&);

std::unique_ptr<Integrator> explicit_euler();
std::unique_ptr<Integrator> explicit_midpoint();
std::unique_ptr<Integrator> linearly_implicit();
std::unique_ptr<Integrator> newton_implicit();
std::unique_ptr<Integrator> convex_splitting();
std::unique_ptr<Integrator> extrapolated();
std::unique_ptr<Integrator> backward_differentiation();
std::unique_ptr<Integrator> fluctuating(assembly::Treatment);

// x0 + dt U for every particle.
Vec3Array moved(const Vec3Array& position, const Vec3Array& velocity, double dt);
// One step of first order, its error from how much the rates of the gaps differ from the last step's:
// dt/2 |dgap/dt - dgap/dt of the last step|.
Attempt single_step(StepContext&, const RunState&, double dt, assembly::Treatment, bool with_error);

}  // namespace pigment::stepping
