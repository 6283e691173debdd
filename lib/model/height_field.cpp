#include "model/height_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pigment {

namespace {
// Two feet of one point are about half a wavelength apart or more, unless they have just parted from one.
constexpr int samples_a_period = 16;
}  // namespace

Roughness read_roughness(config::Node node) {
  return {node.quantity("amplitude", Dimension::Length, config::positive()),
          node.quantity("wavelength", Dimension::Length, config::positive())};
}

HeightField::HeightField(const Roughness& roughness, const Cell& cell) : amplitude_(roughness.amplitude) {
  const double nx = std::max(1.0, std::nearbyint(cell.width_x / roughness.wavelength));
  const double ny = std::max(1.0, std::nearbyint(cell.width_y / roughness.wavelength));
  wave_x_ = 2 * std::numbers::pi * nx / cell.width_x;
  wave_y_ = 2 * std::numbers::pi * ny / cell.width_y;
  step_x_ = cell.width_x / (nx * samples_a_period);
  step_y_ = cell.width_y / (ny * samples_a_period);
}

double HeightField::height(double x, double y) const {
  return 0.25 * amplitude_ * (2 + std::cos(wave_x_ * x) + std::cos(wave_y_ * y));
}

HeightField::Local HeightField::local(double x, double y) const {
  const double q = 0.25 * amplitude_, cx = std::cos(wave_x_ * x), cy = std::cos(wave_y_ * y);
  return {q * (2 + cx + cy), -q * wave_x_ * std::sin(wave_x_ * x), -q * wave_y_ * std::sin(wave_y_ * y), -q * wave_x_ * wave_x_ * cx,
          -q * wave_y_ * wave_y_ * cy};
}

double HeightField::half_squared_distance(double x, double y, const Vec3& p) const {
  const double dx = x - p.x(), dy = y - p.y(), dz = height(x, y) - p.z();
  return 0.5 * (dx * dx + dy * dy + dz * dz);
}

// Newton's method on half the squared distance; where that is not convex, or a step does not bring it down, down the gradient,
// halved until it does. Where that stops on a saddle, as midway between two slopes, it leaves it along the direction that falls.
HeightField::Foot HeightField::descend(double x, double y, const Vec3& p) const {
  const double inside = p.z() < height(p.x(), p.y()) ? -1 : 1;
  double value = half_squared_distance(x, y, p);
  for (int pass = 0; pass < 60; ++pass) {
    const Local s = local(x, y);
    const double depth = s.z - p.z(), gx = x - p.x() + depth * s.gx, gy = y - p.y() + depth * s.gy;
    const double hxx = 1 + s.gx * s.gx + depth * s.hxx, hyy = 1 + s.gy * s.gy + depth * s.hyy, hxy = s.gx * s.gy;
    const double determinant = hxx * hyy - hxy * hxy;
    double dx = -gx, dy = -gy;
    if (hxx > 0 && determinant > 1e-6 * hxx * hyy) {
      dx = -(hyy * gx - hxy * gy) / determinant;
      dy = -(hxx * gy - hxy * gx) / determinant;
    }
    const double length = std::hypot(dx, dy), longest = 2 * std::max(step_x_, step_y_);
    if (length > longest) {
      dx *= longest / length;
      dy *= longest / length;
    }
    double share = 1, next = value;
    for (int cut = 0; cut < 30; ++cut, share *= 0.5) {
      next = half_squared_distance(x + share * dx, y + share * dy, p);
      if (next < value) break;
    }
    if (!(next < value)) {
      const double middle = 0.5 * (hxx + hyy), half = std::hypot(0.5 * (hxx - hyy), hxy);
      if (middle - half >= 0) break;  // a minimum, to rounding
      // Eigenvector of the lower eigenvalue.
      const double angle = 0.5 * std::atan2(2 * hxy, hxx - hyy) + 0.5 * std::numbers::pi;
      dx = 0.05 * longest * std::cos(angle);
      dy = 0.05 * longest * std::sin(angle);
      share = 1;
      next = half_squared_distance(x + dx, y + dy, p);
      if (!(next < value)) break;
    }
    x += share * dx;
    y += share * dy;
    value = next;
  }
  const Local s = local(x, y);
  const double slope2 = 1 + s.gx * s.gx + s.gy * s.gy, slope = std::sqrt(slope2);
  Foot foot{x, y, Vec3(-s.gx, -s.gy, 1) / slope, inside * std::sqrt(2 * value), 0};
  // Principal curvatures: eigenvalues of the second fundamental form over the first, positive where convex.
  const double mean = -0.5 * ((1 + s.gy * s.gy) * s.hxx + (1 + s.gx * s.gx) * s.hyy) / (slope2 * slope);
  const double product = s.hxx * s.hyy / (slope2 * slope2);
  foot.curvature = mean + std::sqrt(std::max(0.0, mean * mean - product));
  return foot;
}

HeightField::Foot HeightField::follow(const Foot& foot, const Vec3& point) const { return descend(foot.x, foot.y, point); }

std::vector<HeightField::Foot> HeightField::feet(const Vec3& p, double reach) const {
  std::vector<Foot> found;
  const double above = std::max(0.0, p.z() - amplitude_);
  if (above > reach) return found;
  const double across = std::sqrt(reach * reach - above * above);
  const auto first = [&](double at, double step) { return static_cast<long>(std::floor((at - across) / step)) - 1; };
  const auto last = [&](double at, double step) { return static_cast<long>(std::ceil((at + across) / step)) + 1; };
  const long i0 = first(p.x(), step_x_), i1 = last(p.x(), step_x_), j0 = first(p.y(), step_y_), j1 = last(p.y(), step_y_);
  const long rows = j1 - j0 + 1;
  // The height is a sum of a part of x and one of y.
  std::vector<double> hx(i1 - i0 + 1), hy(rows), value((i1 - i0 + 1) * rows);
  for (long i = i0; i <= i1; ++i) hx[i - i0] = std::cos(wave_x_ * step_x_ * static_cast<double>(i));
  for (long j = j0; j <= j1; ++j) hy[j - j0] = std::cos(wave_y_ * step_y_ * static_cast<double>(j));
  for (long i = i0; i <= i1; ++i)
    for (long j = j0; j <= j1; ++j) {
      const double dx = static_cast<double>(i) * step_x_ - p.x(), dy = static_cast<double>(j) * step_y_ - p.y();
      const double dz = 0.25 * amplitude_ * (2 + hx[i - i0] + hy[j - j0]) - p.z();
      value[(i - i0) * rows + j - j0] = dx * dx + dy * dy + dz * dz;
    }
  for (long i = i0 + 1; i < i1; ++i)
    for (long j = j0 + 1; j < j1; ++j) {
      const double own = value[(i - i0) * rows + j - j0];
      bool least = true;
      for (long a = -1; a <= 1 && least; ++a)
        for (long b = -1; b <= 1 && least; ++b) least = own <= value[(i + a - i0) * rows + j + b - j0];
      if (!least) continue;
      const Foot foot = descend(static_cast<double>(i) * step_x_, static_cast<double>(j) * step_y_, p);
      if (std::abs(foot.distance) > reach) continue;
      const bool known = std::any_of(found.begin(), found.end(), [&](const Foot& f) {
        return std::hypot(f.x - foot.x, f.y - foot.y) < 1e-3 * std::min(step_x_, step_y_);
      });
      if (!known) found.push_back(foot);
    }
  if (found.size() > 1 && found.front().distance < 0) {
    found.front() = *std::max_element(found.begin(), found.end(), [](const Foot& a, const Foot& b) { return a.distance < b.distance; });
    found.resize(1);
  }
  return found;
}

}  // namespace pigment
