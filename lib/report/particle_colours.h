#pragma once
// What particles are coloured by.
#include <cstdint>
#include <string>
#include <vector>

#include "model/particles.h"
#include "report/colour.h"
#include "report/ticks.h"

namespace pigment::report {

// How numbers become colours: one value a particle. Categories (species) take tints of their own instead.
struct ParticleColours {
  enum class Map { Sequential, NearToFar, Identity };  // the last: every number its tint, and no scale
  std::string label;          // "diameter"
  std::string unit;           // "µm"
  std::vector<double> value;  // one a particle
  double low = 0, high = 1;   // ends of the scale
  bool logarithmic = false;
  std::vector<std::string> categories;  // not empty: value is an index into these
  Map map = Map::Sequential;
  std::vector<char> pale = {};    // one a particle, or empty: grey whatever its value
  std::vector<char> hidden = {};  // one a particle, or empty: not drawn

  Colour of(std::size_t particle) const;
  double position(double value) const;  // on the scale, 0..1 inside its ends
  Colour on_scale(double position) const;
};
// Round numbers along the scale; short logarithmic scales are told by their ends as well.
Ticks scale_ticks(const ParticleColours&, int wanted);
ParticleColours colours_by_size(const Particles&);
ParticleColours colours_by_species(const Particles&, const std::vector<std::string>& names);
ParticleColours colours_by_height(const Layer&, double highest);
// speed: one a particle, um/ms (= mm/s), shown in um/s; ends of the scale are its 2nd and 98th percentile.
ParticleColours colours_by_speed(const std::string& label, const std::vector<double>& speed);
// size: particles in each particle's cluster; single particles stay pale.
ParticleColours colours_by_cluster(const std::vector<double>& size);
// Clusters apart from one another: id as analysis/clusters.h has it; single particles stay pale.
ParticleColours colours_by_cluster_identity(const std::vector<std::int64_t>& id, const std::vector<std::int64_t>& size);
// Single particles light, clustered ones dark.
ParticleColours colours_by_membership(const std::vector<std::int64_t>& size);
// fraction: of its own space that each particle fills; ends of the scale are its 2nd and 98th percentile.
ParticleColours colours_by_local_solids(const std::vector<double>& fraction);

}  // namespace pigment::report
