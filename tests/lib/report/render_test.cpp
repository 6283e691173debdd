// Pictures against geometry: areas, order in depth, cuts, periodic images, and the same bytes at any thread
// count.
#include "report/render.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>

#include "lib/report/synthetic_layer.h"
#include "report/layer_picture.h"

namespace pigment::report {
namespace {

const Colour red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};

RenderSettings flat(int width, int height) {
  RenderSettings s;
  s.width = width, s.height = height, s.shading = false;
  s.background_top = s.background_bottom = {0, 0, 0};
  return s;
}

// Sum over pixels of the linear share of one channel (0 red, 1 green, 2 blue): the area it covers, in pixels.
double covered(const Image& image, int channel) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.at(x, y);
      const Colour c = from_srgb(p[0], p[1], p[2]);
      sum += channel == 0 ? c.red : channel == 1 ? c.green : c.blue;
    }
  return sum;
}

Camera looking(Camera camera, double width, Vec3 target = Vec3::Zero()) {
  camera.width = width, camera.target = target;
  return camera;
}

TEST(Render, SphereCoversItsCircle) {
  SphereScene scene;
  scene.spheres = {{{0.3, 5, -0.2}, 1.5, red}};
  for (const Camera& view : {Camera::side(), Camera::top(), Camera::oblique(40, 30)}) {
    const Camera camera = looking(view, 10, scene.spheres[0].centre);
    const double area = covered(render(scene, camera, flat(300, 200)), 0);
    const double radius = 1.5 * 300 / 10;
    // Counting grid points in a circle: the error is of the order of the square root of the rim's samples
    // (here 9 a pixel); 0.2 % is three times that.
    EXPECT_NEAR(area / (std::numbers::pi * radius * radius), 1, 2e-3);
  }
}

TEST(Render, PerspectiveSphereCoversItsCone) {
  // A sphere on the axis at distance d shows the disc of its tangent cone: radius f r / sqrt(d^2 - r^2).
  SphereScene scene;
  scene.spheres = {{{0, 2, 0}, 1, red}};
  Camera camera = looking(Camera::side(), 8);
  camera.eye_distance = 6;
  const double area = covered(render(scene, camera, flat(400, 400)), 0);
  const double radius = 6 / std::sqrt(8.0 * 8 - 1) * 400 / 8;
  EXPECT_NEAR(area / (std::numbers::pi * radius * radius), 1, 2e-3);
  // Off the axis it must not be cut off by the tiles it was sorted into: its ellipse grows by 1/cos, about.
  scene.spheres[0].centre = {2.5, 2, 1.5};
  EXPECT_GT(covered(render(scene, camera, flat(400, 400)), 0), area);
}

TEST(Render, NearerSphereHidesFarther) {
  SphereScene scene;
  scene.spheres = {{{0, 3, 0}, 1, red}, {{0, 0, 0}, 1, green}};
  const Camera camera = looking(Camera::side(), 4);
  Image image = render(scene, camera, flat(80, 80));
  EXPECT_EQ(covered(image, 0), 0);
  std::swap(scene.spheres[0].centre, scene.spheres[1].centre);
  image = render(scene, camera, flat(80, 80));
  EXPECT_EQ(covered(image, 1), 0);
}

TEST(Render, InterpenetratingSpheresMeetInTheirMiddlePlane) {
  // Two equal spheres side by side, seen from the side: each shows half of what is covered.
  SphereScene scene;
  scene.spheres = {{{-0.5, 0, 0}, 1, red}, {{0.5, 0, 0}, 1, green}};
  const Image image = render(scene, looking(Camera::side(), 4), flat(200, 200));
  EXPECT_NEAR(covered(image, 0), covered(image, 1), 1e-3 * covered(image, 0));
  // Union of two unit discs at distance 1: 2 pi - (2 pi/3 - sqrt(3)/2).
  const double expected = 2 * std::numbers::pi - (2 * std::numbers::pi / 3 - std::sqrt(3.0) / 2);
  EXPECT_NEAR((covered(image, 0) + covered(image, 1)) / 2500, expected, 3e-3 * expected);
}

TEST(Render, CutFillsTheFaceOfItsCircle) {
  SphereScene scene;
  scene.spheres = {{{0, 0, 0}, 1, red}};
  scene.cuts = {{-Vec3::UnitY(), 0.6}};  // keeps y >= -0.6: the cap before it is gone
  const Image image = render(scene, looking(Camera::side(), 4), flat(400, 400));
  // The whole disc stays covered; its middle is a flat face of radius sqrt(1 - 0.36) = 0.8 in a paler colour.
  double face = 0;
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) face += image.at(x, y)[1] > 60;
  EXPECT_NEAR(covered(image, 0) / 1e4, std::numbers::pi, 3e-3 * std::numbers::pi);
  EXPECT_NEAR(face / 1e4, std::numbers::pi * 0.64, 1e-2 * std::numbers::pi);
  // Cut beyond the sphere: gone altogether.
  scene.cuts = {{-Vec3::UnitY(), -1.01}};
  EXPECT_EQ(covered(render(scene, looking(Camera::side(), 4), flat(50, 50)), 0), 0);
  // Two cuts leave a wedge: a quarter, seen from the side as half a disc.
  scene.cuts = {{-Vec3::UnitY(), 0}, {Vec3::UnitX(), 0}};
  EXPECT_NEAR(covered(render(scene, looking(Camera::side(), 4), flat(400, 400)), 0) / 1e4,
              std::numbers::pi / 2, 1e-2);
}

TEST(Render, ConnectionsAreCylinders) {
  SphereScene scene;
  scene.connections = {{{-1, 0, 0}, {1, 0, 0}, 0.1, blue}};
  const Image image = render(scene, looking(Camera::side(), 4), flat(400, 400));
  EXPECT_NEAR(covered(image, 2) / 1e4, 2 * 0.2, 0.01);
}

TEST(Render, ShadowsDarkenButNeverBlacken) {
  SphereScene scene;
  scene.spheres = {{{0, 0, 0}, 1, {0.8, 0.8, 0.8}}, {{-0.9, -0.9, 1.1}, 0.6, {0.8, 0.8, 0.8}}};
  RenderSettings s;
  s.width = s.height = 120;
  const Camera camera = looking(Camera::side(), 5);
  const Image both = render(scene, camera, s);
  scene.spheres.pop_back();
  const Image alone = render(scene, camera, s);
  int darker = 0, black = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      darker += both.at(x, y)[1] + 10 < alone.at(x, y)[1];
      black += both.at(x, y)[1] < 8;
    }
  EXPECT_GT(darker, 50);
  EXPECT_EQ(black, 0);
}

TEST(Render, SameBytesAtAnyThreadCount) {
  const Layer layer = tests::synthetic_layer(800, 4, 6, 0.125, 0.6);
  PictureSettings s;
  s.width = 317, s.height = 411, s.view = View::Oblique;
  s.cuts = {{1, 1.5}};
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Image one = draw_layer(layer, colours_by_size(layer.particles), s);
  omp_set_num_threads(2);
  const Image two = draw_layer(layer, colours_by_size(layer.particles), s);
  omp_set_num_threads(before);
  EXPECT_EQ(one.rgb, two.rgb);
  EXPECT_EQ(encode_png(one), encode_png(two));
}

TEST(Camera, FramesWhatItShows) {
  const Box box{{0, 0, 0}, {5, 5, 20}};
  for (const double eye : {0.0, 60.0})
    for (Camera camera : {Camera::side(), Camera::top(), Camera::oblique()}) {
      camera.eye_distance = eye;
      camera.frame(box, 640, 480);
      for (int corner = 0; corner < 8; ++corner) {
        const auto [x, y] = camera.project(
            {corner & 1 ? 5.0 : 0.0, corner & 2 ? 5.0 : 0.0, corner & 4 ? 20.0 : 0.0}, 640, 480);
        EXPECT_TRUE(x >= 0 && x <= 640 && y >= 0 && y <= 480) << x << " " << y;
      }
    }
}

}  // namespace
}  // namespace pigment::report
