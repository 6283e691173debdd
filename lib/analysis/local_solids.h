#pragma once
// The space that belongs to each particle, and how much of it the particle fills: Laguerre cells (power diagram,
// [aurenhammer1987]), which no sphere leaves, whatever the sizes.
#include <cstdint>
#include <vector>

#include "analysis/frames.h"
#include "model/layer_measures.h"

namespace pigment::analysis {

// One entry a particle. Cells end at the substrate and at the surface; they fill the layer between.
struct LocalSolids {
  std::vector<double> cell_volume;         // um^3; 0 for a particle without a cell, wholly outside the layer
  std::vector<double> solids_fraction;     // the sphere's volume in the layer over its cell's; 0 without a cell
  std::vector<std::int64_t> cell_neighbours;  // faces that its cell shares with other particles' cells
  std::vector<double> surrounding_fraction;   // the same of its cell and those that share a face with it, taken together
  // Particles whose cells share a face with that of particle i: begin[i] to begin[i + 1] - 1; one that does so over a
  // periodic side too stands twice.
  std::vector<std::size_t> begin;
  std::vector<std::int32_t> neighbour;
};

// Positions must be finite. Overlapping spheres may leave their cells, and their fraction may exceed 1.
LocalSolids local_solids(const Snapshot&, const std::vector<double>& radius);

// The filter cake as the dense part of the layer, column by column: particles whose surrounding is at least `cake_solids`
// full and that hang together, from cell to cell, with such a particle that reaches into the lowest `wall_layer` um.
struct LocalCake {
  std::vector<double> height;  // um, of the highest such sphere on each column's axis; 0 where there is none
  double mean_height = 0;      // um
  double roughness = 0;        // um, standard deviation of the height
};
LocalCake local_cake(const Snapshot&, const std::vector<double>& radius, const LocalSolids&, double cake_solids,
                     double wall_layer, const ColumnGrid&);

}  // namespace pigment::analysis
