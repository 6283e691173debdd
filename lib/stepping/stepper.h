#pragma once
// One step of the layer by the scene's integrator (stepping/integrator.h), and the choice of its length.
#include <memory>

#include "stepping/integrator.h"
#include "stepping/problem.h"
#include "stepping/run_state.h"

namespace pigment::stepping {

struct StepReport {
  double step = 0;              // ms, taken
  int iterations = 0;           // of the solver, all solves of the step
  int solves = 0;
  int rejected = 0;
  double error = 0;             // estimated, in units of the tolerance
  double smallest_gap = 0;      // um
  assembly::BoundaryPressures pressures;
  double height = 0;            // H at the end
};

class Stepper {
 public:
  Stepper(const Problem&, const RunState&);
  // Advances the state by at most `longest` ms. Throws NumericsError (step, time, pair, radii, gap, force and a step that
  // would do) where no step down to 1e-9 ms succeeds; the state is then as before.
  StepReport advance(RunState&, double longest);
  // First step of a run, ms.
  static double first_step(const Problem&);
  double height_at(double time) const;  // um; the cell's own height where there is no free surface

 private:
  StepContext context_;
  std::unique_ptr<Integrator> integrator_;
};

// A state at rest at time 0 for a packing.
RunState initial_state(const Problem&, const Vec3Array& position);

}  // namespace pigment::stepping
