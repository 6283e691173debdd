#pragma once
// What a run is given and never changes.
#include <cstdint>
#include <optional>

#include "assembly/interactions.h"
#include "model/brownian_constant.h"
#include "model/dewatering_curve.h"
#include "model/particles.h"
#include "stepping/parameters.h"

namespace pigment::stepping {

struct Problem {
  Particles particles;
  Cell cell;                                          // of the packing; height is H(0)
  assembly::Interactions interactions;
  DewateringCurve dewatering;                         // empty time: no flow
  std::optional<BrownianCalibration> calibration;     // absent: the closed form
  SteppingParameters stepping;
  std::uint64_t seed = 1;
};

}  // namespace pigment::stepping
