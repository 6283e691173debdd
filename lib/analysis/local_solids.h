#pragma once
// The space that belongs to each particle, and how much of it the particle fills: Laguerre cells (power diagram,
// [aurenhammer1987]), which no sphere leaves, whatever the sizes.
#include <cstdint>
#include <vector>

#include "analysis/frames.h"

namespace pigment::analysis {

// One entry a particle. Cells end at the substrate and at the surface; they fill the layer between.
struct LocalSolids {
  std::vector<double> cell_volume;         // um^3; 0 for a particle without a cell, wholly outside the layer
  std::vector<double> solids_fraction;     // the sphere's volume in the layer over its cell's; 0 without a cell
  std::vector<std::int64_t> cell_neighbours;  // faces that its cell shares with other particles' cells
};

// Positions must be finite. Overlapping spheres may leave their cells, and their fraction may exceed 1.
LocalSolids local_solids(const Snapshot&, const std::vector<double>& radius);

}  // namespace pigment::analysis
