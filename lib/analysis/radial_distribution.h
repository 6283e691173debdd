#pragma once
// Radial distribution function of a layer's particle centres [sand2010] 3.5.3.
#include <vector>

#include "analysis/frames.h"

namespace pigment::analysis {

// g(r) in equal bins from 0 to `limit` um, which is at most half a period: pairs of centres in the bin over those
// expected if every particle kept its height and stood anywhere in x and y with equal chance. So it tends to 1 whatever
// the solids profile and the layer's two faces, where g(r) against a uniform density would show both. 0 in a bin in
// which no pair is expected.
std::vector<double> radial_distribution(const Snapshot&, double limit, std::size_t bins);

}  // namespace pigment::analysis
