#pragma once
// How far particles move between frames: displacement distributions by direction, start height and size, and
// speeds [sand2010] 3.5.2 and 4.3.
#include <vector>

#include "analysis/frames.h"
#include "analysis/parameters.h"

namespace pigment::analysis {

// Densities (1/um) over the edges of Mobility; each integrates to the share within the edges (1 with an
// automatic limit), 0 without particles. Means and root mean squares in um, 0 without particles.
struct Displacements {
  double particles = 0;
  std::vector<double> absolute;  // |d|
  std::vector<double> vertical;  // |d_z|
  std::vector<double> lateral;   // mean of the densities of |d_x| and |d_y|
  double mean_absolute = 0;
  double mean_vertical = 0;  // of d_z: negative, towards the substrate
  double rms_vertical = 0;
  double rms_lateral = 0;  // root of the mean of (d_x^2 + d_y^2)/2
};

struct MobilityInterval {
  double start = 0, end = 0;       // ms
  double thickness = 0;            // um, at the start
  std::vector<double> band_edges;  // um, height_bands + 1
  // [size class][band]: bands from the substrate up, the band below the surface last.
  std::vector<std::vector<Displacements>> by_size_and_height;
  std::vector<Displacements> all_sizes;  // [band]
  std::vector<double> speed;             // um/ms, one a particle: distance between the frames over the time
};

struct Mobility {
  std::vector<double> edges;  // um, of the densities
  std::vector<MobilityInterval> intervals;
  std::vector<double> displacement;  // um, one a particle, between the first and the last frame looked at
  std::vector<double> speed;         // um/ms, the same over the time between
};

// Numbers of the frames to compare, each with the next: those in the window, or of these the ones whose times come
// nearest to whole numbers of intervals after the first. Fewer than two: nothing to compare.
std::vector<std::size_t> choose_frames(const std::vector<double>& time, const Parameters&);

// `numbers` as choose_frames gives them, two or more.
Mobility measure_mobility(const Frames&, const std::vector<std::size_t>& numbers,
                          const std::vector<double>& radius, const Parameters&);

}  // namespace pigment::analysis
