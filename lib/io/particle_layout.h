#pragma once
// The layout that packings and trajectories share, H5MD 1.1, written in one go from frames that come one at a
// time:
//   /h5md, /pigment, /provenance
//   /particles/layer/box               attributes dimension, boundary
//   /particles/layer/box/edges         value [frames, 3], step and time: those of position
//   /particles/layer/position          value [frames, N, 3], step [frames], time [frames]
//   /particles/layer/velocity, angular_velocity   value [frames, N, 3] in 32 bits, step and time likewise
//   /particles/layer/radius, mass, species, id    [N];  species_names [species]
//   /substrate/height, period          [points along x, along y], [2]: one period of a substrate that is not flat
//   /observables/NAME                  value [frames], step and time likewise
#include <functional>

#include "io/particle_file.h"
#include "io/trajectory_writer.h"

namespace pigment::io {

struct ParticleContent {
  std::string kind;                               // "packing", "trajectory"
  std::map<std::string, std::string> attributes;  // of /pigment
  const Particles* particles = nullptr;
  std::vector<std::string> species_names;
  bool velocities = false;
  std::vector<ObservableInfo> observables;
  std::size_t frame_count = 0;
  // Gives frame i and its observables; asked for in order.
  std::function<void(std::size_t, Frame&, std::vector<double>&)> frame;
  std::shared_ptr<const HeightField> substrate = nullptr;  // null: flat, nothing is written
  std::vector<Dataset> extra;
  Provenance provenance;
};
void write_particle_content(const std::filesystem::path&, const ParticleContent&);

}  // namespace pigment::io
