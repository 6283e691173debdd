#pragma once
// Work split into fixed chunks of consecutive particles. The split depends on the particles and their pairs alone, never on the
// number of threads, and sums are combined chunk by chunk in order: so results do not depend on how many threads there are.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pigment::solve {

struct Chunks {
  std::vector<int> begin;  // chunk c holds particles begin[c] .. begin[c+1]-1
  int count() const { return static_cast<int>(begin.size()) - 1; }
};
// About 256 particles a chunk, up to 2048 where there are many, each from a multiple of four on; at least one chunk. Chunks have about the
// same work: a cake has more pairs than the liquid above it. pair_i: the particle that owns each pair, rising.
Chunks make_chunks(std::size_t particles, const std::vector<std::int32_t>& pair_i);

}  // namespace pigment::solve
