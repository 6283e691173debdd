#pragma once
// The simulation cell: periodic in x and y, open in z. z = 0 is the substrate.
#include <cmath>

#include "base/vec.h"

namespace pigment {

struct Cell {
  double width_x = 0, width_y = 0;  // periods
  double height = 0;                // box edge z: the free surface where there is one

  // Nearest periodic image of a separation vector. Valid for separations of positions unwrapped by any number of periods.
  Vec3 minimum_image(Vec3 d) const {
    d.x() = nearest(d.x(), width_x);
    d.y() = nearest(d.y(), width_y);
    return d;
  }
  // The image of a position inside [0, width).
  Vec3 wrap(Vec3 p) const {
    p.x() -= width_x * std::floor(p.x() / width_x);
    p.y() -= width_y * std::floor(p.y() / width_y);
    return p;
  }
  double area() const { return width_x * width_y; }

 private:
  // Most separations are the nearest already, and rounding is a call.
  static double nearest(double d, double width) { return std::abs(d) <= 0.5 * width ? d : d - width * std::nearbyint(d / width); }
};

}  // namespace pigment
