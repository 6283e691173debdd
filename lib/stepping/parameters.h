#pragma once
// The scene's `stepping` and `output` blocks.
#include <optional>

#include "config/node.h"
#include "model/liquid.h"

namespace pigment::stepping {

struct SteppingParameters {
  enum class Integrator { Automatic, ExplicitEuler, ExplicitMidpoint, LinearlyImplicit, NewtonImplicit, Extrapolated, BackwardDifferentiation, ConvexSplitting };
  Integrator integrator = Integrator::Automatic;  // stepping/integrator.h
  double tolerance = 1e-2;           // error of a gap in one step, in units of gap + Debye length (see step_control.h)
  std::optional<double> time_step;   // ms; given: fixed steps
  std::optional<double> until;       // ms; absent: the end of the dewatering curve
  enum class StopWhen { Immobile, Stationary, Until };
  StopWhen stop_when = StopWhen::Until;
  std::optional<double> solver_tolerance;  // relative residual of each solve; absent: 1e-4, with Brownian motion 1e-3
  double immobile_rate = 1e-2;       // immobile: mass displacement between heights over the window is below this share of |dH|
  double immobile_shrinkage = 0.03;  // the window: the last frames in which the layer shrank by this share (model/redistribution.h)
  double stationary_tolerance = 0.02; // stationary: the mass centre drifts by less than this share of its height from window to window
  double stationary_window = 1000;    // ms; in whole output frames, at least five (stepping/stationary.h)
  double protruding_limit = 1e-2;    // first critical concentration: more than this share of the solids is above the surface
  std::optional<double> critical_pressure;  // pN/um^2; or the surface presses with more than this; absent: default_critical_pressure
};
// 5 kPa in water. Before the particles carry the surface it presses with what the liquid between them takes, which grows with the
// viscosity: under 0.6 kPa in a layer that is drained in 80 ms; once they do, the pressure grows tenfold as a layer shrinks by 0.5 %.
double default_critical_pressure(const LiquidParameters&);
SteppingParameters read_stepping(config::Node);

struct OutputParameters {
  double every = 5;  // ms
};
OutputParameters read_output(config::Node);

}  // namespace pigment::stepping
