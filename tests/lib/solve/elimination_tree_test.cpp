#include "solve/elimination_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace pigment::solve;

namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

// Neighbours on a grid and a few others, so that there are chains, branches, loose nodes and more than one root.
Pairs network(int nodes, int edge, unsigned seed) {
  std::mt19937_64 random(seed);
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::int32_t k = 0; k + edge < nodes; ++k) {
    if (random() % 3) pairs.emplace(k, k + 1);
    if (random() % 3) pairs.emplace(k, k + edge);
    if (random() % 16 == 0) pairs.emplace(k, k + 1 + static_cast<std::int32_t>(random() % (nodes - k - 1)));
  }
  return {pairs.begin(), pairs.end()};
}

// Elimination by hand: a node's later neighbours all become neighbours of each other.
std::vector<std::set<std::int32_t>> rows_by_hand(const std::vector<std::int32_t>& place, const Pairs& pairs) {
  std::vector<std::set<std::int32_t>> rows(place.size());
  for (const auto& [a, b] : pairs) rows[std::min(place[a], place[b])].insert(std::max(place[a], place[b]));
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const std::int32_t a : rows[k])
      for (const std::int32_t b : rows[k])
        if (a < b) rows[a].insert(b);
  return rows;
}

}  // namespace

TEST(EliminationTree, HasTheRowsOfEliminationByHand) {
  for (const int nodes : {1, 2, 30, 400}) {
    const Pairs pairs = network(nodes, 7, 3 + nodes);
    const EliminationTree t = make_elimination_tree(nodes, pairs);
    std::vector<std::int32_t> sorted = t.place;
    std::sort(sorted.begin(), sorted.end());
    for (int k = 0; k < nodes; ++k) ASSERT_EQ(sorted[k], k);
    const auto rows = rows_by_hand(t.place, pairs);
    std::int32_t next = 0;
    for (std::size_t s = 0; s < t.supernodes.size(); ++s) {
      const Supernode& super = t.supernodes[s];
      ASSERT_EQ(super.first, next);
      next = super.end;
      const std::vector<std::int32_t> below(t.row.begin() + super.rows_begin, t.row.begin() + super.rows_end);
      // Those of its last node; those of the others are its own nodes and some of these.
      const auto& last = rows[super.end - 1];
      EXPECT_EQ(below, std::vector<std::int32_t>(last.begin(), last.end())) << "supernode " << s << " of " << nodes << " nodes";
      for (std::int32_t k = super.first; k < super.end; ++k)
        for (const std::int32_t row : rows[k]) EXPECT_TRUE(row < super.end || last.count(row));
      const std::int32_t parent = super.parent;
      if (below.empty()) EXPECT_EQ(parent, -1);
      else EXPECT_TRUE(t.supernodes[parent].first <= below.front() && below.front() < t.supernodes[parent].end);
    }
    EXPECT_EQ(next, nodes);
  }
}
