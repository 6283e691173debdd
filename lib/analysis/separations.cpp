#include "analysis/separations.h"

#include <cmath>

#include "analysis/histogram.h"
#include "analysis/radial_distribution.h"
#include "neighbours/pair_search.h"

namespace pigment::analysis {

namespace {

Separations separations_of(const Snapshot& frame, const std::vector<double>& radius, double limit,
                           std::size_t bins, double near_limit, std::size_t near_bins) {
  Separations result;
  result.time = frame.time;
  result.smallest = limit;
  Histogram all(limit, bins), near(near_limit, near_bins);
  double sum = 0, near_overlaps = 0;
  for (const auto& [a, b] : neighbours::find_pairs(frame.cell, frame.position, radius,
                                                   {.at_least = std::max(limit, near_limit)})) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const double gap =
        frame.cell.minimum_image(frame.position[j] - frame.position[i]).norm() - radius[i] - radius[j];
    const double separation = std::max(0.0, gap);
    if (gap <= limit) {
      ++result.pairs;
      if (gap < 0) ++result.overlaps;
      sum += separation;
      result.smallest = std::min(result.smallest, gap);
      all.add(separation);
    }
    if (gap <= near_limit) {
      ++result.near_pairs;
      if (gap < 0) near_overlaps += 1;
      near.add(separation);
    }
  }
  result.density = all.density(static_cast<double>(result.pairs));
  result.count = all.counts();
  if (result.pairs > 0) result.mean = sum / static_cast<double>(result.pairs);
  if (!radius.empty())
    result.neighbours_per_particle =
        2.0 * static_cast<double>(result.pairs) / static_cast<double>(radius.size());
  const double all_near = std::max(1.0, static_cast<double>(result.near_pairs));
  result.near_cumulative.push_back(near_overlaps / all_near);
  double below = 0;
  for (double n : near.counts()) result.near_cumulative.push_back((below += n) / all_near);
  return result;
}

double automatic_radial_limit(const Frames& frames, const std::vector<double>& radius) {
  if (frames.count == 0 || radius.empty()) return 1;
  const Cell cell = frames.read(0).cell;
  double mean = 0;
  for (const double a : radius) mean += 2 * a / static_cast<double>(radius.size());
  return std::min(3 * mean, 0.5 * std::min(cell.width_x, cell.width_y));
}

}  // namespace

SeparationDevelopment measure_separations(const Frames& frames, const std::vector<double>& radius,
                                          const Parameters& parameters) {
  SeparationDevelopment result;
  const double smallest = radius.empty() ? 0.5 : *std::min_element(radius.begin(), radius.end());
  result.limit = parameters.separation_limit.value_or(2 * smallest);
  const auto bins = static_cast<std::size_t>(parameters.separation_bins);
  const auto near_bins = static_cast<std::size_t>(parameters.near_separation_bins);
  result.edges = equal_bins(result.limit, bins);
  result.near_edges = equal_bins(parameters.near_separation_limit, near_bins);
  const double radial_limit = parameters.radial_limit.value_or(automatic_radial_limit(frames, radius));
  const auto radial_bins = static_cast<std::size_t>(parameters.radial_bins);
  result.radial_edges = equal_bins(radial_limit, radial_bins);
  result.frames = measure_frames(frames, [&](const Snapshot& frame) {
    Separations of =
        separations_of(frame, radius, result.limit, bins, parameters.near_separation_limit, near_bins);
    of.radial = radial_distribution(frame, radial_limit, radial_bins);
    return of;
  });
  return result;
}

}  // namespace pigment::analysis
