#pragma once
// What a particle is and never changes during a run: arrays of one length.
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "base/vec.h"
#include "model/cell.h"
#include "model/height_field.h"

namespace pigment {

struct Particles {
  std::vector<double> radius;        // um
  std::vector<double> mass;          // pN ms^2/um
  std::vector<int> species;          // index into the scene's list of species
  std::vector<std::int64_t> id;      // the particle's name, kept through every tool

  std::size_t size() const { return radius.size(); }
  static double sphere_volume(double a) { return 4.0 / 3.0 * std::numbers::pi * a * a * a; }
};

// A layer at one instant: what a packing file or one frame of a trajectory holds.
struct Layer {
  Cell cell;
  Particles particles;
  Vec3Array position;  // x and y unwrapped
  std::shared_ptr<const HeightField> substrate = nullptr;  // null: the plane z = 0
};

}  // namespace pigment
