#pragma once
// How far a point is from the nearest sphere's surface.
#include <memory>
#include <vector>

#include "base/vec.h"
#include "model/cell.h"

namespace pigment::neighbours {

// Spheres in a cell, x and y periodic, z open; built once, asked for many points, by any number of threads. One grid a
// size class, so that the effort a point does not depend on the size ratio. Positions must be finite.
class NearestSurface {
 public:
  NearestSurface(const Cell&, const Vec3Array& position, const std::vector<double>& radius);
  ~NearestSurface();

  // um; negative inside a sphere (then minus its depth in the sphere in which it lies deepest); infinite without
  // spheres.
  double distance(const Vec3& point) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace pigment::neighbours
