#include "neighbours/neighbour_list.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pigment::neighbours {

namespace {

// Interleaves the low 21 bits of three integers: nearby cells get nearby codes (Morton order).
std::uint64_t spread(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

}  // namespace

bool NeighbourList::is_spent(const Vec3Array& position) const {
  // Displacements along z, fitted by shift + strain z. Two particles a distance r apart, each within `residual` of the fit, have
  // come nearer by at most 2 residual + |strain| r. A pair outside the list had r >= 2 a + limit with its skin, a the largest
  // radius; all r beyond are served by the same bound as r itself, since (1 - |strain|) r grows with r.
  const auto n = static_cast<double>(position.size());
  double z_mean = 0, shift = 0;
  for (std::size_t k = 0; k < position.size(); ++k) {
    z_mean += reference[k].z() / n;
    shift += (position[k].z() - reference[k].z()) / n;
  }
  double zz = 0, zd = 0;
  for (std::size_t k = 0; k < position.size(); ++k) {
    const double z = reference[k].z() - z_mean;
    zz += z * z;
    zd += z * (position[k].z() - reference[k].z() - shift);
  }
  const double strain = zz > 0 ? zd / zz : 0;
  double residual = 0;
  for (std::size_t k = 0; k < position.size(); ++k) {
    Vec3 d = position[k] - reference[k];
    d.z() -= shift + strain * (reference[k].z() - z_mean);
    residual = std::max(residual, d.squaredNorm());
  }
  const double skin = range.skin - std::abs(strain) * (2 * largest_radius + range.limit(largest_radius, largest_radius));
  return !(skin > 0 && 4 * residual <= skin * skin);
}

NeighbourList make_neighbour_list(const Cell& cell, const Vec3Array& position,
                                  const std::vector<double>& radius, const PairRange& range) {
  NeighbourList list;
  list.range = range;
  list.reference = position;
  list.largest_radius = radius.empty() ? 0 : *std::max_element(radius.begin(), radius.end());
  const std::size_t n = position.size();
  double lowest = 0, highest = 0;
  for (const Vec3& p : position) {
    lowest = std::min(lowest, p.z());
    highest = std::max(highest, p.z());
  }
  // Cells about as wide as a few mean spacings: finer order within a cell does not pay.
  const double volume = std::max(cell.area() * (highest - lowest), 1e-300);
  const double edge = std::max(std::cbrt(volume / std::max<std::size_t>(n, 1)), 1e-9);
  std::vector<std::uint64_t> code(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 p = cell.wrap(position[k]);
    code[k] = spread(static_cast<std::uint64_t>(p.x() / edge)) |
              spread(static_cast<std::uint64_t>(p.y() / edge)) << 1 |
              spread(static_cast<std::uint64_t>((p.z() - lowest) / edge)) << 2;
  }
  list.order.resize(n);
  std::iota(list.order.begin(), list.order.end(), 0);
  std::sort(list.order.begin(), list.order.end(),
            [&](std::int32_t a, std::int32_t b) { return code[a] != code[b] ? code[a] < code[b] : a < b; });
  Vec3Array sorted_position(n);
  std::vector<double> sorted_radius(n);
  for (std::size_t k = 0; k < n; ++k) {
    sorted_position[k] = position[list.order[k]];
    sorted_radius[k] = radius[list.order[k]];
  }
  list.pairs = find_pairs(cell, sorted_position, sorted_radius, range);
  return list;
}

}  // namespace pigment::neighbours
