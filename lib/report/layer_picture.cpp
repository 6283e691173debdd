#include "report/layer_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/stroke_font.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

constexpr double ball_radius = 0.28, rod_radius = 0.14;  // of a picture of connections, over the particle's
const Colour ink = from_srgb(38, 44, 54), soft_ink = from_srgb(92, 100, 112);

Camera direction_of(const PictureSettings& s) {
  return s.view == View::Side  ? Camera::side()
         : s.view == View::Top ? Camera::top()
                               : Camera::oblique(s.azimuth, s.elevation);
}

Camera camera_for(const PictureSettings& s, const Box& shown, int height) {
  Camera camera = direction_of(s);
  if (s.view == View::Oblique && s.perspective)
    camera.eye_distance = 3.2 * (shown.upper - shown.lower).norm();
  camera.frame(shown, s.width, height);
  return camera;
}

std::vector<CuttingPlane> planes_of(const std::vector<AxisCut>& cuts, const Camera& camera) {
  std::vector<CuttingPlane> planes;
  for (const AxisCut& cut : cuts) {
    Vec3 out = Vec3::Zero();
    // Out of the kept part: towards the viewer unless the cut says so; a plane seen edge-on keeps what is
    // below.
    double sign = cut.keep == AxisCut::Keep::Above ? -1 : 1;
    if (cut.keep == AxisCut::Keep::AwayFromViewer && camera.forward[cut.axis] > 1e-9) sign = -1;
    out[cut.axis] = sign;
    planes.push_back({out, sign * cut.position});
  }
  return planes;
}

// Wrapped spheres: each centre inside the cell, and for sawn blocks also every image that reaches into it.
// shown_radius: over the true one.
std::vector<Sphere> spheres_of(const Layer& layer, const ParticleColours& colours, const PictureSettings& s,
                               int repeat_x, int repeat_y, double shown_radius) {
  std::vector<Sphere> spheres;
  const Cell& cell = layer.cell;
  for (std::size_t i = 0; i < layer.position.size(); ++i) {
    if (!colours.hidden.empty() && colours.hidden[i]) continue;
    const Vec3 p = cell.wrap(layer.position[i]);
    const double a = shown_radius * layer.particles.radius[i];
    const int extra = s.sawn ? 1 : 0;
    for (int ix = -extra; ix < repeat_x + extra; ++ix)
      for (int iy = -extra; iy < repeat_y + extra; ++iy) {
        const Vec3 q = p + Vec3(ix * cell.width_x, iy * cell.width_y, 0);
        if (q.x() + a < 0 || q.y() + a < 0 || q.x() - a > repeat_x * cell.width_x ||
            q.y() - a > repeat_y * cell.width_y)
          continue;
        spheres.push_back({q, a, colours.of(i)});
      }
  }
  return spheres;
}

// Rods from middle to middle; one that crosses a side of the cell as two halves, each from its own particle. As many
// copies as of the spheres.
std::vector<Connection> rods_of(const Layer& layer, const std::vector<ParticleLink>& links, double farthest,
                                const std::vector<char>& hidden, int repeat_x, int repeat_y) {
  std::vector<Connection> rods;
  const Cell& cell = layer.cell;
  for (const ParticleLink& link : links) {
    if (!hidden.empty() && (hidden[link.first] || hidden[link.second])) continue;
    const Vec3 d = cell.minimum_image(layer.position[link.second] - layer.position[link.first]);
    const Vec3 a = cell.wrap(layer.position[link.first]), b = cell.wrap(layer.position[link.second]);
    const double radius =
        rod_radius * std::min(layer.particles.radius[link.first], layer.particles.radius[link.second]);
    const Colour colour = near_to_far(std::max(0.0, link.separation) / farthest);
    const bool crosses = (b - a - d).norm() > 1e-9 * cell.width_x;
    for (int ix = 0; ix < repeat_x; ++ix)
      for (int iy = 0; iy < repeat_y; ++iy) {
        const Vec3 shift(ix * cell.width_x, iy * cell.width_y, 0);
        if (!crosses) {
          rods.push_back({a + shift, b + shift, radius, colour});
        } else {
          rods.push_back({a + shift, a + 0.5 * d + shift, radius, colour});
          rods.push_back({b + shift, b - 0.5 * d + shift, radius, colour});
        }
      }
  }
  return rods;
}

void draw_scale_bar(Image& image, const Camera& camera, double left, double bottom, double text_height) {
  const double pixel = camera.width / image.width;
  const double length = round_below(0.28 * camera.width), pixels = length / pixel;
  const double y = bottom - 0.35 * text_height;
  draw_line(image, left, y, left + pixels, y, std::max(2.5, 0.3 * text_height), ink);
  const std::string text = length >= 1 ? number_text(length) + " µm" : number_text(1000 * length) + " nm";
  draw_text(image, left, y - 0.9 * text_height, text, text_height, ink);
}

void draw_colour_bar(Image& image, const ParticleColours& colours, double left, double right, double bottom,
                     double text_height) {
  if (!colours.categories.empty()) {
    double x = right;
    for (std::size_t i = colours.categories.size(); i-- > 0;) {
      const double width = text_width(colours.categories[i], text_height);
      draw_text(image, x - width, bottom, colours.categories[i], text_height, ink);
      draw_line(image, x - width - 1.3 * text_height, bottom - 0.5 * text_height,
                x - width - 1.3 * text_height, bottom - 0.5 * text_height, 1.1 * text_height, categorical(i));
      x -= width + 3.2 * text_height;
    }
    return;
  }
  if (colours.map == ParticleColours::Map::Identity) {
    draw_text(image, right, bottom, colours.label, text_height, ink, TextAnchor::End);
    return;
  }
  const int x0 = static_cast<int>(left), x1 = static_cast<int>(right);
  const int y1 = static_cast<int>(bottom - 1.75 * text_height),
            y0 = static_cast<int>(y1 - 0.85 * text_height);
  for (int x = x0; x < x1; ++x)
    for (int y = y0; y < y1; ++y) image.blend(x, y, colours.on_scale((x + 0.5 - x0) / (x1 - x0)), 1);
  const std::string title = colours.unit.empty() ? colours.label : colours.label + " (" + colours.unit + ")";
  draw_text(image, right, y0 - 0.6 * text_height, title, text_height, ink, TextAnchor::End);
  const int wanted = std::max(2, static_cast<int>((right - left) / (5 * text_height)));
  const Ticks ticks = scale_ticks(colours, wanted);
  double last_end = -1e9;
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double x = x0 + (x1 - x0) * colours.position(ticks.values[i]);
    const double half = 0.5 * text_width(ticks.labels[i], 0.9 * text_height);
    draw_line(image, x, y1, x, y1 + 0.3 * text_height, 1.2, soft_ink);
    if (x - half < last_end + 0.5 * text_height || x + half > image.width) continue;
    draw_text(image, x, bottom, ticks.labels[i], 0.9 * text_height, soft_ink, TextAnchor::Middle);
    last_end = x + half;
  }
}

// The free surface where the camera looks along it: a thin line, spheres through it stay in front.
void draw_surface_line(Image& image, const Camera& camera, const Box& liquid, int height) {
  const auto [x0, y0] =
      camera.project({liquid.lower.x(), liquid.lower.y(), liquid.upper.z()}, image.width, height);
  const auto [x1, y1] =
      camera.project({liquid.upper.x(), liquid.lower.y(), liquid.upper.z()}, image.width, height);
  draw_line(image, x0, y0, x1, y1, 1.4, from_srgb(70, 130, 190), 0.75);
}

// What a picture shows beside the particles.
struct Overlay {
  const std::vector<ParticleLink>* links = nullptr;
  double farthest = 0;
  double shown_radius = 1;  // of the particles, over the true one
};

Image draw(const Layer& layer, const ParticleColours& colours, const Overlay& overlay, const PictureSettings& s) {
  const Cell& cell = layer.cell;
  // From the side a second copy stands behind the first, so that gaps show particles and not the backdrop; where only
  // some are drawn, gaps are to be seen.
  const bool all_drawn = overlay.links == nullptr && colours.hidden.empty();
  const int repeat_x = std::max(1, s.repeat),
            repeat_y = s.view != View::Side ? repeat_x : s.sawn || !all_drawn ? 1 : 2;
  const double wide = repeat_x * cell.width_x, deep = repeat_y * cell.width_y;
  double top = cell.height;
  for (std::size_t i = 0; i < layer.position.size(); ++i)
    top = std::max(top, layer.position[i].z() + layer.particles.radius[i]);
  const double shown_top = s.framed_height.value_or(top);
  const double slab = std::max(0.035 * shown_top, 0.01 * wide);
  const double text_height =
      s.text_scale * std::clamp(0.017 * std::min(1.4 * s.width, 1.0 * s.height + 200), 9.0, 26.0);
  const bool footer = s.scale_bar || s.colour_bar;
  const int footer_height = footer ? static_cast<int>(5.4 * text_height) : 0;
  const int header_height = s.caption.empty() ? 0 : static_cast<int>(2.6 * text_height);
  const int body_height = std::max(16, s.height - footer_height - header_height);

  SphereScene scene;
  scene.spheres = spheres_of(layer, colours, s, repeat_x, repeat_y, overlay.shown_radius);
  if (overlay.links != nullptr)
    scene.connections = rods_of(layer, *overlay.links, overlay.farthest, colours.hidden, repeat_x, repeat_y);
  // Whole spheres stand out of the cell's faces by up to the largest radius: so do substrate and liquid, in
  // every frame alike.
  double overhang = 0;
  if (!s.sawn)
    for (const double a : layer.particles.radius) overhang = std::max(overhang, a);
  const Box around{{-overhang, -overhang, 0}, {wide + overhang, deep + overhang, cell.height}};
  Box shown = around;
  shown.lower.z() = s.substrate ? -slab : 0.0;
  shown.upper.z() = shown_top;
  scene.cuts = planes_of(s.cuts, direction_of(s));
  for (const CuttingPlane& cut : scene.cuts)  // what is cut away needs no room
    for (int k = 0; k < 3; ++k) {
      if (cut.normal[k] > 0) shown.upper[k] = std::clamp(cut.offset, shown.lower[k], shown.upper[k]);
      if (cut.normal[k] < 0) shown.lower[k] = std::clamp(-cut.offset, shown.lower[k], shown.upper[k]);
    }
  const Camera camera = camera_for(s, shown, body_height);
  if (s.sawn) {
    scene.cuts.push_back({-Vec3::UnitX(), 0});
    scene.cuts.push_back({Vec3::UnitX(), wide});
    scene.cuts.push_back({-Vec3::UnitY(), 0});
    scene.cuts.push_back({Vec3::UnitY(), deep});
  }
  if (s.substrate) {
    scene.substrate.push_back(around);
    scene.substrate.back().lower.z() = -slab, scene.substrate.back().upper.z() = layer.substrate ? layer.substrate->crest() : 0;
    scene.ground = layer.substrate;
  }
  if (s.surface) scene.liquid.push_back(around);

  RenderSettings settings;
  settings.width = s.width, settings.height = body_height, settings.samples = s.samples;
  const Image body = render(scene, camera, settings);
  Image image(s.width, s.height, settings.background_bottom);
  for (int y = 0; y < header_height; ++y)
    for (int x = 0; x < s.width; ++x) image.blend(x, y, settings.background_top, 1);
  Image framed = body;
  if (s.surface && s.view == View::Side) draw_surface_line(framed, camera, scene.liquid.front(), body_height);
  image.paste(framed, 0, header_height);

  const double margin = 1.6 * text_height, bottom = s.height - 1.3 * text_height;
  if (!s.caption.empty()) draw_text(image, margin, 1.9 * text_height, s.caption, 1.1 * text_height, ink);
  if (s.scale_bar && camera.eye_distance <= 0) draw_scale_bar(image, camera, margin, bottom, text_height);
  if (s.colour_bar) {
    const double length = std::clamp(0.4 * s.width, 60.0, 26 * text_height);
    const double right = s.width - margin - 0.6 * text_height;  // room for half of the last number
    draw_colour_bar(image, colours, right - length, right, bottom, text_height);
  }
  return image;
}

}  // namespace

Image draw_layer(const Layer& layer, const ParticleColours& colours, const PictureSettings& s) {
  return draw(layer, colours, {}, s);
}

Image draw_connections(const Layer& layer, const std::vector<ParticleLink>& links, double farthest,
                       const std::vector<char>& hidden, const PictureSettings& s) {
  ParticleColours colours{"surface separation", "nm", std::vector<double>(layer.position.size(), 0.0), 0,
                          1000 * farthest, false, {}};
  colours.map = ParticleColours::Map::NearToFar;
  colours.pale.assign(layer.position.size(), 1);
  colours.hidden = hidden;
  return draw(layer, colours, {&links, farthest, ball_radius}, s);
}

Image contact_sheet(const std::vector<Image>& pictures, int columns) {
  if (pictures.empty()) return Image(1, 1);
  const int gap = 12;
  const int count = static_cast<int>(pictures.size());
  const int width = pictures.front().width, height = pictures.front().height;
  // Left to itself the sheet comes out about 3 wide by 2 high.
  if (columns <= 0) columns = static_cast<int>(std::lround(std::sqrt(1.5 * count * height / width)));
  columns = std::clamp(columns, 1, count);
  const int rows = (count + columns - 1) / columns;
  Image sheet(columns * width + (columns + 1) * gap, rows * height + (rows + 1) * gap);
  for (int i = 0; i < count; ++i)
    sheet.paste(pictures[static_cast<std::size_t>(i)], gap + i % columns * (width + gap),
                gap + i / columns * (height + gap));
  return sheet;
}

}  // namespace pigment::report
