#include "assembly/interactions.h"

#include <algorithm>

namespace pigment::assembly {

neighbours::PairRange pair_range(const Interactions& interactions, const Liquid& liquid) {
  neighbours::PairRange range;
  if (interactions.lubrication()) range.per_smaller_radius = interactions.hydrodynamics.taper.squeeze_end;
  for (const auto& [name, law] : interactions.colloidal)
    range.at_least = std::max(range.at_least, law->prepare(liquid)->cutoff_gap());
  return range;
}

}  // namespace pigment::assembly
