#pragma once
// How a sparse symmetric matrix is eliminated: the order of its nodes, the tree of their dependence [liu1990], and supernodes: chains of nodes
// whose columns have the same rows, or nearly.
#include <cstdint>
#include <utility>
#include <vector>

namespace pigment::solve {

struct Supernode {
  std::int32_t first, end;            // its nodes, by place in the order
  std::int32_t parent;                // the supernode of the first row below, -1: none
  std::int32_t rows_begin, rows_end;  // of EliminationTree::row
};

struct EliminationTree {
  std::vector<std::int32_t> place;    // of each node, in an order of little fill (approximate minimum degree), children before parents
  std::vector<Supernode> supernodes;  // in that order too
  std::vector<std::int32_t> row;      // by place, rising: the nodes below each supernode's own
};

// pairs: which different nodes have an entry between them, each once. Without places where there was no memory for an order.
EliminationTree make_elimination_tree(int nodes, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs);

}  // namespace pigment::solve
