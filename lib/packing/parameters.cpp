#include "packing/parameters.h"

namespace pigment::packing {

PackingParameters read_packing(config::Node node) {
  PackingParameters packing;
  packing.minimum_gap = node.quantity("minimum_gap", Dimension::Length, "2 nm", config::non_negative());
  packing.equilibration_sweeps =
      static_cast<int>(node.integer("equilibration_sweeps", 0, config::between(0, 1000000)));
  return packing;
}

}  // namespace pigment::packing
