#pragma once
// K_Brown found as the source finds it: a lone sphere far from everything is moved by the engine's own step, and K is set so
// that its mean square displacement is that of (23), (24) in [sand2010].
#include <functional>

#include "model/brownian_constant.h"
#include "stepping/stepper.h"

namespace pigment::calibration {

struct CalibrationSettings {
  std::vector<double> temperatures;  // K, rising
  int simulations = 25, displacements = 45000;
  double time_step = 0.1;            // ms
  double radius = 1;                 // um
  std::uint64_t seed = 1;
};

// Each simulation moves the sphere `displacements` steps with K = 1 pN um^-1/2; displacements are proportional to K, so that
// the K of that simulation is sqrt(2 D dt/<dx^2>), <dx^2> over the steps, one component as in (23). (All three together say
// nothing: the force has a fixed length, and so has every step.) Mean and standard deviation are over the simulations, each
// good to 0.2 % with 45,000 displacements. on_progress gets the fraction done.
BrownianCalibration calibrate(const LiquidParameters&, const CalibrationSettings&,
                              const std::function<void(double)>& on_progress = {});

}  // namespace pigment::calibration
