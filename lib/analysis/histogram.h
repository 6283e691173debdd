#pragma once
// Counts in equal bins from 0 to a limit.
#include <algorithm>
#include <cmath>
#include <vector>

namespace pigment::analysis {

// bins + 1 edges from 0 to limit.
inline std::vector<double> equal_bins(double limit, std::size_t bins) {
  std::vector<double> edges(bins + 1);
  for (std::size_t k = 0; k <= bins; ++k)
    edges[k] = limit * static_cast<double>(k) / static_cast<double>(bins);
  return edges;
}

class Histogram {
 public:
  Histogram(double limit, std::size_t bins) : limit_(limit), counts_(bins, 0.0) {}

  // Bin k holds edge k <= value < edge k+1, the last one its upper edge too; other values are left out.
  void add(double value, double weight = 1) {
    if (!(value >= 0 && value <= limit_)) return;
    const double bin = std::floor(value / limit_ * static_cast<double>(counts_.size()));
    counts_[std::min(counts_.size() - 1, static_cast<std::size_t>(bin))] += weight;
  }
  const std::vector<double>& counts() const { return counts_; }
  // Counts over total and bin width: integrates to the share of `total` that the bins hold. All 0 where total
  // is 0.
  std::vector<double> density(double total) const {
    std::vector<double> result(counts_);
    const double width = limit_ / static_cast<double>(counts_.size());
    for (double& n : result) n = total > 0 ? n / (total * width) : 0.0;
    return result;
  }

 private:
  double limit_;
  std::vector<double> counts_;
};

}  // namespace pigment::analysis
