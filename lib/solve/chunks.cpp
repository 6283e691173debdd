#include "solve/chunks.h"

#include <algorithm>

namespace pigment::solve {

Chunks make_chunks(std::size_t particles) {
  // Small ones share the work out evenly, large ones have fewer pairs that reach into another chunk.
  const std::size_t size = std::clamp<std::size_t>(particles / 48, 256, 2048), count = std::max<std::size_t>(1, (particles + size - 1) / size);
  Chunks chunks;
  // In whole fours: the solver takes four particles at a time.
  for (std::size_t c = 0; c < count; ++c) chunks.begin.push_back(static_cast<int>(particles * c / count / 4 * 4));
  chunks.begin.push_back(static_cast<int>(particles));
  return chunks;
}

}  // namespace pigment::solve
