// A layer's picture: wrapped images, frames of a sequence at one scale, colours, PNG bytes.
#include "report/layer_picture.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "base/error.h"
#include "lib/report/synthetic_layer.h"
#include "report/png_image.h"
#include "report/stroke_font.h"

namespace pigment::report {
namespace {

Layer one_sphere(Vec3 at) {
  Layer layer;
  layer.cell = {4, 4, 4};
  layer.particles.radius = {0.5};
  layer.particles.species = {0};
  layer.particles.id = {0};
  layer.particles.mass = {0};
  layer.position = {at};
  return layer;
}

PictureSettings small() {
  PictureSettings s;
  s.width = s.height = 200;
  s.scale_bar = s.colour_bar = false;
  return s;
}

// Seen from above, a rough substrate's face shows light and shade; from the side, cut, its outline stands at its height.
TEST(LayerPicture, RoughSubstrateIsDrawnWhereItStands) {
  Layer flat = one_sphere({1, 1, 3}), rough = flat;
  rough.substrate = std::make_shared<const HeightField>(height_map({1.6, 4, {}}), rough.cell);  // its crest over (0, 0), 0 over (2, 2)
  const auto colours = colours_by_size(flat.particles);
  PictureSettings s = small();
  s.surface = false;
  s.framed_height = 4;
  EXPECT_NE(draw_layer(flat, colours, s).rgb, draw_layer(rough, colours, s).rgb);
  // The cut through y = 2 looks at A (2 + cos kx - 1)/4: 0.8 um at x = 0 and 4, 0 in the middle.
  s.cuts = {{1, 2.0}};
  s.substrate = true;
  const Image image = draw_layer(rough, colours, s);
  const auto paper_top = [&](int x) {  // first row from above that is not backdrop (its blue is not below its red)
    for (int y = 0; y < image.height; ++y)
      if (image.at(x, y)[2] + 8 < image.at(x, y)[0]) return y;
    return image.height;
  };
  const double pixel = 5.0 / (0.94 * 200);  // the box is 5 um wide with the sphere's overhang, margins 3 %
  const int middle = paper_top(100), side = paper_top(100 - static_cast<int>(2 / pixel));
  EXPECT_NEAR((middle - side) * pixel, 0.8, 3 * pixel);
}

TEST(LayerPicture, UnwrappedPositionsAreWrapped) {
  const Layer inside = one_sphere({1, 2, 2}), elsewhere = one_sphere({1 + 12, 2 - 8, 2});
  const auto colours = colours_by_size(inside.particles);
  EXPECT_EQ(draw_layer(inside, colours, small()).rgb, draw_layer(elsewhere, colours, small()).rgb);
}

TEST(LayerPicture, SawnBlockShowsBothHalvesOfASphereAcrossTheFace) {
  // Centre on the face x = 0: half a sphere at each end, symmetric about the middle.
  const Layer layer = one_sphere({0, 2, 2});
  PictureSettings s = small();
  s.sawn = true, s.surface = s.substrate = false;
  const Image image = draw_layer(layer, colours_by_species(layer.particles, {"a"}), s);
  const auto is_sphere = [&](int x) { return image.at(x, 100)[2] < 200; };
  int left = 0, right = 0;
  for (int x = 0; x < 100; ++x) left += is_sphere(x), right += is_sphere(199 - x);
  EXPECT_GT(left, 15);
  EXPECT_NEAR(left, right, 1);
}

TEST(LayerPicture, OneScaleForASequence) {
  PictureSettings s = small();
  s.framed_height = 8;
  Layer layer = one_sphere({2, 2, 3});
  layer.cell.height = 8;
  const Image tall = draw_layer(layer, colours_by_size(layer.particles), s);
  layer.cell.height = 5;
  const Image low = draw_layer(layer, colours_by_size(layer.particles), s);
  // The substrate stands on the same row in both.
  const auto substrate_row = [](const Image& image) {
    for (int y = image.height - 1; y > 0; --y)
      if (image.at(100, y)[0] > image.at(100, y)[2] + 10) return y;
    return 0;
  };
  EXPECT_GT(substrate_row(tall), 150);
  EXPECT_EQ(substrate_row(tall), substrate_row(low));
}

TEST(LayerPicture, ColoursRunOverTheScale) {
  Particles p;
  p.radius = {0.1, 0.4, 1.6};
  const ParticleColours c = colours_by_size(p);
  EXPECT_EQ(to_hex(c.of(0)), to_hex(sequential(0)));
  EXPECT_EQ(to_hex(c.of(1)), to_hex(sequential(0.5)));  // logarithmic: 0.8 is the middle of 0.2 and 3.2
  EXPECT_EQ(to_hex(c.of(2)), to_hex(sequential(1)));
}

TEST(LayerPicture, OneSizeAndNoSpeciesDoNoHarm) {
  Layer layer = one_sphere({1, 1, 1});
  layer.particles.species.clear();
  PictureSettings s = small();
  s.colour_bar = s.scale_bar = true;
  EXPECT_NO_THROW(draw_layer(layer, colours_by_size(layer.particles), s));
  EXPECT_NO_THROW(draw_layer(layer, colours_by_species(layer.particles, {}), s));
  EXPECT_NO_THROW(draw_layer(layer, colours_by_speed("speed", {0.0}), s));
  s.width = s.height = 64;
  EXPECT_NO_THROW(draw_layer(layer, colours_by_size(layer.particles), s));
}

TEST(Colour, SequentialScaleGetsLighterEvenly) {
  // Luminance must rise all the way: order survives a black-and-white print.
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const Colour c = sequential(i / 100.0);
    const double luminance =
        0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;  // of linear sRGB, IEC 61966-2-1
    EXPECT_GT(luminance, before) << i;
    before = luminance;
  }
}

TEST(Colour, SrgbRoundTrip) {
  for (int v = 0; v < 256; ++v)
    EXPECT_EQ(to_srgb(from_srgb(v, 255 - v, v / 2)),
              (std::array<std::uint8_t, 3>{std::uint8_t(v), std::uint8_t(255 - v), std::uint8_t(v / 2)}));
  EXPECT_EQ(to_hex(from_srgb(31, 119, 180)), "#1f77b4");
}

TEST(Png, HeaderSaysTheSizeAndTheEndIsThere) {
  const std::string png = encode_png(Image(300, 7));
  ASSERT_GT(png.size(), 40u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\x01\x2c\0\0\0\x07", 8));
  EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
  EXPECT_EQ(png.find("tIME"), std::string::npos);
}

TEST(Png, UnwritablePlaceIsAnOutputError) {
  EXPECT_THROW(write_png("/nowhere/at/all.png", Image(4, 4)), OutputError);
  EXPECT_THROW(write_png("/", Image(4, 4)), OutputError);
}

TEST(StrokeFont, EveryLetterOfTheLabelsDiffers) {
  std::set<std::string> seen;
  const std::string letters = "0123456789ABCDEFGHJKLMNOPQRSTUVWXYZabcdefghijkmnopqrstuvwxyz.,:;-+=()/|%<>_";
  for (const char c : letters) {
    Image image(40, 40);
    draw_text(image, 8, 28, std::string(1, c), 20, {0, 0, 0});
    EXPECT_TRUE(seen.insert(encode_png(image)).second) << c;
  }
  Image missing(40, 40), also(40, 40);
  draw_text(missing, 8, 28, "\xe2\x98\x83", 20, {0, 0, 0});  // a snowman: not in the alphabet
  draw_text(also, 8, 28, "#", 20, {0, 0, 0});
  EXPECT_EQ(missing.rgb, also.rgb);
}

TEST(StrokeFont, WidthIsWhatItDraws) {
  Image image(400, 60);
  const std::string text = "diameter (µm) 0.25";
  draw_text(image, 20, 40, text, 18, {0, 0, 0});
  int first = 400, last = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 400; ++x)
      if (image.at(x, y)[0] < 200) first = std::min(first, x), last = std::max(last, x);
  EXPECT_NEAR(first, 20, 3);
  EXPECT_NEAR(last, 20 + text_width(text, 18), 4);
}

TEST(ContactSheet, HoldsEveryPicture) {
  const Image sheet =
      contact_sheet({Image(30, 20, {1, 0, 0}), Image(30, 20, {0, 1, 0}), Image(30, 20, {0, 0, 1})}, 2);
  int red = 0, green = 0, blue = 0;
  for (std::size_t i = 0; i < sheet.rgb.size(); i += 3) {
    red += sheet.rgb[i] == 255 && sheet.rgb[i + 1] == 0;
    green += sheet.rgb[i] == 0 && sheet.rgb[i + 1] == 255;
    blue += sheet.rgb[i] == 0 && sheet.rgb[i + 1] == 0;
  }
  EXPECT_EQ(red, 600);
  EXPECT_EQ(green, 600);
  EXPECT_EQ(blue, 600);
}

Layer three_spheres() {
  Layer layer = one_sphere({0.4, 2, 2});
  layer.particles.radius = {0.3, 0.3, 0.3};
  layer.particles.species = {0, 0, 0};
  layer.particles.id = {5, 6, 7};
  layer.particles.mass = {0, 0, 0};
  layer.position = {{0.4, 2, 2}, {3.6, 2, 2}, {2, 2, 3}};
  return layer;
}

// Whether any pixel is about as red (blue) as a rod that is near (far).
bool has_hue(const Image& image, int x0, int x1, bool red) {
  for (int y = 0; y < image.height; ++y)
    for (int x = x0; x < x1; ++x) {
      const int r = image.at(x, y)[0], b = image.at(x, y)[2];
      if (red ? r > b + 60 : b > r + 60) return true;
    }
  return false;
}

TEST(LayerPicture, ConnectionsRunFromRedToBlueAndOverThePeriodicSide) {
  // 0 and 1 meet across x, where half a rod sticks out at either side, in touch: red. 1 and 2 far apart: blue.
  const Layer layer = three_spheres();
  PictureSettings s = small();
  s.surface = s.substrate = false;
  const Image near = draw_connections(layer, {{0, 1, 0.0}}, 0.05, {}, s);
  EXPECT_TRUE(has_hue(near, 0, 60, true) && has_hue(near, 140, 200, true));
  EXPECT_FALSE(has_hue(near, 80, 120, true)) << "the rod goes through the cell, not across its side";
  EXPECT_FALSE(has_hue(near, 0, 200, false));
  const Image far = draw_connections(layer, {{1, 2, 0.05}}, 0.05, {}, s);
  EXPECT_TRUE(has_hue(far, 80, 200, false));
  EXPECT_FALSE(has_hue(far, 0, 200, true));
  // A rod to a particle that is not drawn is not drawn.
  const Image hidden = draw_connections(layer, {{0, 1, 0.0}, {1, 2, 0.05}}, 0.05, {0, 0, 1}, s);
  EXPECT_TRUE(has_hue(hidden, 0, 200, true));
  EXPECT_FALSE(has_hue(hidden, 0, 200, false));
}

TEST(LayerPicture, HiddenParticlesLeaveNoTrace) {
  const Layer layer = three_spheres();
  PictureSettings s = small();
  s.view = View::Top;
  auto colours = colours_by_size(layer.particles);
  colours.hidden = {1, 1, 1};
  const Image none = draw_layer(layer, colours, s);
  Layer moved = layer;
  moved.position[0].x() += 1;
  EXPECT_EQ(none.rgb, draw_layer(moved, colours, s).rgb);
  colours.hidden = {0, 1, 1};
  EXPECT_NE(none.rgb, draw_layer(layer, colours, s).rgb);
}

TEST(ParticleColours, ScalesSayMoreThanOneNumber) {
  for (const double low : {0.0, 3.0, 17.2})
    for (const double high : {19.0, 35.0, 99.0}) {
      ParticleColours c{"speed", "", {}, low, high, false, {}};
      EXPECT_GE(scale_ticks(c, 3).values.size(), 3u) << low << " to " << high;
      EXPECT_LE(scale_ticks(c, 3).values.size(), 8u);
    }
}

TEST(ParticleColours, OfClustersKeepThoseAloneApart) {
  const auto by_size = colours_by_cluster({1, 2, 40});
  EXPECT_EQ(by_size.low, 2);
  EXPECT_EQ(by_size.high, 40);
  const auto grey = to_srgb(by_size.of(0));
  EXPECT_LT(std::abs(grey[0] - grey[2]), 10);
  EXPECT_EQ(to_hex(by_size.of(1)), to_hex(sequential(0)));
  EXPECT_EQ(to_hex(by_size.of(2)), to_hex(sequential(1)));
  const auto identity = colours_by_cluster_identity({3, 4, 4, 9}, {2, 3, 3, 1});
  EXPECT_EQ(to_hex(identity.of(1)), to_hex(identity.of(2)));
  EXPECT_NE(to_hex(identity.of(0)), to_hex(identity.of(1)));
  EXPECT_EQ(to_hex(identity.of(3)), to_hex(by_size.of(0)));
  const auto member = colours_by_membership({1, 2, 40});
  EXPECT_NE(to_hex(member.of(0)), to_hex(member.of(1)));
  EXPECT_EQ(to_hex(member.of(1)), to_hex(member.of(2)));
}

}  // namespace
}  // namespace pigment::report
