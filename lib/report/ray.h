#pragma once
// Where a ray enters and leaves what a picture is made of.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "report/render.h"

namespace pigment::report {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Ray {
  Vec3 origin, direction;
};

struct Interval {
  double begin = -infinity, end = infinity;
  int begin_face = -1;  // cutting plane (or axis of a box) that opens it
};

// The part of the ray that no cutting plane takes away.
inline Interval kept_part(const Ray& ray, const std::vector<CuttingPlane>& cuts, bool perspective) {
  Interval kept;
  if (perspective) kept.begin = 0;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const double speed = cuts[i].normal.dot(ray.direction),
                 distance = cuts[i].offset - cuts[i].normal.dot(ray.origin);
    if (std::abs(speed) < 1e-12) {
      if (distance < 0) kept.end = -infinity;
    } else if (speed < 0) {
      if (distance / speed > kept.begin) kept = {distance / speed, kept.end, static_cast<int>(i)};
    } else {
      kept.end = std::min(kept.end, distance / speed);
    }
  }
  return kept;
}

inline Interval through_box(const Ray& ray, const Box& box) {
  Interval inside;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(ray.direction[k]) < 1e-12) {
      if (ray.origin[k] < box.lower[k] || ray.origin[k] > box.upper[k]) return {0, -1, -1};
      continue;
    }
    double a = (box.lower[k] - ray.origin[k]) / ray.direction[k],
           b = (box.upper[k] - ray.origin[k]) / ray.direction[k];
    if (a > b) std::swap(a, b);
    if (a > inside.begin) inside = {a, inside.end, k};
    inside.end = std::min(inside.end, b);
  }
  return inside;
}

inline Interval through_sphere(const Ray& ray, const Sphere& s) {
  const Vec3 to_centre = s.centre - ray.origin;
  const double along = to_centre.dot(ray.direction);
  const double miss2 = (to_centre - along * ray.direction).squaredNorm();
  const double half2 = s.radius * s.radius - miss2;
  if (half2 < 0) return {0, -1, -1};
  const double half = std::sqrt(half2);
  return {along - half, along + half, -1};
}

// A cylinder without caps (its ends lie inside spheres).
inline Interval through_rod(const Ray& ray, const Connection& rod) {
  const Vec3 axis = rod.to - rod.from;
  const double length = axis.norm();
  if (length <= 0) return {0, -1, -1};
  const Vec3 u = axis / length, d = ray.direction - ray.direction.dot(u) * u;
  const Vec3 o = (ray.origin - rod.from) - (ray.origin - rod.from).dot(u) * u;
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - rod.radius * rod.radius;
  const double root2 = b * b - a * c;
  if (a < 1e-14 || root2 < 0) return {0, -1, -1};
  const double near = (-b - std::sqrt(root2)) / a;
  const double height = (ray.origin + near * ray.direction - rod.from).dot(u);
  if (height < 0 || height > length) return {0, -1, -1};
  return {near, (-b + std::sqrt(root2)) / a, -1};
}

}  // namespace pigment::report
