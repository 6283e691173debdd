#include "report/colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pigment::report {
namespace {

double srgb_decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double srgb_encoded(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

// Oklab, [ottosson2020].
Colour from_oklab(double lightness, double a, double b) {
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool in_gamut(Colour c) {
  const auto inside = [](double v) { return v >= -1e-9 && v <= 1 + 1e-9; };
  return inside(c.red) && inside(c.green) && inside(c.blue);
}

}  // namespace

Colour from_srgb(int red, int green, int blue) {
  return {srgb_decoded(red / 255.0), srgb_decoded(green / 255.0), srgb_decoded(blue / 255.0)};
}

std::array<std::uint8_t, 3> to_srgb(Colour c) {
  const auto byte = [](double v) {
    return static_cast<std::uint8_t>(std::lround(255 * srgb_encoded(std::clamp(v, 0.0, 1.0))));
  };
  return {byte(c.red), byte(c.green), byte(c.blue)};
}

std::string to_hex(Colour c) {
  const auto [red, green, blue] = to_srgb(c);
  return fmt::format("#{:02x}{:02x}{:02x}", red, green, blue);
}

Colour from_oklch(double lightness, double chroma, double hue) {
  const double angle = hue * std::numbers::pi / 180;
  const auto at = [&](double c) { return from_oklab(lightness, c * std::cos(angle), c * std::sin(angle)); };
  double low = 0, high = chroma;
  if (in_gamut(at(high))) low = high;
  for (int i = 0; i < 24 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    (in_gamut(at(middle)) ? low : high) = middle;
  }
  const Colour c = at(low);
  return {std::clamp(c.red, 0.0, 1.0), std::clamp(c.green, 0.0, 1.0), std::clamp(c.blue, 0.0, 1.0)};
}

Colour sequential(double position) {
  const double t = std::clamp(position, 0.0, 1.0);
  // Hue runs from violet (300 degrees) down to yellow (100); chroma rises at both ends, where the gamut
  // allows it.
  const double lightness = 0.34 + 0.58 * t;
  const double hue = 300 - 205 * std::pow(t, 1.05);
  const double chroma = 0.125 + 0.035 * std::cos(2 * std::numbers::pi * t);
  return from_oklch(lightness, chroma, hue);
}

Colour near_to_far(double position) {
  const double t = std::clamp(position, 0.0, 1.0);
  return from_oklch(0.60 - 0.12 * t, 0.21 - 0.04 * t, 27 - 125 * t);
}

Colour identity_tint(std::int64_t number) {
  // Steps of the golden angle never come back near one another soon; two lightnesses part what still does.
  const double hue = std::fmod(137.50776405 * static_cast<double>(number), 360.0);
  return from_oklch(number % 2 == 0 ? 0.72 : 0.58, 0.13, hue);
}

Colour series_colour(std::size_t index, bool on_dark) {
  static constexpr double hues[8] = {252, 48, 158, 352, 88, 205, 300, 22};
  static constexpr double light_paper[8] = {0.52, 0.63, 0.50, 0.56, 0.66, 0.62, 0.46, 0.50};
  static constexpr double dark_paper[8] = {0.70, 0.74, 0.68, 0.70, 0.88, 0.80, 0.66, 0.62};
  const std::size_t i = index % 8;
  return from_oklch((on_dark ? dark_paper : light_paper)[i], i == 4 || i == 5 ? 0.115 : 0.15, hues[i]);
}

Colour categorical(std::size_t index) {
  struct Tint {
    double lightness, chroma, hue;
  };
  static constexpr std::array<Tint, 8> tints{{{0.86, 0.055, 85},     // ivory
                                              {0.62, 0.095, 245},    // slate blue
                                              {0.66, 0.125, 45},     // terracotta
                                              {0.70, 0.085, 165},    // sage
                                              {0.58, 0.110, 305},    // mauve
                                              {0.78, 0.110, 100},    // ochre
                                              {0.60, 0.120, 15},     // brick
                                              {0.74, 0.060, 215}}};  // mist
  const Tint& t = tints[index % tints.size()];
  return from_oklch(t.lightness, t.chroma, t.hue);
}

}  // namespace pigment::report
