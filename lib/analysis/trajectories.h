#pragma once
// The paths of chosen particles [sand2010] 3.5.2.
#include <cstdint>
#include <vector>

#include "analysis/frames.h"
#include "analysis/parameters.h"

namespace pigment::analysis {

struct Trajectories {
  std::vector<std::size_t> particle;  // indices
  std::vector<double> time;           // ms, a frame
  std::vector<double> thickness;      // um, a frame
  std::vector<Vec3Array> position;    // [frame][particle], um, x and y unwrapped
};

// Indices of the particles to follow, in the order asked for. Parameters that name none: in each height band of the
// first frame, of the finest size class that has particles there, the one nearest to the band's middle. Throws
// InputError for an id that no particle has.
std::vector<std::size_t> choose_particles(const Snapshot& first, const std::vector<double>& radius,
                                          const std::vector<std::int64_t>& id, const Parameters&);

// `numbers` rise.
Trajectories follow_particles(const Frames&, const std::vector<std::size_t>& numbers,
                              const std::vector<std::size_t>& particles);

}  // namespace pigment::analysis
