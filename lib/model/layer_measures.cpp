#include "model/layer_measures.h"

#include <algorithm>
#include <cmath>

#include "model/sphere_slice.h"

namespace pigment {

double solids_volume(const std::vector<double>& radius) {
  double sum = 0;
  for (double a : radius) sum += Particles::sphere_volume(a);
  return sum;
}

double mass_centre(const Vec3Array& position, const std::vector<double>& radius,
                   const std::vector<double>& weight) {
  double total = 0, moment = 0;
  for (std::size_t i = 0; i < weight.size() && i < position.size(); ++i) {
    total += weight[i];
    moment += weight[i] * position[i].z();
  }
  if (total > 0) return moment / total;
  total = moment = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const double volume = Particles::sphere_volume(radius[i]);
    total += volume;
    moment += volume * position[i].z();
  }
  return total > 0 ? moment / total : 0.0;
}

double height_below_which(double share, const Vec3Array& position, const std::vector<double>& radius) {
  if (position.empty()) return 0;
  double low = position[0].z(), high = low;
  for (std::size_t i = 0; i < position.size(); ++i) {
    low = std::min(low, position[i].z() - radius[i]);
    high = std::max(high, position[i].z() + radius[i]);
  }
  if (share <= 0) return low;
  if (share >= 1) return high;
  const double target = share * solids_volume(radius);
  // Newton's method on the volume below z, which rises with z, kept inside a shrinking bracket; a step that
  // leaves the bracket or meets a plane without solids is replaced by bisection.
  double z = low + share * (high - low);
  for (int iteration = 0; iteration < 200; ++iteration) {
    double volume = -target, area = 0;
    for (std::size_t i = 0; i < position.size(); ++i) {
      volume += sphere_volume_below(radius[i], position[i].z(), z);
      area += sphere_section_area(radius[i], position[i].z(), z);
    }
    if (volume == 0) return z;
    (volume < 0 ? low : high) = z;
    double next = area > 0 ? z - volume / area : low;
    if (!(next > low && next < high)) next = low + 0.5 * (high - low);
    if (std::abs(next - z) <= 4e-16 * std::abs(z) || next == low || next == high) return next;
    z = next;
  }
  return z;
}

double protruding_fraction(double height, const Vec3Array& position, const std::vector<double>& radius) {
  double above = 0, total = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const double top = position[i].z() + radius[i];
    // The cap above the plane is the cap below the mirrored one.
    if (top > height) above += sphere_volume_below(radius[i], -position[i].z(), -height);
    total += Particles::sphere_volume(radius[i]);
  }
  return total > 0 ? above / total : 0.0;
}

std::vector<double> slice_volumes(const std::vector<double>& edges, const Vec3Array& position,
                                  const std::vector<double>& radius) {
  std::vector<double> volume(edges.size() < 2 ? 0 : edges.size() - 1, 0.0);
  for (std::size_t i = 0; i < position.size(); ++i)
    for_each_slice(edges, radius[i], position[i].z(), [&](std::size_t s, double part) { volume[s] += part; });
  return volume;
}

std::vector<double> equal_slices(double height, int slices) {
  std::vector<double> edges(static_cast<std::size_t>(slices) + 1);
  for (int s = 0; s <= slices; ++s) edges[static_cast<std::size_t>(s)] = height * s / slices;
  return edges;
}

ColumnGrid columns_of(const Cell& cell, double column) {
  const auto along = [&](double width) {
    return static_cast<std::size_t>(std::max(1L, std::lround(width / column)));
  };
  return {along(cell.width_x), along(cell.width_y)};
}

std::vector<double> top_of_columns(const Cell& cell, const Vec3Array& position, const std::vector<double>& radius,
                                   const ColumnGrid& columns) {
  const long nx = static_cast<long>(columns.x), ny = static_cast<long>(columns.y);
  const double dx = cell.width_x / static_cast<double>(nx), dy = cell.width_y / static_cast<double>(ny);
  std::vector<double> top(columns.count(), 0.0);
  const auto wrapped = [](long k, long n) { return ((k % n) + n) % n; };
  for (std::size_t i = 0; i < position.size(); ++i) {
    const double a = radius[i];
    const Vec3 p = cell.wrap(position[i]);
    for (long kx = std::lround(std::floor((p.x() - a) / dx));
         (static_cast<double>(kx) + 0.5) * dx < p.x() + a; ++kx) {
      const double x = (static_cast<double>(kx) + 0.5) * dx - p.x();
      for (long ky = std::lround(std::floor((p.y() - a) / dy));
           (static_cast<double>(ky) + 0.5) * dy < p.y() + a; ++ky) {
        const double y = (static_cast<double>(ky) + 0.5) * dy - p.y();
        const double rest = a * a - x * x - y * y;
        if (rest < 0) continue;
        double& height = top[static_cast<std::size_t>(wrapped(kx, nx) * ny + wrapped(ky, ny))];
        height = std::max(height, p.z() + std::sqrt(rest));
      }
    }
  }
  return top;
}

double top_envelope(const Cell& cell, const Vec3Array& position, const std::vector<double>& radius,
                    double column) {
  return spread_of(top_of_columns(cell, position, radius, columns_of(cell, column))).mean;
}

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  if (values.empty()) return spread;
  const auto count = static_cast<double>(values.size());
  for (const double v : values) spread.mean += v;
  spread.mean /= count;
  double squares = 0;
  for (const double v : values) squares += (v - spread.mean) * (v - spread.mean);
  spread.deviation = std::sqrt(squares / count);
  return spread;
}

NonAffineMotion non_affine_motion(const Vec3Array& position, const std::vector<double>& value, double height,
                                  int slices) {
  const auto count = static_cast<std::size_t>(std::max(1, slices));
  const auto slice_of = [&](double z) {
    const double s = std::floor(z / height * static_cast<double>(count));
    return static_cast<std::size_t>(std::clamp(s, 0.0, static_cast<double>(count - 1)));
  };
  struct Line {
    long n = 0;
    double z = 0, v = 0, zz = 0, zv = 0;  // means, then sums about the means
  };
  std::vector<Line> lines(count);
  for (std::size_t i = 0; i < position.size(); ++i) {
    Line& line = lines[slice_of(position[i].z())];
    ++line.n;
    line.z += position[i].z();
    line.v += value[i];
  }
  for (Line& line : lines)
    if (line.n > 0) {
      line.z /= static_cast<double>(line.n);
      line.v /= static_cast<double>(line.n);
    }
  for (std::size_t i = 0; i < position.size(); ++i) {
    Line& line = lines[slice_of(position[i].z())];
    const double dz = position[i].z() - line.z;
    line.zz += dz * dz;
    line.zv += dz * (value[i] - line.v);
  }
  double sum = 0;
  NonAffineMotion result;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Line& line = lines[slice_of(position[i].z())];
    if (line.n < 3) continue;
    const double slope = line.zz > 0 ? line.zv / line.zz : 0.0;
    const double rest = value[i] - line.v - slope * (position[i].z() - line.z);
    sum += rest * rest;
  }
  for (const Line& line : lines)
    if (line.n >= 3) result.degrees_of_freedom += line.n - 2;
  if (result.degrees_of_freedom > 0)
    result.rms = std::sqrt(sum / static_cast<double>(result.degrees_of_freedom));
  return result;
}

}  // namespace pigment
