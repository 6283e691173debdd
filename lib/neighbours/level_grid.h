#pragma once
// Particles of one size class sorted into the cells of a grid: inside the room, shared by its searches.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/vec.h"
#include "model/cell.h"

namespace pigment::neighbours {

// Size class of a radius: class k holds radii from 2^k to 2^(k+1) times the smallest.
inline int size_class(double radius, double smallest) { return std::max(0, std::ilogb(radius / smallest)); }

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
      const std::int64_t cx = wrapped_cell(x.first + dx, 0);
      for (std::int64_t dy = 0; dy < y.count; ++dy) {
        // z runs fastest, so the cells of one column are one stretch of members.
        const std::int64_t column = (cx * count_[1] + wrapped_cell(y.first + dy, 1)) * count_[2] + z.first;
        for (auto m = begin_[column]; m < begin_[column + z.count]; ++m) visit(members_[m]);
      }
    }
  }

 private:
  // A span begins within the period and is no longer; a division would take as long as the cell.
  std::int64_t wrapped_cell(std::int64_t c, int axis) const { return c < count_[axis] ? c : c - count_[axis]; }
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

}  // namespace pigment::neighbours
