#include "analysis/local_solids.h"

#include <algorithm>
#include <cmath>
#include <voro++/voro++.hh>

#include "model/sphere_slice.h"

namespace pigment::analysis {

LocalSolids local_solids(const Snapshot& frame, const std::vector<double>& radius) {
  const std::size_t particles = radius.size();
  const double height = frame.cell.height;
  LocalSolids result;
  result.cell_volume.assign(particles, 0.0);
  result.solids_fraction.assign(particles, 0.0);
  result.cell_neighbours.assign(particles, 0);
  result.surrounding_fraction.assign(particles, 0.0);
  result.begin.assign(particles + 1, 0);
  if (particles == 0) return result;

  // The container must hold every centre; what it holds beyond substrate and surface is cut off by planes.
  double low = 0, high = height;
  for (const Vec3& p : frame.position) {
    low = std::min(low, p.z() - 1e-3 * height);
    high = std::max(high, p.z() + 1e-3 * height);
  }
  // Voro++ advises five or so particles a block.
  const double block = std::cbrt(5 * frame.cell.area() * (high - low) / static_cast<double>(particles));
  const auto blocks = [&](double length) { return std::clamp(static_cast<int>(length / block), 1, 1000); };
  voro::container_poly container(0, frame.cell.width_x, 0, frame.cell.width_y, low, high, blocks(frame.cell.width_x),
                                 blocks(frame.cell.width_y), blocks(high - low), true, true, false, 8);
  voro::wall_plane substrate(0, 0, -1, 0), surface(0, 0, 1, height);
  if (low < 0) container.add_wall(substrate);
  if (high > height) container.add_wall(surface);
  for (std::size_t i = 0; i < particles; ++i) {
    const Vec3 p = frame.cell.wrap(frame.position[i]);
    container.put(static_cast<int>(i), p.x(), p.y(), p.z(), radius[i]);
  }
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor cell;
  std::vector<int> faces;
  std::vector<std::vector<std::int32_t>> neighbours(particles);
  if (loop.start()) do {
      if (!container.compute_cell(cell, loop)) continue;
      const auto i = static_cast<std::size_t>(loop.pid());
      const double volume = cell.volume();
      if (!(volume > 0)) continue;
      cell.neighbors(faces);
      result.cell_volume[i] = volume;
      result.solids_fraction[i] =
          sphere_slice_volume(radius[i], frame.position[i].z(), 0, height) / volume;
      for (const int j : faces)  // walls have numbers below 0
        if (j >= 0 && j != loop.pid()) neighbours[i].push_back(j);
    } while (loop.inc());

  for (std::size_t i = 0; i < particles; ++i) {
    result.cell_neighbours[i] = static_cast<std::int64_t>(neighbours[i].size());
    result.begin[i + 1] = result.begin[i] + neighbours[i].size();
    result.neighbour.insert(result.neighbour.end(), neighbours[i].begin(), neighbours[i].end());
    double space = result.cell_volume[i], solids = result.solids_fraction[i] * space;
    std::sort(neighbours[i].begin(), neighbours[i].end());
    neighbours[i].erase(std::unique(neighbours[i].begin(), neighbours[i].end()), neighbours[i].end());
    for (const std::int32_t j : neighbours[i]) {
      const auto k = static_cast<std::size_t>(j);
      space += result.cell_volume[k];
      solids += result.solids_fraction[k] * result.cell_volume[k];
    }
    if (space > 0) result.surrounding_fraction[i] = solids / space;
  }
  return result;
}

LocalCake local_cake(const Snapshot& frame, const std::vector<double>& radius, const LocalSolids& local,
                     double cake_solids, double wall_layer, const ColumnGrid& columns) {
  const auto dense = [&](std::size_t i) { return local.surrounding_fraction[i] >= cake_solids; };
  std::vector<char> in_cake(radius.size(), 0);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < radius.size(); ++i)
    if (dense(i) && frame.position[i].z() - radius[i] <= wall_layer) {
      in_cake[i] = 1;
      open.push_back(i);
    }
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    for (std::size_t n = local.begin[i]; n < local.begin[i + 1]; ++n) {
      const auto j = static_cast<std::size_t>(local.neighbour[n]);
      if (in_cake[j] || !dense(j)) continue;
      in_cake[j] = 1;
      open.push_back(j);
    }
  }
  Vec3Array position;
  std::vector<double> cake_radius;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    if (!in_cake[i]) continue;
    position.push_back(frame.position[i]);
    cake_radius.push_back(radius[i]);
  }
  LocalCake cake;
  cake.height = top_of_columns(frame.cell, position, cake_radius, columns);
  const Spread spread = spread_of(cake.height);
  cake.mean_height = spread.mean;
  cake.roughness = spread.deviation;
  return cake;
}

}  // namespace pigment::analysis
