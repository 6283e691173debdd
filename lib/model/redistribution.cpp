#include "model/redistribution.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pigment {

namespace {

// The first of the intervals, two at least, up to and with `last` in which the layer shrinks by a share of its height; 0 where all are too few.
std::size_t window_start(const std::deque<Redistribution>& intervals, std::size_t last, double shrinkage) {
  double fall = intervals[last].fall;
  for (std::size_t k = last; k-- > 0;) {
    fall += intervals[k].fall;
    if (fall >= shrinkage * intervals[k].height) return k;
  }
  return 0;
}

// Mean over the slices of the product of what two halves of a window, [first, last], moved for each um of fall. None where a half is missing.
std::optional<double> product_of_halves(const std::deque<Redistribution>& intervals, std::size_t first, std::size_t last) {
  double fall = 0;
  for (std::size_t k = first; k <= last; ++k) fall += intervals[k].fall;
  double fallen = 0;
  std::size_t middle = first;  // of the second half, as near to half of the fall as intervals allow
  while (middle < last && (middle == first || std::abs(fallen + intervals[middle].fall - fall / 2) < std::abs(fallen - fall / 2)))
    fallen += intervals[middle++].fall;
  if (!(fallen > 0) || !(fall - fallen > 0)) return {};
  double product = 0;
  for (int b = 0; b < redistribution_slices; ++b) {
    double early = 0, late = 0;
    for (std::size_t k = first; k <= last; ++k) (k < middle ? early : late) += intervals[k].residual[b];
    product += early * late;
  }
  return product / (redistribution_slices * fallen * (fall - fallen));
}

}  // namespace

Redistribution redistribution_between(const Vec3Array& before, const Vec3Array& after, const std::vector<double>& radius,
                                      double height_before, double height_after) {
  constexpr int n = redistribution_slices;
  Redistribution r{std::vector<double>(n, 0.0), height_before - height_after, height_before};
  std::vector<double> volume(n, 0.0);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double z = before[k].z(), share = std::pow(radius[k], 3);
    const int b = std::clamp(static_cast<int>(std::floor(z / height_before * n)), 0, n - 1);
    volume[b] += share;
    r.residual[b] += share * (after[k].z() - z + z * r.fall / height_before);
  }
  for (int b = 0; b < n; ++b) r.residual[b] = volume[b] > 0 ? r.residual[b] / volume[b] : 0;
  return r;
}

bool add_to_window(std::deque<Redistribution>& window, Redistribution interval, double shrinkage) {
  window.push_back(std::move(interval));
  double fall = 0;
  for (const Redistribution& r : window) fall += r.fall;
  while (window.size() > 2 && fall - window.front().fall >= 1.5 * shrinkage * window[1].height) {
    fall -= window.front().fall;
    window.pop_front();
  }
  return window.size() > 1 && fall >= 1.5 * shrinkage * window.front().height;
}

double redistribution_ratio(const std::deque<Redistribution>& intervals, double shrinkage) {
  double sum = 0, fall = 0;
  for (std::size_t last = intervals.size(); last-- > 1;) {
    if (fall > 0 && fall >= shrinkage / 2 * intervals[last].height) break;
    const std::optional<double> product = product_of_halves(intervals, window_start(intervals, last, shrinkage), last);
    if (!product) break;
    fall += intervals[last].fall;
    sum += *product * intervals[last].fall;
  }
  return fall > 0 ? std::sqrt(std::max(sum / fall, 0.0)) : 1;
}

}  // namespace pigment
