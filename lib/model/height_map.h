#pragma once
// The heights of a substrate that is not flat, over one period along x and y: from two numbers or from a table.
#include <cstddef>
#include <filesystem>
#include <vector>

#include "config/node.h"

namespace pigment {

// Heights at the points of an even grid, [i * count_y + j] at x = i period_x/count_x, y = j period_y/count_y. What lies between
// follows from them (model/height_field.h).
struct HeightMap {
  std::size_t count_x = 0, count_y = 0;
  double period_x = 0, period_y = 0;  // um
  std::vector<double> height;         // um
};

// substrate.roughness as a scene has it.
struct Roughness {
  double amplitude = 0;   // um, from the deepest point to the crests
  double wavelength = 0;  // um, along x and along y
  std::filesystem::path file;  // a table in their place; empty: none
};
// Keys: amplitude and wavelength, or file. The file is not opened.
Roughness read_roughness(config::Node);

// One period, moved up or down so that the deepest point of the surface is z = 0.
// Amplitude A and wavelength: A (2 + cos 2 pi x/wavelength + cos 2 pi y/wavelength)/4. Table: columns x [um], y [um], height [um], rows in
// any order, the points of an even grid of one period, which goes on after the last of them as it began; with a single y (or x) the
// surface is a row of ridges along it. Throws FileError, with file and line, for a table that is none of these.
HeightMap height_map(const Roughness&);

}  // namespace pigment
