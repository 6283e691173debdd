#include "analysis/clusters.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "model/particles.h"
#include "neighbours/pair_search.h"

namespace pigment::analysis {

namespace {

// Disjoint sets of indices with path halving and union by size.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count), size_(count, 1) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    i = root(i);
    j = root(j);
    if (i == j) return;
    if (size_[i] < size_[j]) std::swap(i, j);
    parent_[j] = i;
    size_[i] += size_[j];
  }
  std::int64_t size(std::size_t root) const { return size_[root]; }

 private:
  std::vector<std::size_t> parent_;
  std::vector<std::int64_t> size_;
};

// in_cake(particle): whether it belongs to the filter cake.
template <typename InCake>
void measure_cake(Clusters& result, const Snapshot& frame, const std::vector<double>& radius,
                  const ColumnGrid& columns, const InCake& in_cake) {
  Vec3Array position;
  std::vector<double> cake_radius;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    if (!in_cake(i)) continue;
    position.push_back(frame.position[i]);
    cake_radius.push_back(radius[i]);
  }
  result.cake_height = top_of_columns(frame.cell, position, cake_radius, columns);
  const Spread spread = spread_of(result.cake_height);
  result.mean_cake_height = spread.mean;
  result.cake_roughness = spread.deviation;
}

}  // namespace

Clusters find_clusters(const Snapshot& frame, const std::vector<double>& radius,
                       const std::vector<std::int64_t>& id, double threshold, const ColumnGrid& columns) {
  const std::size_t particles = frame.position.size();
  Clusters result;
  result.time = frame.time;
  result.neighbours.assign(particles, 0);
  DisjointSets sets(particles);
  for (const auto& [a, b] :
       neighbours::find_pairs(frame.cell, frame.position, radius, {.at_least = threshold})) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    sets.join(i, j);
    ++result.neighbours[i];
    ++result.neighbours[j];
    ++result.connections;
    const double distance = frame.cell.minimum_image(frame.position[j] - frame.position[i]).norm();
    result.pairs.push_back({a, b, distance - radius[i] - radius[j]});
  }

  // What a cluster has in common, kept at its root.
  struct Common {
    std::int64_t id = std::numeric_limits<std::int64_t>::max();
    double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  };
  std::vector<Common> common(particles);
  for (std::size_t i = 0; i < particles; ++i) {
    Common& of = common[sets.root(i)];
    of.id = std::min(of.id, id[i]);
    of.bottom = std::min(of.bottom, frame.position[i].z() - radius[i]);
    of.top = std::max(of.top, frame.position[i].z() + radius[i]);
  }

  std::int64_t clustered = 0;
  double clustered_volume = 0, volume = 0;
  for (std::size_t i = 0; i < particles; ++i) {
    const std::size_t root = sets.root(i);
    const std::int64_t size = sets.size(root);
    const Common& of = common[root];
    result.id.push_back(of.id);
    result.size.push_back(size);
    result.extent.push_back(of.top - of.bottom);
    result.largest = std::max(result.largest, size);
    const double sphere = Particles::sphere_volume(radius[i]);
    volume += sphere;
    if (size < 2) continue;
    ++clustered;
    clustered_volume += sphere;
    if (root == i) ++result.count;
    result.largest_extent = std::max(result.largest_extent, of.top - of.bottom);
    if (of.bottom <= threshold && frame.cell.height - of.top <= threshold) result.percolates = true;
  }
  for (const std::int64_t n : result.neighbours) {
    const auto k = static_cast<std::size_t>(n);
    if (result.coordination.size() <= k) result.coordination.resize(k + 1, 0);
    ++result.coordination[k];
  }
  if (columns.count() > 0)
    measure_cake(result, frame, radius, columns,
                 [&](std::size_t i) { return common[sets.root(i)].bottom <= threshold; });
  if (particles > 0) {
    result.mean_coordination = 2.0 * static_cast<double>(result.connections) / static_cast<double>(particles);
    result.clustered_fraction = static_cast<double>(clustered) / static_cast<double>(particles);
    result.largest_fraction = static_cast<double>(result.largest) / static_cast<double>(particles);
    result.clustered_volume_fraction = clustered_volume / volume;
  }
  return result;
}

std::vector<Clusters> find_clusters(const Frames& frames, const std::vector<double>& radius,
                                    const std::vector<std::int64_t>& id, double threshold,
                                    const ColumnGrid& columns) {
  return measure_frames(
      frames, [&](const Snapshot& frame) { return find_clusters(frame, radius, id, threshold, columns); });
}

std::optional<double> percolation_time(const std::vector<Clusters>& frames) {
  const auto first = std::find_if(frames.begin(), frames.end(), [](const Clusters& c) { return c.percolates; });
  if (first == frames.end()) return std::nullopt;
  return first->time;
}

}  // namespace pigment::analysis
