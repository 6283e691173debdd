#pragma once
// A substrate that is not flat: a height over x and y, periodic with the cell.
//   z = A (2 + cos(2 pi n_x x/L_x) + cos(2 pi n_y y/L_y))/4,   0 <= z <= A,
// with whole numbers of periods n = L/wavelength, rounded, at least one: the width of a layer follows from its solids, so the wavelength
// is met as nearly as the cell allows.
#include <vector>

#include "base/vec.h"
#include "config/node.h"
#include "model/cell.h"

namespace pigment {

struct Roughness {
  double amplitude = 0;   // um, from the deepest point to the crests
  double wavelength = 0;  // um, along x and along y
  double crest() const { return amplitude; }
  double mean_height() const { return 0.5 * amplitude; }
};
// Keys: amplitude, wavelength.
Roughness read_roughness(config::Node);

class HeightField {
 public:
  HeightField(const Roughness&, const Cell&);

  double crest() const { return amplitude_; }
  double mean_height() const { return 0.5 * amplitude_; }
  double height(double x, double y) const;
  double resolution() const { return step_x_ < step_y_ ? step_x_ : step_y_; }  // feet nearer than this are one, um

  // A point of the surface whose distance from a given point is least among its neighbours.
  struct Foot {
    double x, y;       // where, um, unwrapped as the given point is
    Vec3 normal;       // of the surface there, out of the substrate
    double distance;   // um; negative where the given point lies inside the substrate
    double curvature;  // 1/um, the larger principal one, positive where the surface is convex
  };
  // All of them no farther than reach (um), in fixed order. A point inside the substrate has the nearest only.
  std::vector<Foot> feet(const Vec3& point, double reach) const;
  // The one that foot becomes for a point nearby.
  Foot follow(const Foot&, const Vec3& point) const;

 private:
  struct Local {
    double z, gx, gy, hxx, hyy;  // height, gradient, second derivatives (the mixed one is zero)
  };
  Local local(double x, double y) const;
  double half_squared_distance(double x, double y, const Vec3& point) const;
  Foot descend(double x, double y, const Vec3& point) const;

  double amplitude_ = 0, wave_x_ = 0, wave_y_ = 0;  // um, 1/um, 1/um
  double step_x_ = 0, step_y_ = 0;                  // of the samples among which feet are sought, um
};

}  // namespace pigment
