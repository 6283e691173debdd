#pragma once
// Which pairs of spheres are near each other: a half list, found with one grid a size class, O(N) for any
// size ratio.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "model/cell.h"

namespace pigment::neighbours {

// A pair is listed when its surface gap is below max(per_smaller_radius * min(a_i, a_j), at_least) + skin.
struct PairRange {
  double per_smaller_radius = 0;  // 1; lubrication reaches as far as the smaller sphere lets it
  double at_least = 0;            // um; colloidal forces reach equally far for all sizes
  double skin = 0;                // um; how much gaps may shrink before the list must be made anew

  double limit(double radius_i, double radius_j) const {
    return std::max(per_smaller_radius * std::min(radius_i, radius_j), at_least) + skin;
  }
};

struct IndexPair {
  std::int32_t i, j;  // i < j
  bool operator==(const IndexPair&) const = default;
};

// All pairs in range, sorted by i, then j; the same list at any thread count. x and y are periodic and may be
// unwrapped by any number of periods, z is open. A pair is listed once, by its nearest image
// (Cell::minimum_image): its next image is never nearer than half a period, and is left out even where the
// range would reach it. Throws NumericsError for a position that is not finite.
std::vector<IndexPair> find_pairs(const Cell&, const Vec3Array& position, const std::vector<double>& radius,
                                  const PairRange&);

}  // namespace pigment::neighbours
