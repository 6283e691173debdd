#pragma once
// The part of a sphere between two horizontal planes, exactly.
#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pigment {

// Volume of the sphere of radius a centred at height centre that lies between the planes z = low and z = high
// (low <= high), um^3: the integral of pi (a^2 - t^2) over t = z - centre, with t0^2 + t0 t1 + t1^2 in place
// of the difference of cubes, so that a thin slice keeps its relative accuracy.
inline double sphere_slice_volume(double a, double centre, double low, double high) {
  const double t0 = std::clamp(low - centre, -a, a), t1 = std::clamp(high - centre, -a, a);
  return std::numbers::pi * (t1 - t0) * (a * a - (t0 * t0 + t0 * t1 + t1 * t1) / 3.0);
}

// Volume below the plane z = height, um^3: a cap of height h = height - centre + a, pi h^2 (3 a - h)/3.
inline double sphere_volume_below(double a, double centre, double height) {
  const double h = std::clamp(height - centre + a, 0.0, 2 * a);
  return std::numbers::pi / 3.0 * h * h * (3 * a - h);
}

// Area of the sphere's section by the plane z = height, um^2: the slope of sphere_volume_below.
inline double sphere_section_area(double a, double centre, double height) {
  const double t = height - centre;
  return std::max(0.0, std::numbers::pi * (a - t) * (a + t));
}

// Calls visit(slice, volume) for every slice between successive rising planes that the sphere reaches into;
// what lies outside the outermost planes is not visited.
template <typename Visit>
void for_each_slice(const std::vector<double>& edges, double a, double centre, Visit&& visit) {
  if (edges.size() < 2) return;
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, centre - a);
  for (auto s = static_cast<std::size_t>(above - edges.begin()) - 1;
       s + 1 < edges.size() && edges[s] < centre + a; ++s)
    visit(s, sphere_slice_volume(a, centre, edges[s], edges[s + 1]));
}

}  // namespace pigment
