#include "analysis/pores.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "base/random.h"
#include "model/sphere_slice.h"
#include "neighbours/nearest_surface.h"

namespace pigment::analysis {

namespace {

// Area of a sphere between the planes 0 and height: that of the zone, 2 pi a times its height.
double zone_area(double a, double centre, double height) {
  const double low = std::clamp(-centre, -a, a), high = std::clamp(height - centre, -a, a);
  return 2 * std::numbers::pi * a * (high - low);
}

}  // namespace

double Pores::mean_distance() const {
  const double sum = std::accumulate(distance.begin(), distance.end(), 0.0);
  return distance.empty() ? 0.0 : sum / static_cast<double>(distance.size());
}

Pores measure_pores(const Snapshot& frame, const std::vector<double>& radius, std::size_t points) {
  const Cell& cell = frame.cell;
  const double space = cell.area() * frame.space_below(cell.height);
  double solids = 0, area = 0;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    solids += sphere_slice_volume(radius[i], frame.position[i].z(), 0, cell.height);
    area += zone_area(radius[i], frame.position[i].z(), cell.height);
  }
  Pores result;
  result.porosity = 1 - solids / space;
  result.specific_surface = area / space;
  if (area > 0) result.hydraulic_diameter = std::max(0.0, 4 * (space - solids) / area);
  if (radius.empty()) return result;

  const neighbours::NearestSurface surfaces(cell, frame.position, radius);
  result.distance.resize(points);
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < points; ++k) {
    const auto u = random_uniforms({1, Stream::PorePoints}, k);
    const Vec3 point(u[0] * cell.width_x, u[1] * cell.width_y, u[2] * cell.height);
    const bool in_substrate = frame.substrate && point.z() < frame.substrate->height(point.x(), point.y());
    result.distance[k] = in_substrate ? -1 : surfaces.distance(point);
  }
  std::erase_if(result.distance, [](double d) { return d < 0; });
  std::sort(result.distance.begin(), result.distance.end());
  return result;
}

}  // namespace pigment::analysis
