#include "stepping/stationary.h"

#include <algorithm>
#include <cmath>

namespace pigment::stepping {

namespace {

struct Mean {
  double value, variance;  // of the mean
};

Mean mean_of_blocks(const std::deque<double>& height, std::size_t begin, std::size_t count) {
  constexpr std::size_t blocks = 5;
  double sum = 0, square = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t from = begin + b * count / blocks, to = begin + (b + 1) * count / blocks;
    double mean = 0;
    for (std::size_t k = from; k < to; ++k) mean += height[k] / static_cast<double>(to - from);
    sum += mean;
    square += mean * mean;
  }
  const double mean = sum / blocks;
  return {mean, std::max(0.0, square / blocks - mean * mean) / (blocks - 1)};
}

}  // namespace

bool is_stationary(const std::deque<double>& height, std::size_t window, double tolerance) {
  if (height.size() < 2 * window) return false;
  const std::size_t middle = height.size() - window;
  const Mean before = mean_of_blocks(height, middle - window, window), after = mean_of_blocks(height, middle, window);
  return std::abs(after.value - before.value) + 2 * std::sqrt(before.variance + after.variance) < tolerance * after.value;
}

}  // namespace pigment::stepping
