#pragma once
// The scene's `packing` block: how the layer's particles are placed.
#include "config/node.h"
#include "model/layer_parameters.h"  // the `layer` block, which packing shares with dewatering

namespace pigment::packing {

struct PackingParameters {
  double minimum_gap = 2e-3;     // um; between particles, to the substrate and to the surface
  int equilibration_sweeps = 0;  // Monte-Carlo moves a particle
};
// Keys: minimum_gap, equilibration_sweeps; all have defaults.
PackingParameters read_packing(config::Node);

}  // namespace pigment::packing
