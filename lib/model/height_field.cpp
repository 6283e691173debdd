#include "model/height_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pigment {

namespace {

// Coefficients of the periodic cubic B-spline through n values `stride` apart, in place of them: two recursive filters with the pole
// sqrt(3) - 2 [unser1999].
void spline_coefficients(double* value, std::size_t n, std::size_t stride) {
  if (n == 1) return;
  const double pole = std::sqrt(3.0) - 2;
  std::vector<double> c(n);
  for (std::size_t k = 0; k < n; ++k) c[k] = value[k * stride];
  double start = 0, power = 1;
  for (std::size_t k = 0; k < n; ++k, power *= pole) start += power * c[(n - k) % n];
  c[0] = start / (1 - power);
  for (std::size_t k = 1; k < n; ++k) c[k] += pole * c[k - 1];
  start = 0;
  power = 1;
  for (std::size_t k = 0; k < n; ++k, power *= pole) start += power * c[(n - 1 + k) % n];
  double next = -pole * start / (1 - power);
  value[(n - 1) * stride] = 6 * next;
  for (std::size_t k = n - 1; k-- > 0;) {
    next = pole * (next - c[k]);
    value[k * stride] = 6 * next;
  }
}

// The four B-splines that reach a point t between two grid points, their first and second derivatives by t.
struct Basis {
  double value[4], first[4], second[4];
};
Basis basis_at(double t) {
  const double s = 1 - t;
  return {{s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6},
          {-0.5 * s * s, 1.5 * t * t - 2 * t, -1.5 * s * s + 2 * s, 0.5 * t * t},
          {s, 3 * t - 2, 3 * s - 2, t}};
}

std::size_t wrapped(long i, std::size_t n) {
  const long m = static_cast<long>(n), r = i % m;
  return static_cast<std::size_t>(r < 0 ? r + m : r);
}

std::array<std::size_t, 4> four_from(long first, std::size_t n) {
  std::array<std::size_t, 4> at{wrapped(first, n)};
  for (int a = 1; a < 4; ++a) at[a] = at[a - 1] + 1 == n ? 0 : at[a - 1] + 1;
  return at;
}

}  // namespace

HeightField::HeightField(HeightMap map, const Cell& cell) : map_(std::move(map)) {
  map_.period_x = cell.width_x / std::max(1.0, std::nearbyint(cell.width_x / map_.period_x));
  map_.period_y = cell.width_y / std::max(1.0, std::nearbyint(cell.width_y / map_.period_y));
  coefficient_ = map_.height;
  for (std::size_t i = 0; i < map_.count_x; ++i) spline_coefficients(&coefficient_[i * map_.count_y], map_.count_y, 1);
  for (std::size_t j = 0; j < map_.count_y; ++j) spline_coefficients(&coefficient_[j], map_.count_x, map_.count_y);
  // Two feet of one point are two grid points apart or more, unless they have just parted from one.
  // A multiple of the grid: then their mean is that of the spline.
  const auto samples_of = [](std::size_t count) { return count * std::max<std::size_t>(2, (15 + count) / count); };
  samples_x_ = samples_of(map_.count_x);
  samples_y_ = samples_of(map_.count_y);
  step_x_ = map_.period_x / static_cast<double>(samples_x_);
  step_y_ = map_.period_y / static_cast<double>(samples_y_);
  for (std::size_t i = 0; i < samples_x_; ++i)
    for (std::size_t j = 0; j < samples_y_; ++j) sample_.push_back(height(static_cast<double>(i) * step_x_, static_cast<double>(j) * step_y_));
  lowest_ = extremum(static_cast<std::size_t>(std::min_element(sample_.begin(), sample_.end()) - sample_.begin()));
  crest_ = extremum(static_cast<std::size_t>(std::max_element(sample_.begin(), sample_.end()) - sample_.begin()));
  sorted_ = sample_;
  std::sort(sorted_.begin(), sorted_.end());
  sum_.resize(sorted_.size() + 1, 0.0);
  for (std::size_t k = 0; k < sorted_.size(); ++k) sum_[k + 1] = sum_[k] + sorted_[k];
  mean_ = sum_.back() / static_cast<double>(sorted_.size());
}

// Newton's method from a sample to where the gradient vanishes; a step longer than the samples are apart leaves it there.
double HeightField::extremum(std::size_t at) const {
  double x = static_cast<double>(at / samples_y_) * step_x_, y = static_cast<double>(at % samples_y_) * step_y_;
  for (int pass = 0; pass < 20; ++pass) {
    const Local s = local(x, y);
    const double determinant = s.hxx * s.hyy - s.hxy * s.hxy;
    if (!(determinant > 0)) break;
    const double dx = -(s.hyy * s.gx - s.hxy * s.gy) / determinant, dy = -(s.hxx * s.gy - s.hxy * s.gx) / determinant;
    if (std::abs(dx) > step_x_ || std::abs(dy) > step_y_) break;
    x += dx;
    y += dy;
  }
  return height(x, y);
}

double HeightField::resolution() const { return std::max(step_x_, step_y_); }

double HeightField::height(double x, double y) const {
  const double u = x * static_cast<double>(map_.count_x) / map_.period_x, v = y * static_cast<double>(map_.count_y) / map_.period_y;
  const double at_u = std::floor(u), at_v = std::floor(v);
  const Basis bx = basis_at(u - at_u), by = basis_at(v - at_v);
  const auto row = four_from(static_cast<long>(at_u) - 1, map_.count_x), column = four_from(static_cast<long>(at_v) - 1, map_.count_y);
  double z = 0;
  for (int a = 0; a < 4; ++a) {
    const double* c = &coefficient_[row[a] * map_.count_y];
    z += bx.value[a] * (by.value[0] * c[column[0]] + by.value[1] * c[column[1]] + by.value[2] * c[column[2]] + by.value[3] * c[column[3]]);
  }
  return z;
}

HeightField::Local HeightField::local(double x, double y) const {
  const double per_x = static_cast<double>(map_.count_x) / map_.period_x, per_y = static_cast<double>(map_.count_y) / map_.period_y;
  const double u = x * per_x, v = y * per_y, at_u = std::floor(u), at_v = std::floor(v);
  const Basis bx = basis_at(u - at_u), by = basis_at(v - at_v);
  const auto row = four_from(static_cast<long>(at_u) - 1, map_.count_x), column = four_from(static_cast<long>(at_v) - 1, map_.count_y);
  Local s{};
  for (int a = 0; a < 4; ++a) {
    double value = 0, first = 0, second = 0;
    for (int b = 0; b < 4; ++b) {
      const double c = coefficient_[row[a] * map_.count_y + column[b]];
      value += by.value[b] * c;
      first += by.first[b] * c;
      second += by.second[b] * c;
    }
    s.z += bx.value[a] * value;
    s.gx += bx.first[a] * value;
    s.gy += bx.value[a] * first;
    s.hxx += bx.second[a] * value;
    s.hxy += bx.first[a] * first;
    s.hyy += bx.value[a] * second;
  }
  s.gx *= per_x;
  s.gy *= per_y;
  s.hxx *= per_x * per_x;
  s.hxy *= per_x * per_y;
  s.hyy *= per_y * per_y;
  return s;
}

double HeightField::space_below(double z) const {
  const auto below = static_cast<std::size_t>(std::lower_bound(sorted_.begin(), sorted_.end(), z) - sorted_.begin());
  return (static_cast<double>(below) * z - sum_[below]) / static_cast<double>(sorted_.size());
}

double HeightField::half_squared_distance(double x, double y, const Vec3& p) const {
  const double dx = x - p.x(), dy = y - p.y(), dz = height(x, y) - p.z();
  return 0.5 * (dx * dx + dy * dy + dz * dz);
}

// Newton's method on half the squared distance, its Hessian made positive where it is not (there a foot is about to vanish), each step
// halved until it brings the distance down.
HeightField::Foot HeightField::descend(double x, double y, const Vec3& p) const {
  const double inside = p.z() < height(p.x(), p.y()) ? -1 : 1;
  double value = half_squared_distance(x, y, p);
  for (int pass = 0; pass < 60; ++pass) {
    const Local s = local(x, y);
    const double depth = s.z - p.z(), gx = x - p.x() + depth * s.gx, gy = y - p.y() + depth * s.gy;
    const double hxx = 1 + s.gx * s.gx + depth * s.hxx, hyy = 1 + s.gy * s.gy + depth * s.hyy, hxy = s.gx * s.gy + depth * s.hxy;
    const double smallest = 0.5 * (hxx + hyy) - std::hypot(0.5 * (hxx - hyy), hxy), shift = std::max(0.0, 1e-4 - smallest);
    const double determinant = (hxx + shift) * (hyy + shift) - hxy * hxy;
    double dx = -((hyy + shift) * gx - hxy * gy) / determinant, dy = -((hxx + shift) * gy - hxy * gx) / determinant;
    const double length = std::hypot(dx, dy), longest = 2 * resolution();
    if (length > longest) {
      dx *= longest / length;
      dy *= longest / length;
    }
    double share = 1, next = value;
    for (int cut = 0; cut < 30; ++cut, share *= 0.5) {
      next = half_squared_distance(x + share * dx, y + share * dy, p);
      if (next < value) break;
    }
    if (!(next < value)) break;  // rounding is all that is left
    x += share * dx;
    y += share * dy;
    value = next;
  }
  const Local s = local(x, y);
  const double slope2 = 1 + s.gx * s.gx + s.gy * s.gy, slope = std::sqrt(slope2);
  Foot foot{x, y, Vec3(-s.gx, -s.gy, 1) / slope, inside * std::sqrt(2 * value), 0, 0};
  // Principal curvatures: eigenvalues of the second fundamental form over the first, positive where convex.
  const double mean = -0.5 * ((1 + s.gy * s.gy) * s.hxx - 2 * s.gx * s.gy * s.hxy + (1 + s.gx * s.gx) * s.hyy) / (slope2 * slope);
  const double product = (s.hxx * s.hyy - s.hxy * s.hxy) / (slope2 * slope2);
  const double half_difference = std::sqrt(std::max(0.0, mean * mean - product));
  foot.curvature = mean + half_difference;
  foot.least_curvature = mean - half_difference;
  return foot;
}

HeightField::Foot HeightField::follow(const Foot& foot, const Vec3& point) const { return descend(foot.x, foot.y, point); }

double HeightField::gap(const Vec3& centre, double radius, double reach) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Foot& foot : feet(centre, radius + reach)) least = std::min(least, foot.distance - radius);
  return least;
}

std::vector<HeightField::Foot> HeightField::feet(const Vec3& p, double reach) const {
  std::vector<Foot> found;
  const double above = std::max(0.0, p.z() - crest_);
  if (above > reach) return found;
  const double across = std::sqrt(reach * reach - above * above);
  const auto first = [&](double at, double step) { return static_cast<long>(std::floor((at - across) / step)) - 1; };
  const auto last = [&](double at, double step) { return static_cast<long>(std::ceil((at + across) / step)) + 1; };
  const long i0 = first(p.x(), step_x_), i1 = last(p.x(), step_x_), j0 = first(p.y(), step_y_), j1 = last(p.y(), step_y_);
  const long rows = j1 - j0 + 1;
  std::vector<double> value(static_cast<std::size_t>((i1 - i0 + 1) * rows));
  std::vector<std::size_t> column(static_cast<std::size_t>(rows));
  for (long j = j0; j <= j1; ++j) column[static_cast<std::size_t>(j - j0)] = wrapped(j, samples_y_);
  for (long i = i0; i <= i1; ++i) {
    const double* heights = &sample_[wrapped(i, samples_x_) * samples_y_];
    const double dx = static_cast<double>(i) * step_x_ - p.x();
    for (long j = j0; j <= j1; ++j) {
      const double dy = static_cast<double>(j) * step_y_ - p.y(), dz = heights[column[static_cast<std::size_t>(j - j0)]] - p.z();
      value[static_cast<std::size_t>((i - i0) * rows + j - j0)] = dx * dx + dy * dy + dz * dz;
    }
  }
  for (long i = i0 + 1; i < i1; ++i)
    for (long j = j0 + 1; j < j1; ++j) {
      const double own = value[static_cast<std::size_t>((i - i0) * rows + j - j0)];
      bool least = true;
      for (long a = -1; a <= 1 && least; ++a)
        for (long b = -1; b <= 1 && least; ++b) least = own <= value[static_cast<std::size_t>((i + a - i0) * rows + j + b - j0)];
      if (!least) continue;
      const Foot foot = descend(static_cast<double>(i) * step_x_, static_cast<double>(j) * step_y_, p);
      if (std::abs(foot.distance) > reach) continue;
      const bool known = std::any_of(found.begin(), found.end(), [&](const Foot& f) {
        return std::hypot(f.x - foot.x, f.y - foot.y) < 1e-3 * std::min(step_x_, step_y_);
      });
      if (!known) found.push_back(foot);
    }
  const bool inside = p.z() < height(p.x(), p.y());
  if (found.empty() && inside) return feet(p, 2 * reach + resolution());
  if (found.size() > 1 && inside) {
    found.front() = *std::max_element(found.begin(), found.end(), [](const Foot& a, const Foot& b) { return a.distance < b.distance; });
    found.resize(1);
  }
  return found;
}

}  // namespace pigment
