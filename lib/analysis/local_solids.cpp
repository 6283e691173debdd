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
  if (loop.start()) do {
      if (!container.compute_cell(cell, loop)) continue;
      const auto i = static_cast<std::size_t>(loop.pid());
      const double volume = cell.volume();
      if (!(volume > 0)) continue;
      cell.neighbors(faces);
      result.cell_volume[i] = volume;
      result.solids_fraction[i] =
          sphere_slice_volume(radius[i], frame.position[i].z(), 0, height) / volume;
      result.cell_neighbours[i] = std::count_if(faces.begin(), faces.end(), [&](int j) { return j >= 0 && j != loop.pid(); });
    } while (loop.inc());
  return result;
}

}  // namespace pigment::analysis
