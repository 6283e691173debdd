#include "analysis/mobility.h"

#include <algorithm>
#include <cmath>

#include "analysis/histogram.h"
#include "model/layer_measures.h"

namespace pigment::analysis {

namespace {

// Gathers the displacements of one group of particles.
class Group {
 public:
  Group(double limit, std::size_t bins)
      : absolute_(limit, bins), vertical_(limit, bins), lateral_(limit, bins) {}

  void add(const Vec3& d) {
    particles_ += 1;
    absolute_.add(d.norm());
    vertical_.add(std::abs(d.z()));
    lateral_.add(std::abs(d.x()), 0.5);
    lateral_.add(std::abs(d.y()), 0.5);
    sum_absolute_ += d.norm();
    sum_vertical_ += d.z();
    squares_vertical_ += d.z() * d.z();
    squares_lateral_ += 0.5 * (d.x() * d.x() + d.y() * d.y());
  }

  Displacements result() const {
    Displacements r;
    r.particles = particles_;
    r.absolute = absolute_.density(particles_);
    r.vertical = vertical_.density(particles_);
    r.lateral = lateral_.density(particles_);
    if (particles_ > 0) {
      r.mean_absolute = sum_absolute_ / particles_;
      r.mean_vertical = sum_vertical_ / particles_;
      r.rms_vertical = std::sqrt(squares_vertical_ / particles_);
      r.rms_lateral = std::sqrt(squares_lateral_ / particles_);
    }
    return r;
  }

 private:
  Histogram absolute_, vertical_, lateral_;
  double particles_ = 0, sum_absolute_ = 0, sum_vertical_ = 0, squares_vertical_ = 0, squares_lateral_ = 0;
};

MobilityInterval measure_interval(const Snapshot& before, const Snapshot& after,
                                  const std::vector<double>& radius, const Parameters& parameters,
                                  double limit) {
  const auto bins = static_cast<std::size_t>(parameters.displacement_bins);
  const auto bands = static_cast<std::size_t>(parameters.height_bands);
  const double height = before.cell.height;
  MobilityInterval result;
  result.start = before.time;
  result.end = after.time;
  result.thickness = height;
  result.band_edges = equal_slices(height, parameters.height_bands);
  const std::vector<Group> empty(bands + 1, Group(limit, bins));
  std::vector<std::vector<Group>> by_size(parameters.size_class_count(), empty);
  std::vector<Group> all = empty;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const Vec3 d = after.position[i] - before.position[i];
    result.speed.push_back(d.norm() / (after.time - before.time));
    const std::size_t size = parameters.size_class(2 * radius[i]);
    const auto add = [&](std::size_t band) {
      by_size[size][band].add(d);
      all[band].add(d);
    };
    const double z = before.position[i].z(), depth = height - z;
    if (z <= height)
      add(std::min(bands - 1,
                   static_cast<std::size_t>(std::max(0.0, z / height * static_cast<double>(bands)))));
    if (depth >= parameters.surface_band[0] && depth <= parameters.surface_band[1]) add(bands);
  }
  for (const auto& groups : by_size) {
    result.by_size_and_height.emplace_back();
    for (const Group& group : groups) result.by_size_and_height.back().push_back(group.result());
  }
  for (const Group& group : all) result.all_sizes.push_back(group.result());
  return result;
}

}  // namespace

std::vector<std::size_t> choose_frames(const std::vector<double>& time, const Parameters& parameters) {
  // Times pass through units on the way from scene and file; allow for their last digits.
  const double slack = 1e-9 * (time.empty() ? 0.0 : std::abs(time.back()));
  std::vector<std::size_t> window;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] >= parameters.mobility_start - slack &&
        (!parameters.mobility_end || time[k] <= *parameters.mobility_end + slack))
      window.push_back(k);
  if (!parameters.mobility_interval || window.size() < 2) return window;
  // Each frame belongs to the nearest whole number of intervals (half-way: the lower one) that ends within
  // the window; of several the one closest to it is taken.
  const double last_multiple =
      std::floor((time[window.back()] - time[window[0]]) / *parameters.mobility_interval + 1e-9);
  std::vector<std::size_t> chosen{window.front()};
  double chosen_multiple = 0, chosen_miss = 0;
  for (std::size_t w = 1; w < window.size(); ++w) {
    const double intervals = (time[window[w]] - time[window[0]]) / *parameters.mobility_interval;
    const double multiple = std::min(last_multiple, std::ceil(intervals - 0.5 - 1e-9)),
                 miss = std::abs(intervals - multiple);
    if (multiple > chosen_multiple)
      chosen.push_back(window[w]);
    else if (multiple > 0 && miss < chosen_miss)
      chosen.back() = window[w];
    else
      continue;
    chosen_multiple = multiple;
    chosen_miss = miss;
  }
  return chosen;
}

Mobility measure_mobility(const Frames& frames, const std::vector<std::size_t>& numbers,
                          const std::vector<double>& radius, const Parameters& parameters) {
  Mobility result;
  double limit = parameters.displacement_limit.value_or(0.0);
  if (!parameters.displacement_limit) {
    const auto largest =
        measure_intervals(frames, numbers, [](const Snapshot& before, const Snapshot& after) {
          double square = 0;
          for (std::size_t i = 0; i < before.position.size(); ++i)
            square = std::max(square, (after.position[i] - before.position[i]).squaredNorm());
          return std::sqrt(square);
        });
    for (double d : largest) limit = std::max(limit, d);
    limit *= 1 + 1e-12;              // rounding between root of the sum of squares here and norm there
    if (!(limit > 0)) limit = 1e-3;  // nothing moved; any edges will do
  }
  result.edges = equal_bins(limit, static_cast<std::size_t>(parameters.displacement_bins));
  Frames kept = frames;
  Snapshot first, last;
  kept.read = [&](std::size_t k) {
    Snapshot frame = frames.read(k);
    if (k == numbers.front()) first = frame;
    if (k == numbers.back()) last = frame;
    return frame;
  };
  result.intervals = measure_intervals(kept, numbers, [&](const Snapshot& before, const Snapshot& after) {
    return measure_interval(before, after, radius, parameters, limit);
  });
  for (std::size_t i = 0; i < radius.size(); ++i) {
    result.displacement.push_back((last.position[i] - first.position[i]).norm());
    result.speed.push_back(result.displacement.back() / (last.time - first.time));
  }
  return result;
}

}  // namespace pigment::analysis
