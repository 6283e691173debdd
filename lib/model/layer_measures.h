#pragma once
// What a layer of spheres measures as a whole: solid volume, mass centre, heights below which a share of the
// solids lies, solids in horizontal slices, what sticks out of the surface, the motion that is left over when
// the mean motion at each height is taken away. Exact for spheres, O(N) or O(N log N), and the same bits at
// any thread count. Radii and positions are arrays of one length, one entry a particle; heights in um above
// the substrate.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/vec.h"
#include "model/particles.h"

namespace pigment {

// um^3.
double solids_volume(const std::vector<double>& radius);

// Mean height weighted by `weight` (mass where there is one), um; by sphere volume where weight is empty or
// sums to 0. 0 without particles.
double mass_centre(const Vec3Array& position, const std::vector<double>& radius,
                   const std::vector<double>& weight = {});
inline double mass_centre(const Layer& layer) {
  return mass_centre(layer.position, layer.particles.radius, layer.particles.mass);
}

// The height below which this share (0..1) of the solid volume lies, um: 0.95 gives z95, 0.99 gives z99. To
// rounding; 0 without particles. share 0 and 1 give the lowest and the highest point of any sphere.
double height_below_which(double share, const Vec3Array& position, const std::vector<double>& radius);

// Share of the solid volume above z = height (the free surface): the protruding volume fraction.
double protruding_fraction(double height, const Vec3Array& position, const std::vector<double>& radius);

// Solid volume between successive planes, um^3, size edges.size() - 1; edges rise. Spheres cut by a plane are
// shared exactly, so the sum is the solid volume between the outermost planes.
std::vector<double> slice_volumes(const std::vector<double>& edges, const Vec3Array& position,
                                  const std::vector<double>& radius);

// slices + 1 equally spaced planes from 0 to height.
std::vector<double> equal_slices(double height, int slices);

// Columns of equal section that fill a cell's area.
struct ColumnGrid {
  std::size_t x = 0, y = 0;
  std::size_t count() const { return x * y; }
};
// Of about `column` um, a whole number in each width.
ColumnGrid columns_of(const Cell&, double column);

// The highest point at which each column's axis meets a sphere, um, [x * grid.y + y]; an axis that meets none has 0,
// the substrate.
std::vector<double> top_of_columns(const Cell&, const Vec3Array& position, const std::vector<double>& radius,
                                   const ColumnGrid&);

struct Spread {
  double mean = 0, deviation = 0;  // standard deviation over all of them
};
Spread spread_of(const std::vector<double>& values);  // zeros without any

// Mean of the top over columns of about `column` um.
double top_envelope(const Cell&, const Vec3Array& position, const std::vector<double>& radius,
                    double column = 0.25);

// Non-affine vertical motion: root mean square of value - (its straight line in z within each of `slices`
// equal slices of [0, height]). `value` is one number a particle, a velocity or a displacement; the result
// has its unit. The straight line, not only the mean, since a layer that shrinks evenly has a velocity that
// grows with z. Divided by the degrees of freedom left. Empty where no slice holds more particles than its
// line takes (three or more): nothing to judge.
struct NonAffineMotion {
  double rms = 0;
  long degrees_of_freedom = 0;  // 0: too few particles to judge, rms says nothing
};
NonAffineMotion non_affine_motion(const Vec3Array& position, const std::vector<double>& value, double height,
                                  int slices);

// As many slices as leave each some 50 particles, 1 to 30.
inline int non_affine_slices(std::size_t particles) {
  return static_cast<int>(std::clamp<std::size_t>(particles / 50, 1, 30));
}

}  // namespace pigment
