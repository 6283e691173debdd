#pragma once
// Monte-Carlo moves of hard spheres: takes a packing from however it was made to the equilibrium of a
// suspension.
#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec.h"
#include "packing/slab.h"

namespace pigment::packing {

struct Equilibration {
  double acceptance = 0;  // share of the moves that were accepted
};

// `sweeps` times, every sphere in turn tries one random displacement, accepted where it overlaps none
// [metropolis1953]. The lengths of the displacements, one a size class, are tuned to an acceptance of 0.4
// during the first half of the sweeps and then held, as detailed balance asks. No sphere overlaps another
// before or after.
Equilibration equilibrate(const Slab&, const std::vector<double>& radius, Vec3Array& centre, int sweeps,
                          std::uint64_t seed, const std::function<void(double fraction)>& on_progress = {});

}  // namespace pigment::packing
