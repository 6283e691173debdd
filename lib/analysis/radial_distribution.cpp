#include "analysis/radial_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/histogram.h"
#include "neighbours/pair_search.h"

namespace pigment::analysis {

namespace {

// Two particles at heights dz apart and anywhere in x and y are closer than r with the chance pi (r^2 - dz^2)/area, the
// disc that the sphere of radius r cuts out of the plane of the other, while it fits into the period. This is its sum
// over all pairs but for pi/area. Heights rise and are counted from their mean; sums of their powers before each.
class PairsByHeight {
 public:
  explicit PairsByHeight(const Vec3Array& position) {
    double mean = 0;
    for (const Vec3& p : position) mean += p.z() / static_cast<double>(position.size());
    for (const Vec3& p : position) height_.push_back(p.z() - mean);
    std::sort(height_.begin(), height_.end());
    sum_.assign(1, 0.0);
    squares_.assign(1, 0.0);
    for (const double z : height_) {
      sum_.push_back(sum_.back() + z);
      squares_.push_back(squares_.back() + z * z);
    }
  }
  double within(double r) const {
    double total = 0;
    std::size_t end = 0;
    for (std::size_t i = 0; i < height_.size(); ++i) {
      const double z = height_[i];
      while (end < height_.size() && height_[end] - z < r) ++end;
      const double n = static_cast<double>(end - i - 1), s = sum_[end] - sum_[i + 1];
      total += n * (r * r - z * z) + 2 * z * s - (squares_[end] - squares_[i + 1]);
    }
    return total;
  }

 private:
  std::vector<double> height_, sum_, squares_;
};

}  // namespace

std::vector<double> radial_distribution(const Snapshot& frame, double limit, std::size_t bins) {
  std::vector<double> result(bins, 0.0);
  if (frame.position.size() < 2) return result;
  // Centres closer than the limit are spheres of a quarter of it with gaps below a half of it.
  const std::vector<double> quarter(frame.position.size(), 0.25 * limit);
  Histogram found(limit, bins);
  for (const auto& [i, j] :
       neighbours::find_pairs(frame.cell, frame.position, quarter, {.at_least = 0.5 * limit}))
    found.add(frame.cell
                  .minimum_image(frame.position[static_cast<std::size_t>(j)] -
                                 frame.position[static_cast<std::size_t>(i)])
                  .norm());
  const PairsByHeight pairs(frame.position);
  const std::vector<double> edges = equal_bins(limit, bins);
  double below = 0;
  for (std::size_t k = 0; k < bins; ++k) {
    const double above = std::numbers::pi / frame.cell.area() * pairs.within(edges[k + 1]);
    if (above > below) result[k] = found.counts()[k] / (above - below);
    below = above;
  }
  return result;
}

}  // namespace pigment::analysis
