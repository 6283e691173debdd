#pragma once
// A substrate that is not flat, as a picture's rays meet it.
#include <memory>

#include "model/height_field.h"
#include "report/ray.h"

namespace pigment::report {

class Ground {
 public:
  explicit Ground(std::shared_ptr<const HeightField> field) : field_(std::move(field)) {
    const double d = 0.5 * field_->resolution();
    const HeightMap& map = field_->map();
    for (double x = 0; x < map.period_x; x += d)
      for (double y = 0; y < map.period_y; y += d) steepest_ = std::max(steepest_, slope(x, y).norm());
  }
  bool below(const Vec3& p) const { return p.z() < field_->height(p.x(), p.y()); }
  // Where a ray enters the ground within an interval that begins above it; infinity where it does not. By steps that no slope of the
  // surface lets pass it (sphere tracing).
  double entry(const Ray& ray, const Interval& within) const {
    const double along = ray.direction.head<2>().norm(), fall = std::max(0.0, -ray.direction.z());
    const double speed = std::max(1e-9, 1.1 * steepest_ * along + fall), near = 1e-4 * field_->crest();
    double at = within.begin;
    for (int step = 0; step < 400 && at < within.end; ++step) {
      const Vec3 p = ray.origin + at * ray.direction;
      const double gap = p.z() - field_->height(p.x(), p.y());
      if (gap < near) return at;
      at += gap / speed;
    }
    return infinity;
  }
  Vec3 normal(const Vec3& p) const {
    const Eigen::Vector2d s = slope(p.x(), p.y());
    return Vec3(-s.x(), -s.y(), 1).normalized();
  }

 private:
  Eigen::Vector2d slope(double x, double y) const {
    const double d = 0.05 * field_->resolution();
    return {(field_->height(x + d, y) - field_->height(x - d, y)) / (2 * d), (field_->height(x, y + d) - field_->height(x, y - d)) / (2 * d)};
  }
  std::shared_ptr<const HeightField> field_;
  double steepest_ = 0;
};

}  // namespace pigment::report
