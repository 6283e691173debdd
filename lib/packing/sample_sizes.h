#pragma once
// Which particles a layer holds: diameters drawn from each species' size law, in the proportions of the
// recipe.
#include <cstdint>
#include <vector>

#include "model/particles.h"
#include "model/size_distribution.h"
#include "model/species.h"

namespace pigment::packing {

// Particles of all species with a total volume close to solids_volume (um^3), largest first; ids count from 0
// in that order. The number of each species is its share of the volume over its mean particle volume,
// rounded. The diameters are a stratified sample: the k-th of N is drawn at random from the k-th N-th part of
// the law by number. Every single one follows the law, and together they follow it as closely as N particles
// can: two seeds differ in where the particles are, not in how coarse the layer is (independent draws would
// move its volume by several per cent). Throws Impossible where that is no particle at all, or too many to
// pack.
Particles sample_particles(const std::vector<Species>&, const std::vector<SizeDistribution>&,
                           double solids_volume, std::uint64_t seed);

}  // namespace pigment::packing
