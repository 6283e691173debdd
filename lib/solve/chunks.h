#pragma once
// Work split into fixed chunks of consecutive particles. The split depends on the number of particles alone, never on the
// number of threads, and sums are combined chunk by chunk in order: so results do not depend on how many threads there are.
#include <cstddef>
#include <vector>

namespace pigment::solve {

struct Chunks {
  std::vector<int> begin;  // chunk c holds particles begin[c] .. begin[c+1]-1
  int count() const { return static_cast<int>(begin.size()) - 1; }
};
// About 256 particles a chunk, up to 2048 where there are many, each from a multiple of four on; at least one chunk.
Chunks make_chunks(std::size_t particles);

}  // namespace pigment::solve
