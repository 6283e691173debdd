#include "solve/elimination_tree.h"

#include <amd.h>

#include <algorithm>
#include <numeric>

namespace pigment::solve {

namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;
using Numbers = std::vector<std::int32_t>;

// A chain of so many nodes, or fewer, becomes one supernode if this share of zeros, or less, fills it up: few columns cost more in
// overhead than in zeros.
struct Relaxation {
  double nodes, zeros;
};
constexpr Relaxation relaxations[] = {{2, 0.8}, {6, 0.3}, {16, 0.1}, {1e9, 0.05}};
bool may_join(double nodes, double zeros) {
  for (const Relaxation& r : relaxations)
    if (nodes <= r.nodes) return zeros <= r.zeros;
  return false;
}

// Of each node, by place, its neighbours that come before it, or after it.
struct Neighbours {
  Numbers begin, node;
};
Neighbours neighbours(const Numbers& place, const Pairs& pairs, bool later) {
  // At least one: AMD refuses a null pointer.
  Neighbours e{Numbers(place.size() + 1), Numbers(std::max<std::size_t>(pairs.size(), 1))};
  const auto of = [&](const auto& pair) { return std::minmax(place[pair.first], place[pair.second]); };
  for (const auto& pair : pairs) ++e.begin[(later ? of(pair).first : of(pair).second) + 1];
  std::partial_sum(e.begin.begin(), e.begin.end(), e.begin.begin());
  Numbers next(e.begin.begin(), e.begin.end() - 1);
  for (const auto& pair : pairs) {
    const auto [low, high] = of(pair);
    e.node[next[later ? low : high]++] = later ? high : low;
  }
  return e;
}

// The parent of each node in the elimination tree [liu1990], -1: a root.
Numbers parents(const Neighbours& earlier) {
  const auto n = static_cast<std::int32_t>(earlier.begin.size() - 1);
  Numbers parent(n, -1), ancestor(n, -1);
  for (std::int32_t k = 0; k < n; ++k)
    for (std::int32_t q = earlier.begin[k]; q < earlier.begin[k + 1]; ++q)
      for (std::int32_t i = earlier.node[q]; i != -1 && i < k;) {
        const std::int32_t above = std::exchange(ancestor[i], k);
        if (above == -1) parent[i] = k;
        i = above;
      }
  return parent;
}

// Where each node stands once every subtree stands together, its root last.
Numbers postorder(const Numbers& parent) {
  const auto n = static_cast<std::int32_t>(parent.size());
  Numbers child(n, -1), sibling(n, -1), post(n), path;
  for (std::int32_t k = n - 1; k >= 0; --k)
    if (parent[k] >= 0) sibling[k] = std::exchange(child[parent[k]], k);
  std::int32_t count = 0;
  for (std::int32_t root = 0; root < n; ++root) {
    if (parent[root] >= 0) continue;
    for (path.push_back(root); !path.empty();) {
      const std::int32_t k = path.back(), next = child[k];
      if (next >= 0) {
        child[k] = sibling[next];
        path.push_back(next);
      } else {
        post[k] = count++;
        path.pop_back();
      }
    }
  }
  return post;
}

// How many rows each column of L has below its diagonal [gilbert1994], by the subtree that a row's nonzeros make: a column is a leaf of it where
// it begins further on than all that came before in that row, and two leaves' paths up the tree meet where both have been counted.
Numbers column_counts(const Numbers& parent, const Neighbours& later) {
  const auto n = static_cast<std::int32_t>(parent.size());
  Numbers first(n), furthest(n, -1), last_leaf(n, -1), above(n), count(n, 1);
  std::iota(first.begin(), first.end(), 0);
  std::iota(above.begin(), above.end(), 0);
  for (std::int32_t k = 0; k < n; ++k)
    if (parent[k] >= 0) {
      first[parent[k]] = std::min(first[parent[k]], first[k]);
      count[parent[k]] = 0;
    }
  for (std::int32_t k = 0; k < n; ++k) {
    if (parent[k] >= 0) --count[parent[k]];
    for (std::int32_t q = later.begin[k]; q < later.begin[k + 1]; ++q) {
      const std::int32_t row = later.node[q];
      if (first[k] <= furthest[row]) continue;
      furthest[row] = first[k];
      ++count[k];
      if (std::int32_t meet = std::exchange(last_leaf[row], k); meet >= 0) {
        for (; above[meet] != meet; meet = above[meet]) above[meet] = above[above[meet]];
        --count[meet];
      }
    }
    if (parent[k] >= 0) above[k] = parent[k];
  }
  for (std::int32_t k = 0; k < n; ++k)
    if (parent[k] >= 0) count[parent[k]] += count[k];
  for (std::int32_t& c : count) --c;  // the diagonal
  return count;
}

}  // namespace

EliminationTree make_elimination_tree(int nodes, const Pairs& pairs) {
  const auto n = static_cast<std::size_t>(nodes);
  EliminationTree t;
  if (n == 0) return t;
  t.place.resize(n);
  std::iota(t.place.begin(), t.place.end(), 0);
  const Neighbours given = neighbours(t.place, pairs, false);
  Numbers order(n);
  if (amd_order(nodes, given.begin.data(), given.node.data(), order.data(), nullptr, nullptr) < AMD_OK) return {};
  for (std::size_t k = 0; k < n; ++k) t.place[order[k]] = static_cast<std::int32_t>(k);
  const Numbers parent_before = parents(neighbours(t.place, pairs, false)), post = postorder(parent_before);
  for (std::int32_t& p : t.place) p = post[p];
  Numbers parent(n, -1);
  for (std::size_t k = 0; k < n; ++k)
    if (parent_before[k] >= 0) parent[post[k]] = post[parent_before[k]];
  const Numbers below = column_counts(parent, neighbours(t.place, pairs, true));

  // From the end: a node joins the chain above it where its rows are the same, or nearly.
  struct Chain {
    std::int32_t first, end;
    double zeros;  // blocks
  };
  std::vector<Chain> chains;
  for (std::int32_t k = nodes - 1; k >= 0; --k) {
    if (!chains.empty() && parent[k] == k + 1 && chains.back().first == k + 1) {
      Chain& above = chains.back();
      const double columns = above.end - k, rows = below[above.end - 1];
      const double more = columns - 1 + rows - below[k], all = columns * (columns + 1) / 2 + columns * rows;
      if (more == 0 || may_join(columns, (above.zeros + more) / all)) {
        above.first = k;
        above.zeros += more;
        continue;
      }
    }
    chains.push_back({k, k + 1, 0});
  }
  Numbers supernode_of(n);
  std::int32_t rows = 0;
  for (auto c = chains.rbegin(); c != chains.rend(); ++c) {
    std::fill(supernode_of.begin() + c->first, supernode_of.begin() + c->end, static_cast<std::int32_t>(t.supernodes.size()));
    t.supernodes.push_back({c->first, c->end, -1, rows, rows});
    rows += below[c->end - 1];
  }
  for (Supernode& s : t.supernodes)
    if (parent[s.end - 1] >= 0) s.parent = supernode_of[parent[s.end - 1]];
  // A row is below all supernodes between those of its own entries and its own.
  t.row.resize(rows);
  const Neighbours earlier = neighbours(t.place, pairs, false);
  Numbers seen(t.supernodes.size(), -1);
  for (std::int32_t k = 0; k < nodes; ++k) {
    seen[supernode_of[k]] = k;
    for (std::int32_t q = earlier.begin[k]; q < earlier.begin[k + 1]; ++q)
      for (std::int32_t s = supernode_of[earlier.node[q]]; std::exchange(seen[s], k) != k; s = t.supernodes[s].parent) t.row[t.supernodes[s].rows_end++] = k;
  }
  return t;
}

}  // namespace pigment::solve
