#pragma once
// From a recipe to a layer of particles that do not touch.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/layer_parameters.h"
#include "model/particles.h"
#include "model/size_distribution.h"
#include "model/species.h"
#include "packing/impossible.h"
#include "packing/parameters.h"

namespace pigment::packing {

struct Recipe {
  LayerParameters layer;
  PackingParameters packing;
  std::vector<Species> species;
  double liquid_density = 1e-3;
  std::uint64_t seed = 1;
  std::optional<HeightMap> substrate = std::nullopt;  // absent: the plane z = 0
};

struct Packing {
  Layer layer;                          // largest particle first; x and y inside the period
  std::vector<SizeDistribution> sizes;  // one a species
  LayerTarget target;
  double width_scale = 1;                // width of the layer over the width asked for
  std::size_t inserted_overlapping = 0;  // particles that random insertion found no free place for
  int relaxation_steps = 0;              // that removing the overlaps took
  double acceptance = 0;                 // of the Monte-Carlo moves
};

// Why no packing holds so much; nothing where one may. volume_fraction is what layer.solids comes to.
std::optional<std::string> too_dense(const LayerParameters&, double volume_fraction);

// fraction (0..1) of the stage that is named.
using OnProgress = std::function<void(const std::string& stage, double fraction)>;

// Samples the particles, scales the width (never the radii) so that the solids are met to rounding, places
// the particles at random, largest first, removes overlaps where that stalls, and equilibrates if asked to.
// Every gap, between particles, to the substrate z = 0 and to the surface, is at least packing.minimum_gap.
// The same layer for the same recipe, whatever the thread count.
// Throws Impossible for what cannot be packed, and what SizeDistribution throws.
Packing pack_layer(const Recipe&, const OnProgress& = {});

}  // namespace pigment::packing
