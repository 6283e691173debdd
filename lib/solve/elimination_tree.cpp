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

// Of each node, by place, its neighbours that come before it.
struct Neighbours {
  Numbers begin, node;
};
Neighbours earlier_neighbours(const Numbers& place, const Pairs& pairs) {
  // At least one: AMD refuses a null pointer.
  Neighbours e{Numbers(place.size() + 1), Numbers(std::max<std::size_t>(pairs.size(), 1))};
  for (const auto& [a, b] : pairs) ++e.begin[std::max(place[a], place[b]) + 1];
  std::partial_sum(e.begin.begin(), e.begin.end(), e.begin.begin());
  Numbers next(e.begin.begin(), e.begin.end() - 1);
  for (const auto& [a, b] : pairs) e.node[next[std::max(place[a], place[b])]++] = std::min(place[a], place[b]);
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

// The rows below the diagonal of each column of L: its matrix's own and those of its children.
std::vector<Numbers> rows_below(const Numbers& place, const Numbers& parent, const Pairs& pairs) {
  const std::size_t n = place.size();
  std::vector<Numbers> rows(n), children(n);
  Numbers seen(n, -1);
  for (const auto& [a, b] : pairs) rows[std::min(place[a], place[b])].push_back(std::max(place[a], place[b]));
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(n); ++k) {
    for (std::int32_t r : rows[k]) seen[r] = k;
    for (std::int32_t child : children[k])
      for (std::int32_t r : rows[child])
        if (r != k && std::exchange(seen[r], k) != k) rows[k].push_back(r);
    std::sort(rows[k].begin(), rows[k].end());
    if (parent[k] >= 0) children[parent[k]].push_back(k);
  }
  return rows;
}

}  // namespace

EliminationTree make_elimination_tree(int nodes, const Pairs& pairs) {
  const auto n = static_cast<std::size_t>(nodes);
  EliminationTree t;
  if (n == 0) return t;
  t.place.resize(n);
  std::iota(t.place.begin(), t.place.end(), 0);
  const Neighbours given = earlier_neighbours(t.place, pairs);
  Numbers order(n);
  if (amd_order(nodes, given.begin.data(), given.node.data(), order.data(), nullptr, nullptr) < AMD_OK) return {};
  for (std::size_t k = 0; k < n; ++k) t.place[order[k]] = static_cast<std::int32_t>(k);
  const Numbers parent_before = parents(earlier_neighbours(t.place, pairs)), post = postorder(parent_before);
  for (std::int32_t& p : t.place) p = post[p];
  Numbers parent(n, -1);
  for (std::size_t k = 0; k < n; ++k)
    if (parent_before[k] >= 0) parent[post[k]] = post[parent_before[k]];
  const std::vector<Numbers> rows = rows_below(t.place, parent, pairs);

  // From the end: a node joins the chain above it where its rows are the same, or nearly.
  struct Chain {
    std::int32_t first, end;
    double zeros;  // blocks
  };
  std::vector<Chain> chains;
  for (std::int32_t k = nodes - 1; k >= 0; --k) {
    if (!chains.empty() && parent[k] == k + 1 && chains.back().first == k + 1) {
      Chain& above = chains.back();
      const double columns = above.end - k, below = static_cast<double>(rows[above.end - 1].size());
      const double more = columns - 1 + below - static_cast<double>(rows[k].size()), all = columns * (columns + 1) / 2 + columns * below;
      if (more == 0 || may_join(columns, (above.zeros + more) / all)) {
        above.first = k;
        above.zeros += more;
        continue;
      }
    }
    chains.push_back({k, k + 1, 0});
  }
  Numbers supernode_of(n);
  for (auto c = chains.rbegin(); c != chains.rend(); ++c) {
    const Numbers& below = rows[c->end - 1];
    const auto begin = static_cast<std::int32_t>(t.row.size());
    std::fill(supernode_of.begin() + c->first, supernode_of.begin() + c->end, static_cast<std::int32_t>(t.supernodes.size()));
    t.row.insert(t.row.end(), below.begin(), below.end());
    t.supernodes.push_back({c->first, c->end, -1, begin, static_cast<std::int32_t>(t.row.size())});
  }
  for (Supernode& s : t.supernodes)
    if (s.rows_begin < s.rows_end) s.parent = supernode_of[t.row[s.rows_begin]];
  return t;
}

}  // namespace pigment::solve
