#include "report/occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pigment::report {
namespace {

constexpr double reach = 3.6;  // in radii of the occluder: beyond it a sphere fills under 8 % of the view
// Tangent of the key light's half-angle as seen from a surface: how fast a shadow's edge softens with
// distance.
constexpr double light_softness = 0.30;

// Part of the cosine-weighted hemisphere that a sphere hides: s^2 cos(theta) when it is wholly above the
// horizon (s = radius/distance, theta its direction from the normal), meeting zero smoothly where it sets.
double hidden_sky(double s, double cosine) {
  if (cosine <= -s) return 0;
  return s * s * (cosine >= s ? cosine : (cosine + s) * (cosine + s) / (4 * s));
}

}  // namespace

template <typename Visit>
void OccluderGrid::for_each_cell_near(const Sphere& s, Visit visit) const {
  const double range = reach * s.radius;
  int low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    low[k] =
        std::clamp(static_cast<int>(std::floor((s.centre[k] - range - lower_[k]) / cell_)), 0, count_[k] - 1);
    high[k] =
        std::clamp(static_cast<int>(std::floor((s.centre[k] + range - lower_[k]) / cell_)), 0, count_[k] - 1);
  }
  for (int z = low[2]; z <= high[2]; ++z)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int x = low[0]; x <= high[0]; ++x) {
        // Distance from the sphere's centre to the cell.
        const int index[3] = {x, y, z};
        double distance2 = 0;
        for (int k = 0; k < 3; ++k) {
          const double from = lower_[k] + index[k] * cell_, to = from + cell_;
          const double d = std::max({from - s.centre[k], s.centre[k] - to, 0.0});
          distance2 += d * d;
        }
        if (distance2 < range * range)
          visit((static_cast<std::size_t>(z) * static_cast<std::size_t>(count_[1]) +
                 static_cast<std::size_t>(y)) *
                    static_cast<std::size_t>(count_[0]) +
                static_cast<std::size_t>(x));
      }
}

OccluderGrid::OccluderGrid(const std::vector<Sphere>& spheres, const std::vector<CuttingPlane>& cuts)
    : spheres_(spheres) {
  std::vector<int> kept;
  Vec3 upper = Vec3::Constant(-1e300);
  lower_ = Vec3::Constant(1e300);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Sphere& s = spheres[i];
    // A sphere mostly cut away casts no shadow worth its place.
    const bool gone = std::any_of(cuts.begin(), cuts.end(), [&](const CuttingPlane& c) {
      return c.normal.dot(s.centre) > c.offset + 0.2 * s.radius;
    });
    if (gone) continue;
    kept.push_back(static_cast<int>(i));
    lower_ = lower_.cwiseMin(s.centre - Vec3::Constant(s.radius));
    upper = upper.cwiseMax(s.centre + Vec3::Constant(s.radius));
  }
  if (kept.empty()) return;
  const double wanted_cells = std::clamp(5.0 * static_cast<double>(kept.size()), 512.0, 1.5e6);
  const Vec3 size = (upper - lower_).cwiseMax(1e-9);
  cell_ = std::max(std::cbrt(size.prod() / wanted_cells), size.maxCoeff() / 1000);
  std::size_t cells = 1;
  for (int k = 0; k < 3; ++k) {
    count_[k] = std::max(1, static_cast<int>(std::ceil(size[k] / cell_)));
    cells *= static_cast<std::size_t>(count_[k]);
  }
  begin_.assign(cells + 1, 0);
  for (const int i : kept)
    for_each_cell_near(spheres[static_cast<std::size_t>(i)], [&](std::size_t c) { ++begin_[c + 1]; });
  for (std::size_t c = 0; c < cells; ++c) begin_[c + 1] += begin_[c];
  list_.resize(begin_[cells]);
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (const int i : kept)
    for_each_cell_near(spheres[static_cast<std::size_t>(i)], [&](std::size_t c) { list_[next[c]++] = i; });
}

Illumination OccluderGrid::light_at(const Vec3& point, const Vec3& normal, const Vec3& to_key,
                                    int own) const {
  Illumination light;
  if (list_.empty()) return light;
  std::size_t cell = 0;
  for (int k = 2; k >= 0; --k) {
    const int i = std::clamp(static_cast<int>(std::floor((point[k] - lower_[k]) / cell_)), 0, count_[k] - 1);
    cell = cell * static_cast<std::size_t>(count_[k]) + static_cast<std::size_t>(i);
  }
  for (std::size_t at = begin_[cell]; at < begin_[cell + 1]; ++at) {
    const int j = list_[at];
    if (j == own) continue;
    const Sphere& s = spheres_[static_cast<std::size_t>(j)];
    const Vec3 to_centre = s.centre - point;
    const double distance2 = to_centre.squaredNorm(), range = reach * s.radius;
    if (distance2 >= range * range) continue;
    const double distance = std::sqrt(distance2), ratio = distance / range;
    const double fade =
        (1 - ratio * ratio) * (1 - ratio * ratio) * (1 + 2 * ratio * ratio);  // smooth to zero at the reach
    const double sine = std::min(s.radius / distance, 1.0);
    light.sky *= 1 - std::min(0.97, fade * hidden_sky(sine, normal.dot(to_centre) / distance));
    const double along = to_centre.dot(to_key);
    if (along > 0) {
      const double miss = std::sqrt(std::max(0.0, distance2 - along * along)) - s.radius;
      const double edge = std::clamp(0.5 + 0.5 * miss / (light_softness * along), 0.0, 1.0);
      light.key *= 1 - fade * (1 - edge * edge * (3 - 2 * edge));
    }
  }
  return light;
}

}  // namespace pigment::report
