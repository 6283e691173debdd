#pragma once
// Colours in linear light, and the maps from numbers to colours that pictures and plots share.
#include <array>
#include <cstdint>
#include <string>

namespace pigment::report {

struct Colour {
  double red = 0, green = 0, blue = 0;  // linear light, 0..1

  friend Colour operator+(Colour a, Colour b) { return {a.red + b.red, a.green + b.green, a.blue + b.blue}; }
  friend Colour operator*(Colour a, Colour b) { return {a.red * b.red, a.green * b.green, a.blue * b.blue}; }
  friend Colour operator*(double s, Colour a) { return {s * a.red, s * a.green, s * a.blue}; }
};
inline Colour mix(Colour a, Colour b, double weight_of_b) { return (1 - weight_of_b) * a + weight_of_b * b; }

// Between linear light and the 8-bit sRGB of files and screens (IEC 61966-2-1).
Colour from_srgb(int red, int green, int blue);
std::array<std::uint8_t, 3> to_srgb(Colour);
std::string to_hex(Colour);  // "#1f77b4"

// Lightness 0..1, chroma and hue (degrees) in Oklab; out-of-gamut colours lose chroma, never lightness.
Colour from_oklch(double lightness, double chroma, double hue);

// Dark violet through teal to light yellow, with lightness rising evenly: order survives greyscale and the
// common colour-vision deficiencies. position is clamped to 0..1.
Colour sequential(double position);
// Red (near, 0) through purple to blue (far, 1), evenly in Oklab. position is clamped to 0..1.
Colour near_to_far(double position);
// A tint of its own for each number: neighbouring numbers are far apart in hue.
Colour identity_tint(std::int64_t number);
// Colours of curves on light or on dark paper: hues apart, lightness uneven, so that they stay apart without colour vision
// and in print; they repeat after eight.
Colour series_colour(std::size_t index, bool on_dark);
// Distinct mineral tints of similar lightness, for species; they repeat after eight.
Colour categorical(std::size_t index);

}  // namespace pigment::report
