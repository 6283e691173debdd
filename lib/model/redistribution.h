#pragma once
// How far a layer is from shrinking evenly: the mass displacement that is left at each height once the whole layer's shrinking
// is taken away. When it evens out the layer is immobile in the sense of section 4.2 of [sand2010]: particles still follow the
// surface, but solids no longer move from one height of the layer to another.
// The motion of single particles is no measure: in a layer that a surface presses together they keep giving way to each other,
// by more of the surface's fall the denser it is. Nor is the plain mean square at the heights: a layer 5 um wide holds so few large
// particles at each height that their giving way alone moves it by 1 to 3 % of the surface's fall, for as long as the layer is pressed.
// But what gives way in one half of a window has no memory in the other, while what still redistributes goes on: the product of the two
// halves has the layer's redistribution as its mean, whatever its width.
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

// Positions and heights of the layer in um. Slices are equal in z/H (before).
Redistribution redistribution_between(const Vec3Array& before, const Vec3Array& after, const std::vector<double>& radius,
                                      double height_before, double height_after);

// The intervals in which mass is watched: the last ones, as many as it takes for the layer to shrink by one and a half times a given
// share of its height. A time would be another share of a thin layer's life than of a thick one's. Adds one interval and drops
// what is no longer needed; says whether the layer has shrunk that much.
bool add_to_window(std::deque<Redistribution>& window, Redistribution interval, double shrinkage);

// Of a window in which the layer shrinks by the given share (two intervals at least), the product of what its halves moved at a height
// for each um of fall, averaged over the slices; of that the mean over the windows that end while the layer shrinks by the last half
// of the share, as one alone scatters; its root. 0 where the mean is negative, which takes halves that move against each other;
// 1 where there are not two intervals or the layer did not fall in each half.
double redistribution_ratio(const std::deque<Redistribution>&, double shrinkage);

}  // namespace pigment
