#pragma once
// One step of the layer: linearly implicit Euler for R(x) x' = F(x, t), solved again where gaps close or the surface catches
// particles (assembly/step_assembly.h), and the choice of its length.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/step_assembly.h"
#include "model/brownian_constant.h"
#include "model/dewatering_curve.h"
#include "solve/conjugate_gradients.h"
#include "stepping/parameters.h"
#include "stepping/run_state.h"

namespace pigment::stepping {

// What a run is given and never changes.
struct Problem {
  Particles particles;
  Cell cell;                                          // of the packing; height is H(0)
  assembly::Interactions interactions;
  DewateringCurve dewatering;                         // empty time: no flow
  std::optional<BrownianCalibration> calibration;     // absent: the closed form
  SteppingParameters stepping;
  std::uint64_t seed = 1;
};

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
  ~Stepper();
  // Advances the state by at most `longest` ms. Throws NumericsError (step, time, pair, radii, gap, force and a step that
  // would do) where no step down to 1e-9 ms succeeds; the state is then as before.
  StepReport advance(RunState&, double longest);
  // First step of a run, ms.
  static double first_step(const Problem&);
  double height_at(double time) const;  // um; the cell's own height where there is no free surface

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// A state at rest at time 0 for a packing.
RunState initial_state(const Problem&, const Vec3Array& position);

}  // namespace pigment::stepping
