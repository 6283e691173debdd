#include "solve/chunks.h"

#include <algorithm>

namespace pigment::solve {

namespace {
// A particle's own share of a pass and a solve, in pairs.
constexpr std::size_t pairs_per_particle = 3;
}  // namespace

Chunks make_chunks(std::size_t particles, const std::vector<std::int32_t>& pair_i) {
  // Small ones share the work out evenly, large ones have fewer pairs that reach into another chunk.
  const std::size_t size = std::clamp<std::size_t>(particles / 48, 256, 2048), count = std::max<std::size_t>(1, (particles + size - 1) / size);
  const std::size_t all = pairs_per_particle * particles + pair_i.size();
  Chunks chunks{{0}};
  std::size_t pair = 0;
  // In whole fours: the solver takes four particles at a time.
  for (std::size_t end = 4; end < particles && chunks.begin.size() < count; end += 4) {
    while (pair < pair_i.size() && static_cast<std::size_t>(pair_i[pair]) < end) ++pair;
    if ((pairs_per_particle * end + pair) * count >= chunks.begin.size() * all) chunks.begin.push_back(static_cast<int>(end));
  }
  chunks.begin.push_back(static_cast<int>(particles));
  return chunks;
}

}  // namespace pigment::solve
