#pragma once
// Surface separations of near neighbours [sand2010] 3.5.3.
#include <cstdint>
#include <vector>

#include "analysis/frames.h"
#include "analysis/parameters.h"

namespace pigment::analysis {

// Pairs by surface separation. Overlapping spheres count as separated by 0.
struct Separations {
  double time = 0;                     // ms
  std::int64_t pairs = 0;              // closer than the limit, each counted once
  std::int64_t overlaps = 0;           // of these, pairs that overlap
  std::vector<double> count;           // a bin
  std::vector<double> density;         // 1/um; its integral over the bins is 1, or 0 without pairs
  double mean = 0;                     // um, of the pairs closer than the limit; 0 without any
  double smallest = 0;                 // um, negative where spheres overlap; the limit without pairs
  double neighbours_per_particle = 0;  // closer than the limit
  std::int64_t near_pairs = 0;         // closer than the near limit
  std::vector<double>
      near_cumulative;  // near edges: share of the near pairs closer than the edge (at edge 0: overlapping)
  std::vector<double> radial;  // g(r) of the centres, a radial bin (radial_distribution.h)
};

struct SeparationDevelopment {
  double limit = 0;                // um
  std::vector<double> edges;       // um, bins + 1, from 0 to the limit
  std::vector<double> near_edges;  // um, from 0 to the near limit
  std::vector<double> radial_edges;  // um, between centres
  std::vector<Separations> frames;
};

// Without a limit in the parameters it is the smallest diameter, so that no third particle fits between two
// neighbours. Without a radial limit it is three times the mean diameter by number, or half the period of the first
// frame if that is less.
SeparationDevelopment measure_separations(const Frames&, const std::vector<double>& radius,
                                          const Parameters&);

}  // namespace pigment::analysis
