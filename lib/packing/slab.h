#pragma once
// The room that hard spheres are packed into: periodic in x and y, between two hard planes.
// A minimum gap is packed as half of it around every sphere and beside each plane, so the stages below know
// no gaps.
#include "model/cell.h"

namespace pigment::packing {

struct Slab {
  double width = 0;            // um, period in x and y
  double bottom = 0, top = 0;  // um, planes that no sphere crosses

  Cell cell() const { return {width, width, top}; }
};

}  // namespace pigment::packing
