#pragma once
// Random sequential insertion, largest first: each sphere goes to the first random place where it overlaps
// none before.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec.h"
#include "packing/slab.h"

namespace pigment::packing {

struct Insertion {
  Vec3Array centre;
  std::size_t overlapping =
      0;  // spheres that found no free place and stand at the least overlapping one that was tried
};

// radius: um, falling. Every sphere must fit between the planes.
Insertion insert_largest_first(const Slab&, const std::vector<double>& radius, std::uint64_t seed,
                               const std::function<void(double fraction)>& on_progress = {});

}  // namespace pigment::packing
