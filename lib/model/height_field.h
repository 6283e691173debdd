#pragma once
// A substrate that is not flat: a height over x and y, periodic with the cell.
// The bicubic spline through a map's heights, periodic and twice continuously differentiable [unser1999]. Whole numbers of the map's
// periods fill the cell, as many as come nearest, at least one: the width of a layer follows from its solids, so the map is stretched
// a little along x and y. Heights are not.
#include <cstddef>
#include <vector>

#include "base/vec.h"
#include "model/cell.h"
#include "model/height_map.h"

namespace pigment {

class HeightField {
 public:
  HeightField(HeightMap, const Cell&);

  double height(double x, double y) const;  // um
  double lowest() const { return lowest_; }  // um, the surface's deepest point,
  double crest() const { return crest_; }    // its highest
  double mean_height() const { return mean_; }
  // Volume over area (um) between the surface and the plane z above it: z - mean_height above the crests, 0 below the deepest point.
  // Between them a sum over twice as many points along x and y as the map has.
  double space_below(double z) const;
  // The map with its periods fitted to the cell: it gives the same field again.
  const HeightMap& map() const { return map_; }

  // A point of the surface whose distance from a given point is least among its neighbours.
  struct Foot {
    double x, y;       // where, um, unwrapped as the given point is
    Vec3 normal;       // of the surface there, out of the substrate
    double distance;   // um; negative where the given point lies inside the substrate
    double curvature, least_curvature;  // 1/um, the principal ones, positive where the surface is convex
  };
  // All of them no farther than reach (um), in fixed order. A point inside the substrate has the nearest only, however
  // far it is.
  std::vector<Foot> feet(const Vec3& point, double reach) const;
  // The one that foot becomes for a point nearby.
  Foot follow(const Foot&, const Vec3& point) const;
  // Smallest distance of a sphere from the surface, um, negative where they overlap; infinite beyond reach.
  double gap(const Vec3& centre, double radius, double reach) const;
  // Spacing of the samples among which feet are sought, um, along the coarser axis.
  double resolution() const;

 private:
  struct Local {
    double z, gx, gy, hxx, hxy, hyy;  // height, gradient, second derivatives
  };
  Local local(double x, double y) const;
  double half_squared_distance(double x, double y, const Vec3& point) const;
  Foot descend(double x, double y, const Vec3& point) const;
  double extremum(std::size_t at_sample) const;

  HeightMap map_;
  std::vector<double> coefficient_;         // of the spline, as map_.height
  std::size_t samples_x_ = 0, samples_y_ = 0;  // of one period
  double step_x_ = 0, step_y_ = 0;          // between them, um
  std::vector<double> sample_;              // heights, [i * samples_y + j]
  std::vector<double> sorted_, sum_;        // the same, rising; and their sums up to each
  double lowest_ = 0, crest_ = 0, mean_ = 0;
};

}  // namespace pigment
