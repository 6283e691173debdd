#pragma once
// How far a layer is from shrinking evenly: the mass displacement that is left at each height once the whole layer's shrinking
// is taken away. When it evens out the layer is immobile in the sense of section 4.2 of [sand2010]: particles still follow the
// surface, but solids no longer move from one height of the layer to another.
// The motion of single particles is no measure: in a layer that a surface presses together they keep giving way to each other,
// by more of the surface's fall the denser it is.
#include <deque>
#include <vector>

#include "base/vec.h"

namespace pigment {

// What one interval between two frames adds.
struct Redistribution {
  std::vector<double> residual;  // um, one a slice: mean over its solid volume of dz - z dH/H
  double fall = 0;               // um, -dH
  double height = 0;             // um, H before
};
inline constexpr int redistribution_slices = 10;

// Positions in um; heights of the layer before and after. Slices are equal in z/H (before).
Redistribution redistribution_between(const Vec3Array& before, const Vec3Array& after, const std::vector<double>& radius,
                                      double height_before, double height_after);

// Root mean square over the slices of the summed residuals, over the summed fall; 1 where the layer did not fall.
double redistribution_ratio(const std::deque<Redistribution>&);

// The intervals in which mass is watched: the last ones, as many as it takes for the layer to shrink by a given share of its height.
// A time would be another share of a thin layer's life than of a thick one's. Adds one interval and drops what is no longer
// needed; says whether the layer has shrunk that much.
bool add_to_window(std::deque<Redistribution>& window, Redistribution interval, double shrinkage);

}  // namespace pigment
