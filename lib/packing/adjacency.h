#pragma once
// Every sphere's neighbours, both ways, so that each can be treated by itself.
#include <cstdint>
#include <vector>

#include "neighbours/pair_search.h"

namespace pigment::packing {

struct Adjacency {
  std::vector<std::size_t> begin;  // of each sphere's neighbours in `other`, rising index
  std::vector<std::int32_t> other;

  // Neighbours: gap below `skin`.
  Adjacency(const Cell& cell, const Vec3Array& centre, const std::vector<double>& radius, double skin) {
    const auto pairs = neighbours::find_pairs(cell, centre, radius, {0, 0, skin});
    begin.assign(radius.size() + 1, 0);
    for (const auto& p : pairs) ++begin[p.i + 1], ++begin[p.j + 1];
    for (std::size_t i = 0; i < radius.size(); ++i) begin[i + 1] += begin[i];
    other.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (const auto& p : pairs) other[next[p.i]++] = p.j, other[next[p.j]++] = p.i;
  }
};

}  // namespace pigment::packing
