#include "neighbours/nearest_surface.h"

#include <map>

#include "neighbours/level_grid.h"

namespace pigment::neighbours {

struct NearestSurface::Data {
  Cell cell;
  Vec3Array position;  // wrapped in x and y
  std::vector<double> radius;
  std::vector<LevelGrid> levels;
  double first_reach = 1;  // um
};

NearestSurface::NearestSurface(const Cell& cell, const Vec3Array& position, const std::vector<double>& radius) {
  auto data = std::make_unique<Data>();
  data->cell = cell;
  data->radius = radius;
  for (const Vec3& p : position) data->position.push_back(cell.wrap(p));
  if (!radius.empty()) {
    // A third of the spacing that as many spheres would have on a lattice: about the width of a pore.
    data->first_reach = std::cbrt(cell.area() * cell.height / static_cast<double>(radius.size())) / 3;
    const double smallest = *std::min_element(radius.begin(), radius.end());
    std::map<int, std::vector<std::int32_t>> members;
    for (std::size_t i = 0; i < radius.size(); ++i)
      members[size_class(radius[i], smallest)].push_back(static_cast<std::int32_t>(i));
    for (auto& [level, of_level] : members) {
      double largest = 0;
      for (const std::int32_t i : of_level) largest = std::max(largest, radius[static_cast<std::size_t>(i)]);
      data->levels.emplace_back(cell, data->position, radius, std::move(of_level), largest + data->first_reach);
    }
  }
  data_ = std::move(data);
}

NearestSurface::~NearestSurface() = default;

double NearestSurface::distance(const Vec3& point) const {
  const Data& d = *data_;
  double best = std::numeric_limits<double>::infinity();
  if (d.levels.empty()) return best;
  const Vec3 p = d.cell.wrap(point);
  // A surface within reach of the point is one whose centre is within reach and radius; what lies farther may be missed,
  // so the search goes on until what it found is within its reach.
  for (double reach = d.first_reach;; reach *= 2) {
    for (const LevelGrid& level : d.levels)
      level.near(p, reach + level.largest_radius, [&](std::int32_t i) {
        const auto k = static_cast<std::size_t>(i);
        best = std::min(best, d.cell.minimum_image(d.position[k] - p).norm() - d.radius[k]);
      });
    if (best <= reach) return best;
  }
}

}  // namespace pigment::neighbours
