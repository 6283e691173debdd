#pragma once
// Removal of overlaps: spheres that overlap push each other apart until none does.
#include <cstddef>
#include <functional>
#include <vector>

#include "base/vec.h"
#include "packing/slab.h"

namespace pigment::packing {

struct Relaxation {
  bool done = false;  // no overlap is left
  int steps = 0;
  double largest_overlap = 0;  // um
};

// Moves `centre` (x and y come back inside the period) until spheres of these radii do not overlap. The
// overlaps are harmonic springs whose energy is minimised by the fast inertial relaxation engine
// [bitzek2006], on radii that are a little larger, so that it ends in finitely many steps without any overlap
// of the radii given. Below the density of random close packing the energy falls to zero; not so above it:
// done is false then. The same result at any thread count.
Relaxation relax_overlaps(const Slab&, const std::vector<double>& radius, Vec3Array& centre,
                          const std::function<void(double largest_overlap)>& on_progress = {});

}  // namespace pigment::packing
