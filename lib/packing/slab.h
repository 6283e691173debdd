#pragma once
// The room that hard spheres are packed into: periodic in x and y, between two hard planes, the lower of which may be a rough surface.
// A minimum gap is packed as half of it around every sphere and beside each plane, so the stages below know
// no gaps.
#include <algorithm>

#include "model/cell.h"
#include "model/height_field.h"

namespace pigment::packing {

struct Slab {
  double width = 0;            // um, period in x and y
  double bottom = 0, top = 0;  // um, planes that no sphere crosses
  const HeightField* floor = nullptr;  // a surface above the bottom that none comes nearer to than
  double floor_gap = 0;                // this, um; null: none

  // How deep a sphere reaches into the space that the floor keeps free, um; 0 where it does not.
  double floor_overlap(const Vec3& centre, double radius) const {
    return floor ? std::max(0.0, floor_gap - floor->gap(centre, radius, floor_gap)) : 0;
  }

  Cell cell() const { return {width, width, top}; }
};

}  // namespace pigment::packing
