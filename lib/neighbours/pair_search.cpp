#include "neighbours/pair_search.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "neighbours/level_grid.h"

namespace pigment::neighbours {
namespace {

// Waking threads for fewer takes longer than the search.
constexpr std::size_t worth_threads = 500;

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
