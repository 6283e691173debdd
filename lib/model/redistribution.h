#pragma once
// How far a layer is from shrinking evenly: the mass displacement that is left at each height once the whole layer's shrinking
// is taken away. When it evens out the layer is immobile in the sense of section 4.2 of [sand2010]: particles still follow the
// surface, but solids no longer move from one height of the layer to another.
// The motion of single particles is no measure: in a layer that a surface presses together they keep giving way to each other,
// by more of the surface's fall the denser it is. Nor is the plain mean at a height: a layer 5 um wide holds so few large particles
// at each height that their giving way alone moves it by 1 % of the surface's fall, for as long as the layer is pressed. What chance
// would move is therefore taken off, as the quarters of the layer's area tell it: what is common to all of them is the layer's.
#include <deque>
#include <vector>

#include "base/vec.h"
#include "model/cell.h"

namespace pigment {

// What one interval between two frames adds.
struct Redistribution {
  std::vector<double> residual;  // um, one a slice: mean over its solid volume of dz - z dH/H
  std::vector<double> scatter;   // um, four a slice: what each quarter adds to that mean beyond its share; its squares sum to the mean's variance
  double fall = 0;               // um, -dH
  double height = 0;             // um, H before
};
inline constexpr int redistribution_slices = 10;
inline constexpr int redistribution_quarters = 4;  // of the area: they hold what moves together, 2 um wide, where more would not

// Positions in um; the cell has the height of the layer before, the last argument is the one after. Slices are equal in z/H (before).
Redistribution redistribution_between(const Vec3Array& before, const Vec3Array& after, const std::vector<double>& radius,
                                      const Cell& cell, double height_after);

// Root mean square over the slices of what the summed residuals would be in a layer of any width, over the summed fall: their mean
// square less the variance that the quarters' scatter gives them, 0 where that is the larger; 1 where the layer did not fall.
double redistribution_ratio(const std::deque<Redistribution>&);

// The intervals in which mass is watched: the last ones, as many as it takes for the layer to shrink by a given share of its height.
// A time would be another share of a thin layer's life than of a thick one's. Adds one interval and drops what is no longer
// needed; says whether the layer has shrunk that much.
bool add_to_window(std::deque<Redistribution>& window, Redistribution interval, double shrinkage);

}  // namespace pigment
