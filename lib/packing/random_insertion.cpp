#include "packing/random_insertion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace pigment::packing {
namespace {

// Spheres of one size class (a factor of two in radius), in cells no narrower than the class's largest
// diameter.
class ClassGrid {
 public:
  ClassGrid(const Slab& slab, double largest_radius, std::size_t members)
      : slab_(slab), largest_radius_(largest_radius) {
    // Not many more cells than members: few large spheres in a wide layer need no fine grid.
    const double volume = slab.width * slab.width * (slab.top - slab.bottom);
    const double edge = std::max(2 * largest_radius, std::cbrt(volume / static_cast<double>(members + 1)));
    across_ = std::max(1, static_cast<int>(slab.width / edge));
    up_ = std::max(1, static_cast<int>((slab.top - slab.bottom) / edge));
    cells_.resize(static_cast<std::size_t>(across_) * across_ * up_);
  }

  void insert(const Vec3& centre, double radius) {
    const auto index =
        (static_cast<std::size_t>(along(centre.x())) * across_ + along(centre.y())) * up_ + level(centre.z());
    cells_[index].push_back({centre, radius});
  }

  // Largest overlap (um) of a sphere with members, at least `floor`; the search ends early above `enough`.
  double overlap(const Cell& cell, const Vec3& centre, double radius, double floor, double enough) const {
    const double reach = radius + largest_radius_;
    const int x0 = first(centre.x(), reach), nx = count(centre.x(), reach);
    const int y0 = first(centre.y(), reach), ny = count(centre.y(), reach);
    const int z0 = level(centre.z() - reach), z1 = level(centre.z() + reach);
    for (int dx = 0; dx < nx; ++dx)
      for (int dy = 0; dy < ny; ++dy)
        for (int z = z0; z <= z1; ++z) {
          const std::size_t column =
              static_cast<std::size_t>((x0 + dx) % across_) * across_ + (y0 + dy) % across_;
          for (const Sphere& s : cells_[column * up_ + z]) {
            const double contact = radius + s.radius;
            const double distance2 = cell.minimum_image(s.centre - centre).squaredNorm();
            if (distance2 >= (contact - floor) * (contact - floor)) continue;
            floor = contact - std::sqrt(distance2);
            if (floor > enough) return floor;
          }
        }
    return floor;
  }

 private:
  struct Sphere {
    Vec3 centre;
    double radius;
  };
  int along(double x) const {
    return std::clamp(static_cast<int>(x / slab_.width * across_), 0, across_ - 1);
  }
  int level(double z) const {
    const double c = std::floor((z - slab_.bottom) / (slab_.top - slab_.bottom) * up_);
    return static_cast<int>(std::clamp(c, 0.0, up_ - 1.0));
  }
  double cell_of(double x) const { return std::floor(x / slab_.width * across_); }
  int count(double x, double reach) const {
    return static_cast<int>(std::min<double>(across_, cell_of(x + reach) - cell_of(x - reach) + 1));
  }
  int first(double x, double reach) const {
    const double c = cell_of(x - reach);
    return static_cast<int>(c - across_ * std::floor(c / across_));
  }

  Slab slab_;
  double largest_radius_;
  int across_ = 1, up_ = 1;
  std::vector<std::vector<Sphere>> cells_;
};

int class_of(double radius, double largest) {
  return static_cast<int>(std::floor(std::log2(largest / radius)));
}

}  // namespace

Insertion insert_largest_first(const Slab& slab, const std::vector<double>& radius, std::uint64_t seed,
                               const std::function<void(double)>& on_progress) {
  assert(std::is_sorted(radius.rbegin(), radius.rend()));
  // A place is sought this often. Once many spheres have found none, random insertion has stalled: the rest
  // look a few times only and leave it to the removal of overlaps.
  constexpr int attempts = 4000, attempts_when_stalled = 40;
  constexpr std::size_t stalled_after = 20;

  Insertion result;
  if (radius.empty()) return result;
  const double largest = radius.front();
  std::vector<std::size_t> members;
  std::vector<double> class_largest;
  for (const double r : radius) {
    const auto c = static_cast<std::size_t>(class_of(r, largest));
    if (members.size() <= c) members.resize(c + 1), class_largest.resize(c + 1);
    ++members[c];
    class_largest[c] = std::max(class_largest[c], r);
  }
  std::vector<ClassGrid> grids;
  for (std::size_t c = 0; c < members.size(); ++c) grids.emplace_back(slab, class_largest[c], members[c]);

  const Cell cell = slab.cell();
  result.centre.reserve(radius.size());
  for (std::size_t k = 0; k < radius.size(); ++k) {
    const double r = radius[k];
    const auto own_class = static_cast<std::size_t>(class_of(r, largest));
    const int tries = result.overlapping < stalled_after ? attempts : attempts_when_stalled;
    Vec3 best = Vec3::Zero();
    double least = std::numeric_limits<double>::infinity();
    for (int t = 0; t < tries && least > 0; ++t) {
      const auto u = random_uniforms({seed, Stream::PackingPositions}, k, static_cast<std::uint64_t>(t));
      const double room = slab.top - slab.bottom - 2 * r;
      const Vec3 place(u[0] * slab.width, u[1] * slab.width, slab.bottom + r + u[2] * room);
      double overlap = slab.floor_overlap(place, r);
      for (std::size_t c = 0; c <= own_class && overlap < least; ++c)
        overlap = grids[c].overlap(cell, place, r, overlap, least);
      if (overlap < least) least = overlap, best = place;
    }
    if (least > 0) ++result.overlapping;
    grids[own_class].insert(best, r);
    result.centre.push_back(best);
    if (on_progress && k % 256 == 0) on_progress(static_cast<double>(k) / static_cast<double>(radius.size()));
  }
  return result;
}

}  // namespace pigment::packing
