#pragma once
// The scene's `analysis` block: how the tools that read packings and trajectories measure them.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/node.h"

namespace pigment::analysis {

struct Parameters {
  // solids
  int slices = 30;                                  // equal slices of the layer's current thickness
  std::vector<double> size_classes{0.3, 0.5, 1.0};  // um, diameters that part the size classes, rising
  double cake_solids = 0.55;      // volume fraction from which a slice counts as cake or skin
  double wall_layer = 1.0;        // um next to a plane where looser slices are passed over: spheres dip there
  double envelope_column = 0.25;  // um, lateral step of the top envelope
  double immobilisation_ratio = 0.01;  // immobile: mass moved between heights over the window, over the surface's fall
  double immobilisation_shrinkage = 0.03;  // the window: the last frames in which the layer shrank by this share
  enum class Structure { None, Last, All };
  Structure structure = Structure::Last;  // frames whose local solids and pores are measured
  int pore_points = 100000;               // at which the distance to the nearest particle is taken
  int pore_bins = 50;
  // clusters
  double cluster_threshold = 0.020;  // um, surface separation below which two particles are connected
  // separations
  std::optional<double>
      separation_limit;  // um; auto: the smallest diameter, so that no particle lies between
  int separation_bins = 100;
  double near_separation_limit = 0.050;  // um, the range of the cumulative distribution near contact
  int near_separation_bins = 50;
  std::optional<double> radial_limit;  // um between centres; auto: three mean diameters by number
  int radial_bins = 100;
  // mobility
  double mobility_start = 0;                 // ms, the window of frames that is looked at
  std::optional<double> mobility_end;        // ms; auto: the last frame
  std::optional<double> mobility_interval;   // ms between the frames compared; auto: from frame to frame
  std::optional<double> displacement_limit;  // um, end of the histograms; auto: the largest displacement
  int displacement_bins = 100;
  int height_bands = 4;                        // equal bands of start height, and one below the surface:
  std::vector<double> surface_band{0.5, 2.0};  // um, its least and greatest depth below the surface
  std::optional<std::vector<std::int64_t>>
      trajectories;  // ids of the particles to follow; auto: one of the finest class in each height band

  // Size class of a diameter, 0 (finest) to size_classes.size(); a diameter on a border belongs to the finer
  // class.
  std::size_t size_class(double diameter) const;
  std::size_t size_class_count() const { return size_classes.size() + 1; }
};

// Keys are named like the members; lengths, times and fractions carry units.
Parameters read_analysis(config::Node);

}  // namespace pigment::analysis
