#pragma once
// Pairs within range plus a skin, and the spatial order in which the engine keeps its particles: neighbours
// in space are neighbours in memory. Valid until a gap could have shrunk by the skin; made from reference
// positions alone, so that a resumed run that starts from the same reference positions has the same list in
// the same order.
#include <cstdint>
#include <vector>

#include "model/particles.h"
#include "neighbours/pair_search.h"

namespace pigment::neighbours {

struct NeighbourList {
  PairRange range;
  double largest_radius = 0;        // um
  Vec3Array reference;              // positions when the list was made, in file order
  std::vector<std::int32_t> order;  // engine index -> file index
  std::vector<IndexPair> pairs;     // engine indices, i < j, sorted by i then j

  // Whether any two particles could have come closer by more than the skin since the list was made. What the layer does as a
  // whole (rise or sink, shrink evenly along z) is told apart from what its particles do against each other.
  bool is_spent(const Vec3Array& position) const;
};

NeighbourList make_neighbour_list(const Cell&, const Vec3Array& position, const std::vector<double>& radius,
                                  const PairRange&);

}  // namespace pigment::neighbours
