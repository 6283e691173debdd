#pragma once
// Where the solids of a layer are: profiles over its thickness, by size class, and what follows from them
// [sand2010] 3.5.1.
#include <optional>
#include <vector>

#include "analysis/frames.h"
#include "analysis/parameters.h"
#include "model/layer_measures.h"

namespace pigment::analysis {

// Of the particles of a size class or a species. One entry a slice. A particle counts in the slice that holds its centre (those above the surface in none);
// volumes are shared exactly.
struct GroupProfile {
  std::vector<double> volume_fraction;  // the group's volume over the slice's volume
  std::vector<double> mass_fraction;    // the group's mass over the slice's mass, liquid included
  std::vector<double>
      solids_fraction;  // the group's volume over the slice's solid volume; 0 in a slice without solids
  std::vector<double> number;           // particles
  std::vector<double> number_fraction;  // of the slice's particles; 0 in a slice without particles
  std::vector<double> share;  // of the group's particles in the layer; sums to 1 (0 for an empty group)
};

struct SolidsProfile {
  double time = 0;                       // ms
  std::vector<double> edges;             // um, slices + 1, from the substrate to the surface
  std::vector<double> volume_fraction;   // slices
  std::vector<double> mass_fraction;     // slices; the liquid fills what the solids leave
  std::vector<double> cumulative_share;  // slices: share of all solid volume below the slice's upper edge
  std::vector<double>
      cumulative_mass_fraction;  // slices: mass fraction of everything below the slice's upper edge
  std::vector<GroupProfile> size_classes;
  std::vector<GroupProfile> species;  // empty where there is but one
  double thickness = 0;             // um, substrate to surface; over its mean height where it is not flat
  double mean_volume_fraction = 0;  // all solids over the layer's volume
  double mean_mass_fraction = 0;    // all solids, liquid: the layer's volume less the solids
  double shrinkage = 0;             // share of the first frame's thickness that is gone
  double porosity = 0;              // share of the space between substrate and surface that is not solid
  double mass_centre = 0, z95 = 0, z99 = 0, top_envelope = 0;  // um
  std::vector<double> top_height;  // um, top of each column (model/layer_measures.h); top_envelope is its mean
  double protruding_fraction = 0;                              // share of the solid volume above the surface
  double cake_thickness = 0, skin_thickness = 0;               // um, see dense_thickness
};

// Vertical motion between two frames that is not the layer's own even shrinking.
struct NonAffineInterval {
  double time = 0;      // ms, of the later frame
  double velocity = 0;  // um/ms, root mean square over particles (model/layer_measures.h: non_affine_motion)
  double shrinkage_rate = 0;  // um/ms, -dH/dt
  double mass_centre_rate =
      0;  // um/ms, thickness times d(mass centre / thickness)/dt: 0 while the layer shrinks evenly
  bool judged = false;  // the thickness changed, and there were particles enough
  double redistribution = 1;  // mass moved between heights over the window, model/redistribution.h
};

struct SolidsDevelopment {
  std::vector<SolidsProfile> profiles;
  std::vector<NonAffineInterval> intervals;  // one fewer
  // Time of the first frame at which the redistribution over the window is below the ratio, ms.
  std::optional<double> immobilisation_time;
};

struct Solids {
  std::vector<double> radius;    // um
  std::vector<double> mass;      // engine units, all positive
  double liquid_density = 1e-3;  // engine units
  std::vector<int> species = {};   // of each particle, from 0; empty: all are of one
};

// Tops of columns of the grid; without one of the frame's own.
SolidsProfile profile_solids(const Snapshot&, const Solids&, const Parameters&, ColumnGrid = {});
SolidsDevelopment follow_solids(const Frames&, const Solids&, const Parameters&);

// Height above the first edge up to which slices hold at least `threshold`: a run of such slices that begins within
// `wall_layer` of the first edge and ends where the profile, linear between the middles of slices, falls through the
// threshold. 0 where no such run begins; the whole thickness where it ends within `wall_layer` of the last edge. Cake
// thickness from the substrate up; skin thickness with profile and edges turned over.
double dense_thickness(const std::vector<double>& edges, const std::vector<double>& volume_fraction,
                       double threshold, double wall_layer);

}  // namespace pigment::analysis
