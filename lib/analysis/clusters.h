#pragma once
// Clusters: particles joined by surface separations below a threshold, periodic in x and y [sand2010] 3.5.3.
#include <cstdint>
#include <vector>

#include "analysis/frames.h"

namespace pigment::analysis {

struct Clusters {
  double time = 0;  // ms
  // One entry a particle.
  std::vector<std::int64_t> id;          // smallest particle id in its cluster; its own where it is alone
  std::vector<std::int64_t> size;        // particles in its cluster; 1 where it is alone
  std::vector<std::int64_t> neighbours;  // particles connected to it
  std::vector<double> extent;  // um, from the lowest to the highest point of any sphere of its cluster
  // One of each; a cluster has two particles or more.
  std::int64_t count = 0;         // clusters
  std::int64_t connections = 0;   // pairs closer than the threshold
  std::int64_t largest = 0;       // particles in the largest cluster (1: all are alone; 0: no particles)
  double clustered_fraction = 0;  // of the particles
  double clustered_volume_fraction = 0;  // of the solid volume
  double largest_fraction = 0;           // of the particles
  double largest_extent = 0;             // um, greatest vertical extent of any cluster; 0 without clusters
  bool percolates = false;  // one cluster lies within the threshold of the substrate and of the surface
};

// Threshold in um; ids differ from one another. Touching and overlapping spheres are connected.
Clusters find_clusters(const Snapshot&, const std::vector<double>& radius,
                       const std::vector<std::int64_t>& id, double threshold);
std::vector<Clusters> find_clusters(const Frames&, const std::vector<double>& radius,
                                    const std::vector<std::int64_t>& id, double threshold);

}  // namespace pigment::analysis
