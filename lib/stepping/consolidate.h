#pragma once
// The run: steps from output frame to output frame until it is over.
#include <functional>
#include <string>
#include <vector>

#include "stepping/stepper.h"

namespace pigment::stepping {

// Scalars recorded with every frame, in this order.
enum class Observable {
  Thickness, Z95, Z99, SolidsMassFraction, MassCentre, SurfacePressure, SubstratePressure, ProtrudingFraction,
  MinimumGap, StepSize, SolverIterations, Contacts, NonAffineRate, Redistribution,
  LiquidPressure,       // with hindered drag
  MinimumSubstrateGap,  // over a substrate that is not flat
};
struct ObservableName {
  Observable observable;
  const char* name;      // dataset below /observables
  Dimension dimension;
};
std::vector<ObservableName> observable_names(const assembly::Interactions&);

struct RunSettings {
  double output_every = 5;  // ms
  double until = 0;         // ms
};

struct RunCallbacks {
  // A frame to store: state and observables (order of observable_names). Called for frame 0 too.
  std::function<void(const RunState&, double height, const std::vector<double>& observables)> on_frame;
  // Between steps; true: save a checkpoint now and stop (a signal arrived).
  std::function<bool(const RunState&)> on_step;
  std::function<void(double fraction, const std::string& detail)> on_progress;
};

// "until", "immobile", "stationary", "first_critical_concentration", or "interrupted" where on_step asked to stop.
// A state with frame > 0 goes on where it was. Throws NumericsError where a step cannot be taken.
std::string consolidate(const Problem&, const RunSettings&, RunState&, const RunCallbacks&);

}  // namespace pigment::stepping
