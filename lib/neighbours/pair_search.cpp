#include "neighbours/pair_search.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"

namespace pigment::neighbours {
namespace {

// Waking threads for fewer takes longer than the search.
constexpr std::size_t worth_threads = 2000;

// The cells that one search visits along one direction: `count` of them from `first`, wrapped where periodic.
struct Span {
  std::int64_t first = 0, count = 0;
};

// The particles of one size class in a grid of cells about as wide as a search among them reaches. Positions
// are wrapped in x and y, and sorted by cell.
class LevelGrid {
 public:
  double largest_radius = 0;

  LevelGrid(const Cell& cell, const Vec3Array& wrapped, const std::vector<double>& radius,
            std::vector<std::int32_t> members, double reach)
      : period_{cell.width_x, cell.width_y}, members_(std::move(members)) {
    double top = -std::numeric_limits<double>::infinity();
    bottom_ = -top;
    for (const auto i : members_) {
      largest_radius = std::max(largest_radius, radius[i]);
      bottom_ = std::min(bottom_, wrapped[i].z());
      top = std::max(top, wrapped[i].z());
    }
    // A few large spheres, or one far away, must not cost a cell for every empty place.
    const double depth = top - bottom_, most_cells = 4.0 * static_cast<double>(members_.size()) + 8;
    double edge = reach;
    while (cells(period_[0], edge) * cells(period_[1], edge) * cells(depth, edge) > most_cells) edge *= 1.25;
    count_[0] = static_cast<std::int64_t>(cells(period_[0], edge));
    count_[1] = static_cast<std::int64_t>(cells(period_[1], edge));
    count_[2] = static_cast<std::int64_t>(cells(depth, edge));
    edge_[0] = period_[0] / static_cast<double>(count_[0]);
    edge_[1] = period_[1] / static_cast<double>(count_[1]);
    edge_[2] = std::max(depth / static_cast<double>(count_[2]), std::numeric_limits<double>::min());
    sort_by_cell(wrapped);
  }

  // Calls visit(j) for every member whose centre is within `reach` of p in each direction, and some others.
  template <typename Visit>
  void near(const Vec3& p, double reach, Visit&& visit) const {
    const Span x = periodic_span(p.x(), reach, 0), y = periodic_span(p.y(), reach, 1),
               z = open_span(p.z(), reach);
    for (std::int64_t dx = 0; dx < x.count; ++dx) {
      const std::int64_t cx = (x.first + dx) % count_[0];
      for (std::int64_t dy = 0; dy < y.count; ++dy) {
        // z runs fastest, so the cells of one column are one stretch of members.
        const std::int64_t column = (cx * count_[1] + (y.first + dy) % count_[1]) * count_[2] + z.first;
        for (auto m = begin_[column]; m < begin_[column + z.count]; ++m) visit(members_[m]);
      }
    }
  }

 private:
  static double cells(double length, double edge) { return std::max(1.0, std::floor(length / edge)); }

  std::int64_t along(double coordinate, int axis) const {
    const double c = std::floor(coordinate / edge_[axis]);
    return static_cast<std::int64_t>(std::clamp(c, 0.0, static_cast<double>(count_[axis] - 1)));
  }
  Span periodic_span(double coordinate, double reach, int axis) const {
    const double n = static_cast<double>(count_[axis]);
    const double low = std::floor((coordinate - reach) / edge_[axis]),
                 high = std::floor((coordinate + reach) / edge_[axis]);
    // All the way round: every cell once, so that no pair is met twice.
    if (high - low + 1 >= n) return {0, count_[axis]};
    return {static_cast<std::int64_t>(low - n * std::floor(low / n)),
            static_cast<std::int64_t>(high - low + 1)};
  }
  Span open_span(double z, double reach) const {
    const std::int64_t low = along(z - reach - bottom_, 2), high = along(z + reach - bottom_, 2);
    return {low, high - low + 1};
  }
  void sort_by_cell(const Vec3Array& wrapped) {
    std::vector<std::int64_t> cell_of(members_.size());
    begin_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
    for (std::size_t m = 0; m < members_.size(); ++m) {
      const Vec3& p = wrapped[members_[m]];
      cell_of[m] = (along(p.x(), 0) * count_[1] + along(p.y(), 1)) * count_[2] + along(p.z() - bottom_, 2);
      ++begin_[cell_of[m] + 1];
    }
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    std::vector<std::int64_t> next(begin_.begin(), begin_.end() - 1);
    std::vector<std::int32_t> sorted(members_.size());
    for (std::size_t m = 0; m < members_.size(); ++m) sorted[next[cell_of[m]]++] = members_[m];
    members_.swap(sorted);
  }

  double period_[2], bottom_ = 0, edge_[3] = {};
  std::int64_t count_[3] = {};
  std::vector<std::int32_t> members_;
  std::vector<std::int64_t> begin_;  // of each cell, in members_
};

// Size class of a radius: class k holds radii from 2^k to 2^(k+1) times the smallest.
int size_class(double radius, double smallest) { return std::max(0, std::ilogb(radius / smallest)); }

std::vector<LevelGrid> sort_into_levels(const Cell& cell, const Vec3Array& wrapped,
                                        const std::vector<double>& radius, const PairRange& range,
                                        std::vector<int>& level_of) {
  const double smallest = *std::min_element(radius.begin(), radius.end());
  std::vector<std::vector<std::int32_t>> members;
  level_of.resize(radius.size());
  for (std::size_t i = 0; i < radius.size(); ++i) {
    level_of[i] = size_class(radius[i], smallest);
    if (members.size() <= static_cast<std::size_t>(level_of[i])) members.resize(level_of[i] + 1);
    members[level_of[i]].push_back(static_cast<std::int32_t>(i));
  }
  // Classes without members are left out; what remains keeps its order.
  std::vector<int> kept(members.size(), 0);
  std::vector<LevelGrid> levels;
  for (std::size_t k = 0; k < members.size(); ++k) {
    kept[k] = static_cast<int>(levels.size());
    if (members[k].empty()) continue;
    double largest = 0;
    for (const auto i : members[k]) largest = std::max(largest, radius[i]);
    const double reach = 2 * largest + range.limit(largest, largest);
    levels.emplace_back(cell, wrapped, radius, std::move(members[k]), reach);
  }
  for (int& level : level_of) level = kept[level];
  return levels;
}

// Sorted by i, then j, whatever order the threads found them in.
std::vector<IndexPair> sort_pairs(const std::vector<std::vector<IndexPair>>& found,
                                  std::size_t particle_count) {
  std::vector<std::int64_t> begin(particle_count + 1, 0);
  for (const auto& part : found)
    for (const IndexPair& p : part) ++begin[p.i + 1];
  for (std::size_t i = 0; i < particle_count; ++i) begin[i + 1] += begin[i];
  std::vector<IndexPair> pairs(static_cast<std::size_t>(begin.back()));
  std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
  for (const auto& part : found)
    for (const IndexPair& p : part) pairs[next[p.i]++] = p;
#pragma omp parallel for schedule(static) if (particle_count > worth_threads)
  for (std::size_t i = 0; i < particle_count; ++i)
    std::sort(pairs.begin() + begin[i], pairs.begin() + begin[i + 1],
              [](const IndexPair& a, const IndexPair& b) { return a.j < b.j; });
  return pairs;
}

}  // namespace

std::vector<IndexPair> find_pairs(const Cell& cell, const Vec3Array& position,
                                  const std::vector<double>& radius, const PairRange& range) {
  assert(position.size() == radius.size());
  const std::size_t n = position.size();
  if (n < 2) return {};
  Vec3Array wrapped(n);
  double farthest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!position[i].allFinite())
      throw NumericsError("the position of particle " + std::to_string(i) + " is not a finite number");
    wrapped[i] = cell.wrap(position[i]);
    farthest = std::max(farthest, position[i].cwiseAbs().maxCoeff());
  }
  // Wrapping rounds; searches reach that much farther, while the decision below sees the positions as given.
  const double rounding =
      16 * std::numeric_limits<double>::epsilon() * (farthest + cell.width_x + cell.width_y);

  std::vector<int> level_of;
  const std::vector<LevelGrid> levels = sort_into_levels(cell, wrapped, radius, range, level_of);

  // Each particle looks for partners of its own size class (with a larger index) and of all coarser classes:
  // a pair is found from its smaller member, which bounds the reach, and once.
  constexpr std::int64_t chunk = 256;
  const std::int64_t chunks = (static_cast<std::int64_t>(n) + chunk - 1) / chunk;
  std::vector<std::vector<IndexPair>> found(static_cast<std::size_t>(chunks));
#pragma omp parallel for schedule(dynamic) if (n > worth_threads)
  for (std::int64_t c = 0; c < chunks; ++c) {
    const std::int64_t end = std::min((c + 1) * chunk, static_cast<std::int64_t>(n));
    for (std::int64_t k = c * chunk; k < end; ++k) {
      const auto i = static_cast<std::int32_t>(k);
      for (std::size_t level = level_of[i]; level < levels.size(); ++level) {
        const bool own_level = level == static_cast<std::size_t>(level_of[i]);
        // In its own class the partner may be the smaller one: the limit grows with the smaller radius, so
        // the class's largest radius bounds it.
        const double largest = levels[level].largest_radius;
        const double reach = radius[i] + largest + range.limit(radius[i], largest) + rounding;
        levels[level].near(wrapped[i], reach, [&](std::int32_t j) {
          if (own_level && j <= i) return;
          const double distance_limit = radius[i] + radius[j] + range.limit(radius[i], radius[j]);
          // squaredNorm, so that the same pair is decided alike from either side
          if (cell.minimum_image(position[j] - position[i]).squaredNorm() < distance_limit * distance_limit)
            found[c].push_back({std::min(i, j), std::max(i, j)});
        });
      }
    }
  }
  return sort_pairs(found, n);
}

}  // namespace pigment::neighbours
