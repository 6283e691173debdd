#pragma once
// Pairs in blocks of four, each quantity of the four side by side: the matrix-vector product takes four pairs at a time and reads
// 92 (44) bytes a pair. The last block is filled up with pairs that add nothing.
#include <cstdint>
#include <iterator>
#include <vector>

#include "solve/lanes.h"

namespace pigment::solve {

// Shear, pump and twist besides squeeze.
struct FullPair {
  std::int32_t i, j;
  std::int32_t target;  // where contributions to j go: j itself, or a slot of the halo
  double n[3], l_i, l_j, squeeze, twist, a, b, c;
};
// Far enough for squeeze alone.
struct SqueezePair {
  std::int32_t i, j;
  std::int32_t target;
  double n[3], squeeze;
};

struct FullBlock {
  static constexpr int numbers = 10;  // n, l_i, l_j, squeeze, twist, a, b, c
  double number[numbers][lanes];
  std::int32_t i[lanes], j[lanes], target[lanes];
};
struct SqueezeBlock {
  static constexpr int numbers = 4;  // n, squeeze
  double number[numbers][lanes];
  std::int32_t i[lanes], j[lanes], target[lanes];
};

template <typename Pair, typename Block>
class PairBlocks {
 public:
  void clear() {
    blocks_.clear();
    count_ = 0;
  }
  // Empty, with room for about so many: vectors that grow by themselves would keep up to twice what they need.
  void restart(std::size_t expected) {
    clear();
    const std::size_t blocks = (expected + lanes - 1) / lanes;
    if (blocks > blocks_.capacity()) blocks_.reserve(blocks + blocks / 16 + 1);
  }
  void push_back(const Pair& p) {
    const std::size_t lane = count_ % lanes;
    if (lane == 0) {
      blocks_.push_back(empty_block);
      Block& b = blocks_.back();
      for (int q = 0; q < lanes; ++q) b.i[q] = b.j[q] = b.target[q] = p.i;  // what adds nothing adds it to itself
    }
    Block& b = blocks_.back();
    b.i[lane] = p.i;
    b.j[lane] = p.j;
    b.target[lane] = p.target;
    const double* number = p.n;  // the pair's numbers follow each other in this order
    for (int q = 0; q < Block::numbers; ++q) b.number[q][lane] = number[q];
    ++count_;
  }
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  Pair operator[](std::size_t p) const {
    const Block& b = blocks_[p / lanes];
    const std::size_t lane = p % lanes;
    Pair pair;
    pair.i = b.i[lane];
    pair.j = b.j[lane];
    pair.target = b.target[lane];
    double* number = pair.n;
    for (int q = 0; q < Block::numbers; ++q) number[q] = b.number[q][lane];
    return pair;
  }
  const std::vector<Block>& blocks() const { return blocks_; }

  class iterator {
   public:
    using value_type = Pair;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::input_iterator_tag;
    using reference = Pair;
    using pointer = void;
    iterator(const PairBlocks* pairs, std::size_t at) : pairs_(pairs), at_(at) {}
    Pair operator*() const { return (*pairs_)[at_]; }
    iterator& operator++() {
      ++at_;
      return *this;
    }
    bool operator!=(const iterator& other) const { return at_ != other.at_; }
    bool operator==(const iterator& other) const { return at_ == other.at_; }

   private:
    const PairBlocks* pairs_;
    std::size_t at_;
  };
  iterator begin() const { return {this, 0}; }
  iterator end() const { return {this, count_}; }

 private:
  static constexpr Block empty_block{};
  std::vector<Block> blocks_;
  std::size_t count_ = 0;
};

static_assert(sizeof(double[10]) + offsetof(FullPair, n) == sizeof(FullPair) && sizeof(double[4]) + offsetof(SqueezePair, n) == sizeof(SqueezePair),
              "a pair's numbers follow each other");
using FullPairs = PairBlocks<FullPair, FullBlock>;
using SqueezePairs = PairBlocks<SqueezePair, SqueezeBlock>;

}  // namespace pigment::solve
