#include "model/redistribution.h"

#include <algorithm>
#include <cmath>

namespace pigment {

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

double redistribution_ratio(const std::deque<Redistribution>& intervals) {
  std::vector<double> sum(redistribution_slices, 0.0);
  double fall = 0;
  for (const Redistribution& r : intervals) {
    fall += r.fall;
    for (int b = 0; b < redistribution_slices; ++b) sum[b] += r.residual[b];
  }
  if (!(fall > 0)) return 1;
  double square = 0;
  for (double s : sum) square += s * s;
  return std::sqrt(square / redistribution_slices) / fall;
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
