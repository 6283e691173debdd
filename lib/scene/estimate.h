#pragma once
// What a scene will be before anything is run: how much is coated, how many particles, which rates, what it will cost.
#include <vector>

#include "dewatering/profile.h"
#include "model/size_distribution.h"
#include "scene/scene.h"

namespace pigment::scene {

struct LayerEstimate {
  double volume_fraction = 0, mass_fraction = 0, thickness = 0;  // of the wet layer; um
  double dry_coat_weight = 0;  // engine units, which are kg/m2
  double particles = 0;        // expected number in the periodic square
  double mean_gap = 0;         // um, of particles of the mean volume on a lattice of this density
  // Diameters, um: the finest, the coarsest, and the median by number.
  double smallest = 0, median = 0, largest = 0;
  std::vector<SizeDistribution> sizes;    // by species
  std::vector<double> number_share;       // of each species
};
// Needs layer and particles. Throws FileError for a size table that cannot be used.
LayerEstimate estimate_layer(const Scene&);

// Speeds at which liquid leaves, q + e, um/ms: the fastest is the mean over the first hundredth of the duration, since
// Darcy's flux has none at t = 0.
struct RateEstimate {
  double fastest = 0, slowest = 0, mean = 0;
  double duration = 0;  // ms
  double removed = 0;   // um
};
RateEstimate estimate_rates(const dewatering::Profile&);

struct CostEstimate {
  double particles = 0, pairs = 0, steps = 0, frames = 0;
  double step = 0;       // ms, given or usual
  double seconds = 0;    // on one core
  double megabytes = 0;  // of the trajectory before compression
};
// Pairs nearer than the longest reach of the forces and of lubrication. Around a sphere the others are denser than on the
// average, by 1 + 0.75 phi over such a shell, read off random packings of one size and of many, which hold as many pairs as
// this says within 25 %. Time is proportional to particles times steps.
CostEstimate estimate_cost(const Scene&, const LayerEstimate&, double duration);

}  // namespace pigment::scene
