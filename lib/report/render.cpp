#include "report/render.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "report/ground.h"
#include "report/occlusion.h"
#include "report/ray.h"

namespace pigment::report {
namespace {

constexpr int tile_size = 32;  // pixels
constexpr double radians = std::numbers::pi / 180;

Ray ray_through(const Camera& c, const RenderSettings& s, double x, double y) {
  const double scale = c.width / s.width;
  const Vec3 on_plane =
      c.target + (x - 0.5 * s.width) * scale * c.right + (0.5 * s.height - y) * scale * c.up;
  if (c.eye_distance <= 0) return {on_plane, c.forward};
  const Vec3 eye = c.target - c.eye_distance * c.forward;
  return {eye, (on_plane - eye).normalized()};
}

// What a sample sees. `object`: sphere index; then connections; then the substrate; nothing.
struct Hit {
  double distance = infinity;
  int object = -1;
  int face = -1;  // cutting plane whose face is seen, or axis of the substrate's face; -1: the surface itself
  bool same_surface(const Hit& o) const { return object == o.object && face == o.face; }
};

struct PixelBounds {
  double left, right, top, bottom;
};

class Renderer {
 public:
  Renderer(const SphereScene& scene, const Camera& camera, const RenderSettings& settings)
      : scene_(scene), camera_(camera), settings_(settings), occluders_(scene.spheres, scene.cuts) {
    // The key light stands over the viewer's left shoulder; the sky is straight up.
    to_key_ = (-0.55 * camera.right + 0.75 * camera.up - 0.75 * camera.forward).normalized();
    if (camera.forward.z() < -0.9)
      to_key_ = (-0.5 * camera.right + 0.5 * camera.up - camera.forward).normalized();
    if (scene.ground) ground_.emplace(scene.ground);
    sort_into_tiles();
  }

  Image image() const {
    Image image(settings_.width, settings_.height);
    const int tiles = tiles_x_ * tiles_y_;
#pragma omp parallel for schedule(dynamic, 1)
    for (int tile = 0; tile < tiles; ++tile) draw_tile(tile, image);
    return image;
  }

 private:
  const SphereScene& scene_;
  const Camera& camera_;
  const RenderSettings& settings_;
  OccluderGrid occluders_;
  Vec3 to_key_;
  std::optional<Ground> ground_;
  int tiles_x_ = 0, tiles_y_ = 0;
  std::vector<std::vector<int>> tile_objects_;
  std::vector<PixelBounds> bounds_;

  int sphere_count() const { return static_cast<int>(scene_.spheres.size()); }
  int substrate_object() const { return sphere_count() + static_cast<int>(scene_.connections.size()); }

  // Pixels that a ball covers, exactly for parallel rays and by its tangents for perspective.
  PixelBounds bounds_of(const Vec3& centre, double radius) const {
    const double scale = settings_.width / camera_.width;
    const Vec3 d = centre - camera_.target;
    const double x = d.dot(camera_.right), y = d.dot(camera_.up);
    // Far outside the picture is far enough: pixel numbers stay whole numbers that fit.
    const auto pixel = [&](double size, double v) { return std::clamp(0.5 * size + scale * v, -1e6, 1e6); };
    const auto to_pixels = [&](double x0, double x1, double y0, double y1) {
      return PixelBounds{pixel(settings_.width, x0), pixel(settings_.width, x1), pixel(settings_.height, -y1),
                         pixel(settings_.height, -y0)};
    };
    if (camera_.eye_distance <= 0) return to_pixels(x - radius, x + radius, y - radius, y + radius);
    const double depth = d.dot(camera_.forward) + camera_.eye_distance;
    const auto tangents = [&](double u) {
      const double distance = std::hypot(u, depth);
      if (depth <= radius || distance <= radius) return std::pair{-1e6, 1e6};
      const double angle = std::atan2(u, depth), half = std::asin(radius / distance);
      const double limit = 89.9 * radians;
      return std::pair{camera_.eye_distance * std::tan(std::max(angle - half, -limit)),
                       camera_.eye_distance * std::tan(std::min(angle + half, limit))};
    };
    const auto [x0, x1] = tangents(x);
    const auto [y0, y1] = tangents(y);
    return to_pixels(x0, x1, y0, y1);
  }

  void sort_into_tiles() {
    tiles_x_ = (settings_.width + tile_size - 1) / tile_size;
    tiles_y_ = (settings_.height + tile_size - 1) / tile_size;
    tile_objects_.resize(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_));
    for (int object = 0; object < substrate_object(); ++object) {
      const bool sphere = object < sphere_count();
      PixelBounds b;
      if (sphere) {
        const Sphere& s = scene_.spheres[static_cast<std::size_t>(object)];
        b = bounds_of(s.centre, s.radius);
      } else {
        const Connection& c = scene_.connections[static_cast<std::size_t>(object - sphere_count())];
        b = bounds_of(0.5 * (c.from + c.to), 0.5 * (c.to - c.from).norm() + c.radius);
      }
      bounds_.push_back(b);
      if (b.right < 0 || b.bottom < 0 || b.left > settings_.width || b.top > settings_.height) continue;
      const auto tile_of = [](double pixel, int tiles) {
        return static_cast<int>(std::clamp(std::floor(pixel / tile_size), 0.0, tiles - 1.0));
      };
      for (int ty = tile_of(b.top, tiles_y_); ty <= tile_of(b.bottom, tiles_y_); ++ty)
        for (int tx = tile_of(b.left, tiles_x_); tx <= tile_of(b.right, tiles_x_); ++tx)
          tile_objects_[static_cast<std::size_t>(ty * tiles_x_ + tx)].push_back(object);
    }
  }

  void meet_substrate(const Ray& ray, const Interval& kept, Hit& hit) const {
    for (const Box& box : scene_.substrate) {
      Interval inside = through_box(ray, box);
      if (kept.begin > inside.begin && kept.begin > -infinity) inside = {kept.begin, inside.end, 3 + kept.begin_face};
      inside.end = std::min({inside.end, kept.end, hit.distance});
      if (ground_ && inside.begin < inside.end && !ground_->below(ray.origin + (inside.begin + 1e-9) * ray.direction))
        inside = {ground_->entry(ray, inside), inside.end, 2};
      if (inside.begin < inside.end) hit = {inside.begin, substrate_object(), inside.begin_face};
    }
  }

  void draw_tile(int tile, Image& image) const {
    const int n = settings_.samples;
    const int x0 = tile % tiles_x_ * tile_size, y0 = tile / tiles_x_ * tile_size;
    const int columns = std::min(tile_size, settings_.width - x0) * n,
              rows = std::min(tile_size, settings_.height - y0) * n;
    const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    std::vector<Ray> rays(count);
    std::vector<Interval> kept(count);
    std::vector<Hit> hits(count);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const auto i = static_cast<std::size_t>(row * columns + column);
        rays[i] = ray_through(camera_, settings_, x0 + (column + 0.5) / n, y0 + (row + 0.5) / n);
        kept[i] = kept_part(rays[i], scene_.cuts, camera_.eye_distance > 0);
        if (!ground_) meet_substrate(rays[i], kept[i], hits[i]);
      }
    for (const int object : tile_objects_[static_cast<std::size_t>(tile)]) {
      const PixelBounds& b = bounds_[static_cast<std::size_t>(object)];
      const int first_row = std::max(0, static_cast<int>(std::floor((b.top - y0) * n - 0.5)));
      const int last_row = std::min(rows - 1, static_cast<int>(std::ceil((b.bottom - y0) * n - 0.5)));
      const int first_column = std::max(0, static_cast<int>(std::floor((b.left - x0) * n - 0.5)));
      const int last_column = std::min(columns - 1, static_cast<int>(std::ceil((b.right - x0) * n - 0.5)));
      for (int row = first_row; row <= last_row; ++row)
        for (int column = first_column; column <= last_column; ++column) {
          const auto i = static_cast<std::size_t>(row * columns + column);
          const Interval inside =
              object < sphere_count()
                  ? through_sphere(rays[i], scene_.spheres[static_cast<std::size_t>(object)])
                  : through_rod(rays[i],
                                scene_.connections[static_cast<std::size_t>(object - sphere_count())]);
          if (inside.begin > inside.end) continue;
          const bool on_cut = kept[i].begin > inside.begin;
          const double distance = on_cut ? kept[i].begin : inside.begin;
          if (distance < std::min(inside.end, kept[i].end) && distance < hits[i].distance)
            hits[i] = {distance, object, on_cut ? kept[i].begin_face : -1};
        }
    }
    if (ground_)  // last: what a particle hides need not be sought
      for (std::size_t i = 0; i < count; ++i) meet_substrate(rays[i], kept[i], hits[i]);
    for (int y = 0; y < rows / n; ++y)
      for (int x = 0; x < columns / n; ++x) {
        const auto bytes = to_srgb(pixel(x0 + x, y0 + y, x * n, y * n, columns, rays, kept, hits));
        std::copy(bytes.begin(), bytes.end(), image.at(x0 + x, y0 + y));
      }
  }

  // Mean colour of the surfaces in a pixel, each shaded once, at its sample nearest to the middle of its
  // samples.
  Colour pixel(int px, int py, int column0, int row0, int columns, const std::vector<Ray>& rays,
               const std::vector<Interval>& kept, const std::vector<Hit>& hits) const {
    const int n = settings_.samples;
    const auto at = [&](int k) {
      return static_cast<std::size_t>((row0 + k / n) * columns + column0 + k % n);
    };
    Colour sum;
    std::vector<char> done(static_cast<std::size_t>(n * n), 0);
    for (int k = 0; k < n * n; ++k) {
      if (done[static_cast<std::size_t>(k)]) continue;
      int members = 0;
      double mean_x = 0, mean_y = 0;
      for (int m = k; m < n * n; ++m)
        if (hits[at(m)].same_surface(hits[at(k)])) {
          done[static_cast<std::size_t>(m)] = 1;
          ++members, mean_x += m % n, mean_y += m / n;
        }
      mean_x /= members, mean_y /= members;
      int best = k;
      double best_distance = infinity;
      for (int m = k; m < n * n; ++m)
        if (hits[at(m)].same_surface(hits[at(k)])) {
          const double d = (m % n - mean_x) * (m % n - mean_x) + (m / n - mean_y) * (m / n - mean_y);
          if (d < best_distance) best = m, best_distance = d;
        }
      sum = sum + static_cast<double>(members) / (n * n) *
                      shade(px, py, rays[at(best)], kept[at(best)], hits[at(best)]);
    }
    return sum;
  }

  Colour shade(int, int py, const Ray& ray, const Interval& kept, const Hit& hit) const {
    const double down = (py + 0.5) / settings_.height;
    const Colour background = mix(settings_.background_top, settings_.background_bottom, down * down);
    Colour colour = background;
    if (hit.object >= 0)
      colour = hit.object == substrate_object() ? shade_substrate(ray, hit) : shade_particle(ray, hit);
    if (settings_.shading) colour = through_liquid(ray, kept, hit, colour);
    return colour;
  }

  Colour lit(const Vec3& normal, Colour base, const Illumination& light) const {
    const double key = std::max(0.0, normal.dot(to_key_));
    // Sky from above, a little from everywhere, and a weak light from the viewer, so that nothing drowns.
    const double sky =
        light.sky * (0.62 + 0.24 * normal.z() + 0.14 * std::max(0.0, -normal.dot(camera_.forward)));
    const Colour warm{1.00, 0.975, 0.93}, cool{0.91, 0.955, 1.0};
    // Between touching spheres light is scattered back and forth in their own colour: shadows keep some hue.
    const Colour bounced = 0.10 * (1 - light.sky) * (base * base);
    return 0.80 * key * light.key * (base * warm) + 0.62 * sky * (base * cool) + bounced;
  }

  Colour shade_particle(const Ray& ray, const Hit& hit) const {
    const Vec3 point = ray.origin + hit.distance * ray.direction;
    if (hit.object >= sphere_count()) {
      const Connection& rod = scene_.connections[static_cast<std::size_t>(hit.object - sphere_count())];
      if (!settings_.shading) return rod.colour;
      const Vec3 u = (rod.to - rod.from).normalized(),
                 radial = point - rod.from - (point - rod.from).dot(u) * u;
      return lit(radial.normalized(), rod.colour, Illumination{});
    }
    const Sphere& s = scene_.spheres[static_cast<std::size_t>(hit.object)];
    if (hit.face >= 0) return shade_cut(s, scene_.cuts[static_cast<std::size_t>(hit.face)], point);
    if (!settings_.shading) return s.colour;
    const Vec3 normal = (point - s.centre) / s.radius;
    const Illumination light = occluders_.light_at(point, normal, to_key_, hit.object);
    Colour colour = lit(normal, s.colour, light);
    // A soft highlight, and a rim that darkens slightly so that neighbours of one colour stay apart.
    const double facing = std::max(0.0, -normal.dot(ray.direction));
    const Vec3 halfway = (to_key_ - ray.direction).normalized();
    const double shine = std::pow(std::max(0.0, normal.dot(halfway)), 28);
    colour = (0.82 + 0.18 * std::min(1.0, facing * 2.2)) * colour;
    return colour + 0.10 * shine * light.key * Colour{1, 1, 1};
  }

  // A cut face: flat, paler than the surface, with a darker rim a pixel or two wide.
  Colour shade_cut(const Sphere& s, const CuttingPlane& cut, const Vec3& point) const {
    const Colour face = mix(s.colour, {1, 1, 1}, 0.10);
    if (!settings_.shading) return face;
    const double height = cut.normal.dot(s.centre) - cut.offset;
    const Vec3 middle = s.centre - height * cut.normal;
    const double face_radius = std::sqrt(std::max(0.0, s.radius * s.radius - height * height));
    const double pixel_size = camera_.width / settings_.width;
    const double from_rim = (face_radius - (point - middle).norm()) / pixel_size;
    const double light = 0.96 + 0.10 * std::max(0.0, cut.normal.dot(to_key_));
    const double rim =
        std::clamp(1 - from_rim / 2.2, 0.0, 1.0) * std::min(1.0, face_radius / (6 * pixel_size));
    return light * (1 - 0.55 * rim) * face;
  }

  Colour shade_substrate(const Ray& ray, const Hit& hit) const {
    static const Colour paper = from_srgb(222, 214, 200);
    if (!settings_.shading) return paper;
    const Box& box = scene_.substrate.front();
    const Vec3 point = ray.origin + hit.distance * ray.direction;
    Vec3 normal;
    if (hit.face >= 3) {
      normal = scene_.cuts[static_cast<std::size_t>(hit.face - 3)].normal;
    } else {
      normal = Vec3::Zero();
      normal[hit.face] = ray.direction[hit.face] > 0 ? -1 : 1;
    }
    const bool upper_face = hit.face == 2 && normal.z() > 0;
    if (upper_face && ground_) normal = ground_->normal(point);
    const double depth = (box.upper.z() - point.z()) / std::max(1e-12, box.upper.z() - box.lower.z());
    const Colour base = upper_face ? paper : (1 - 0.28 * std::clamp(depth, 0.0, 1.0)) * paper;
    return lit(normal, base, upper_face ? occluders_.light_at(point, normal, to_key_, -1) : Illumination{});
  }

  // The liquid tints what lies in it by the length of the line of sight through it: also a depth cue.
  Colour through_liquid(const Ray& ray, const Interval& kept, const Hit& hit, Colour colour) const {
    static const Colour water = from_srgb(208, 226, 240);
    for (const Box& box : scene_.liquid) {
      const Interval inside = through_box(ray, box);
      const double begin = std::max(inside.begin, kept.begin),
                   end = std::min({inside.end, kept.end, hit.distance});
      if (!(end > begin)) continue;
      const double depth = (box.upper - box.lower).head<2>().maxCoeff();
      colour = mix(colour, water, 0.55 * (1 - std::exp(-1.1 * (end - begin) / depth)));
      // The free surface seen from above catches a little sky.
      if (inside.begin_face == 2 && inside.begin >= kept.begin && ray.direction.z() < 0)
        colour = mix(colour, {1, 1, 1}, 0.10);
    }
    return colour;
  }
};

}  // namespace

Camera Camera::side() { return {Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY(), Vec3::Zero()}; }
Camera Camera::top() { return {Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitZ(), Vec3::Zero()}; }
Camera Camera::oblique(double azimuth, double elevation) {
  const double a = azimuth * radians, e = elevation * radians;
  const Vec3 forward(std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), -std::sin(e));
  const Vec3 right(std::cos(a), -std::sin(a), 0);
  return {right, right.cross(forward), forward, Vec3::Zero()};
}

void Camera::frame(const Box& box, int width_pixels, int height_pixels, double margin) {
  const auto corner = [&](int k) {
    return Vec3(k & 1 ? box.upper.x() : box.lower.x(), k & 2 ? box.upper.y() : box.lower.y(),
                k & 4 ? box.upper.z() : box.lower.z());
  };
  target = 0.5 * (box.lower + box.upper);
  // With perspective a shift of the target changes what is seen a little: a few rounds settle it.
  for (int round = 0; round < (eye_distance > 0 ? 8 : 1); ++round) {
    Eigen::Vector2d low(infinity, infinity), high = -low;
    for (int k = 0; k < 8; ++k) {
      const Vec3 d = corner(k) - target;
      const double nearer =
          eye_distance > 0 ? eye_distance / std::max(0.05 * eye_distance, eye_distance + d.dot(forward)) : 1;
      const Eigen::Vector2d p = nearer * Eigen::Vector2d(d.dot(right), d.dot(up));
      low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
    const Eigen::Vector2d middle = 0.5 * (low + high), size = high - low;
    target += middle.x() * right + middle.y() * up;
    width = std::max({size.x(), size.y() * width_pixels / height_pixels, 1e-6}) / (1 - 2 * margin);
  }
}

std::pair<double, double> Camera::project(const Vec3& point, int width_pixels, int height_pixels) const {
  const Vec3 d = point - target;
  double scale = width_pixels / width;
  if (eye_distance > 0) scale *= eye_distance / std::max(1e-9, eye_distance + d.dot(forward));
  return {0.5 * width_pixels + scale * d.dot(right), 0.5 * height_pixels - scale * d.dot(up)};
}

Image render(const SphereScene& scene, const Camera& camera, const RenderSettings& settings) {
  return Renderer(scene, camera, settings).image();
}

}  // namespace pigment::report
