#pragma once
// Clusters: particles joined by surface separations below a threshold, periodic in x and y [sand2010] 3.5.3.
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/frames.h"
#include "model/layer_measures.h"

namespace pigment::analysis {

struct Connection {
  std::int32_t first, second;  // indices of the particles, first < second
  double separation;           // um, surface to surface; negative where they overlap
};

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
  double mean_coordination = 0;            // neighbours a particle
  std::vector<std::int64_t> coordination;  // particles with 0, 1, 2, ... neighbours, up to the most that occurs
  std::vector<Connection> pairs;           // the connections, by first, then second
  // Filter cake, column by column: particles of the clusters that lie within the threshold of the substrate, alone
  // ones too.
  std::vector<double> cake_height;  // um, of the highest such sphere on each column's axis; 0 where there is none
  double mean_cake_height = 0;      // um, over the columns
  double cake_roughness = 0;        // um, standard deviation over the columns
};

// Threshold in um; ids differ from one another. Touching and overlapping spheres are connected. Columns as in
// model/layer_measures.h; the cake is left out where there are none.
Clusters find_clusters(const Snapshot&, const std::vector<double>& radius,
                       const std::vector<std::int64_t>& id, double threshold, const ColumnGrid& = {});
std::vector<Clusters> find_clusters(const Frames&, const std::vector<double>& radius,
                                    const std::vector<std::int64_t>& id, double threshold,
                                    const ColumnGrid& = {});

// Time of the first frame in which one cluster reaches from the substrate to the surface, ms.
std::optional<double> percolation_time(const std::vector<Clusters>&);

}  // namespace pigment::analysis
