#include "model/redistribution.h"

#include <algorithm>
#include <cmath>

namespace pigment {

Redistribution redistribution_between(const Vec3Array& before, const Vec3Array& after, const std::vector<double>& radius,
                                      const Cell& cell, double height_after) {
  constexpr int slices = redistribution_slices, quarters = redistribution_quarters;
  Redistribution r{std::vector<double>(slices, 0.0), std::vector<double>(slices * quarters, 0.0), cell.height - height_after, cell.height};
  std::vector<double> volume(slices * quarters, 0.0);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const Vec3 p = cell.wrap(before[k]);
    const double share = std::pow(radius[k], 3);
    const int slice = std::clamp(static_cast<int>(std::floor(p.z() / cell.height * slices)), 0, slices - 1);
    const int quarter = (2 * p.x() < cell.width_x ? 0 : 1) + (2 * p.y() < cell.width_y ? 0 : 2);
    volume[slice * quarters + quarter] += share;
    r.scatter[slice * quarters + quarter] += share * (after[k].z() - p.z() + p.z() * r.fall / cell.height);
  }
  for (int b = 0; b < slices; ++b) {
    double moved = 0, whole = 0, squares = 0;
    for (int q = b * quarters; q < (b + 1) * quarters; ++q) {
      moved += r.scatter[q];
      whole += volume[q];
      squares += volume[q] * volume[q];
    }
    if (whole > 0) r.residual[b] = moved / whole;
    // Where a quarter with a share w of the slice's volume has a mean of variance s2/w, the slice's has s2, and the quarter's part in it,
    // w (its mean - the slice's), has the mean square s2 w (1 - w).
    const double freedom = whole * whole - squares;
    for (int q = b * quarters; q < (b + 1) * quarters; ++q)
      r.scatter[q] = freedom > 0 ? (r.scatter[q] - volume[q] * r.residual[b]) / std::sqrt(freedom) : 0;
  }
  return r;
}

double redistribution_ratio(const std::deque<Redistribution>& intervals) {
  constexpr int slices = redistribution_slices, quarters = redistribution_quarters;
  std::vector<double> sum(slices, 0.0), scatter(slices * quarters, 0.0);
  double fall = 0;
  for (const Redistribution& r : intervals) {
    fall += r.fall;
    for (int b = 0; b < slices; ++b) sum[b] += r.residual[b];
    for (int q = 0; q < slices * quarters; ++q) scatter[q] += r.scatter[q];
  }
  if (!(fall > 0)) return 1;
  double square = 0;
  for (double s : sum) square += s * s;
  for (double s : scatter) square -= s * s;
  return std::sqrt(std::max(square, 0.0) / slices) / fall;
}

bool add_to_window(std::deque<Redistribution>& window, Redistribution interval, double shrinkage) {
  window.push_back(std::move(interval));
  double fall = 0;
  for (const Redistribution& r : window) fall += r.fall;
  while (window.size() > 1 && fall - window.front().fall >= shrinkage * window[1].height) {
    fall -= window.front().fall;
    window.pop_front();
  }
  return fall >= shrinkage * window.front().height;
}

}  // namespace pigment
