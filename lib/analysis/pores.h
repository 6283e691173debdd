#pragma once
// The space between the particles of a layer: how much there is, and how wide it is.
#include <vector>

#include "analysis/frames.h"

namespace pigment::analysis {

// Of the space between substrate and surface. Spheres that overlap count twice in volume and area.
struct Pores {
  double porosity = 0;            // share that is not solid
  double specific_surface = 0;    // 1/um, area of the particles over that space
  double hydraulic_diameter = 0;  // um, four times the volume of the pores over the area of the particles; 0 without
  // For points at random in the pores, the distance to the nearest particle's surface (the pore size function of
  // [torquato2002]), um, rising. A sphere of this radius about the point fits into the pore. The substrate is no
  // obstacle: liquid goes through it.
  std::vector<double> distance;
  double mean_distance() const;
};

// `points` are put into the layer at random, the same ones in every call; those inside particles are left out.
Pores measure_pores(const Snapshot&, const std::vector<double>& radius, std::size_t points);

}  // namespace pigment::analysis
