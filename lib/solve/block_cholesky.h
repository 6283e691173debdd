#pragma once
// Cholesky's factor of a sparse symmetric positive definite matrix of 3 x 3 blocks, A = L L^T, by the multifrontal method [duff1983]: every
// supernode's columns are eliminated in a dense front, which leaves an update to its parent's. The tree is cut into parts, sets of whole subtrees that
// threads take one by one, and a top, whose fronts they share. Every number is added up in an order that the tree alone sets: the same bytes
// at any number of threads.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solve/elimination_tree.h"
#include "solve/front.h"

namespace pigment::solve {

// In which a factor is computed; it is kept in single precision either way. Single takes little more than half the time, and what it rounds off
// is 6e-8 of the stiffest block for each of the operations that a number goes through, where keeping rounds once.
enum class Precision { Single, Double };

class BlockCholesky {
 public:
  // Which different nodes have a block between them, each pair once. False where memory is short; std::bad_alloc too, here and from factorize.
  bool analyze(int nodes, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs);
  // Where each node stands in the order of elimination.
  const std::vector<std::int32_t>& place() const { return tree_.place; }
  // Of factorize, in multiply-adds, about.
  double work() const { return work_; }
  // What a solve reads twice.
  std::size_t bytes() const { return kept_size_ * sizeof(float); }
  // diagonal: 9 numbers for each place; between: 9 for each of the pairs, row by row, rows of its second node, columns of its first.
  // False where a pivot is not positive.
  bool factorize(std::span<const double> diagonal, std::span<const double> between, Precision = Precision::Double);
  // x = A^-1 x, but for L's rounding to single precision, 3 numbers for each place, of one or two right-hand sides, one after the other.
  // By all threads of the parallel region that it is called in; outside of one, by one thread.
  void solve(double* x, int sides = 1);

 private:
  // Of a supernode.
  struct Place {
    std::int32_t part;                          // that it is in, -1: the top
    std::size_t values;                         // where its columns begin in kept_
    std::size_t update;                         // where its update begins, in the memory of its part
    std::int32_t children_begin, children_end;  // of children_
    std::int32_t blocks_begin, blocks_end;      // of blocks_
    std::int32_t runs_begin, runs_end;          // of runs_
  };
  // A block of the matrix, and where it goes.
  struct Block {
    std::int32_t pair;
    bool turned;  // the pair's first node is the later one
    std::size_t values;  // in its front
  };
  struct Part {
    std::int32_t begin, end;  // supernodes; those of the top among them are not the part's
    std::size_t memory;       // numbers, for its updates
    double work;
  };

  void find_children();
  void place_blocks(const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs, const std::vector<std::int32_t>& supernode_of);
  void divide();
  FrontSize size(std::int32_t supernode) const;
  // Of numbers of either precision T. A front, which has its own columns where they are kept, or those of double precision in `values`.
  template <typename T>
  Front<T> front(std::int32_t supernode, T* values, T* update) const;
  KeptColumns kept(std::int32_t supernode) const;
  template <typename T>
  T* update_of(std::int32_t supernode) const;
  // What the front is before its elimination: nothing, the matrix's own numbers, and of a child's update the three columns from `from` on.
  template <typename T>
  void clear(std::int32_t supernode, const Front<T>&, int begin, int end) const;
  template <typename T>
  void add_numbers(std::int32_t supernode, const Front<T>&, std::span<const double> diagonal, std::span<const double> between) const;
  template <typename T>
  void add_update(const Front<T>&, std::int32_t child, int from) const;
  template <typename T>
  void gather(std::int32_t supernode, const Front<T>&, std::span<const double> diagonal, std::span<const double> between) const;
  template <typename T>
  bool factor_part(std::int32_t part, std::span<const double> diagonal, std::span<const double> between, T* values, T* update) const;
  template <typename T>
  void factor_top(std::span<const double> diagonal, std::span<const double> between, T* values, bool& good) const;
  template <typename T>
  bool factorize(std::span<const double> diagonal, std::span<const double> between) const;
  // x of a supernode's first unknown, and room for its rows; of each right-hand side.
  template <int N>
  Sides<N> own(std::int32_t supernode, double* x) const;
  template <int N>
  Sides<N> rows(double* w) const;
  // What the rows below lost (w), and their unknowns.
  template <int N>
  void scatter(std::int32_t supernode, const double* w, double* x, double* to_top) const;
  template <int N>
  void collect(std::int32_t supernode, const double* x, double* w) const;
  template <int N>
  void forward(std::int32_t supernode, double* x, double* to_top, double* w) const;
  template <int N>
  void backward(std::int32_t supernode, double* x, double* w) const;
  template <int N>
  void forward_top(double* x);
  template <int N>
  void backward_top(double* x);
  template <int N>
  void solve_sides(double* x);
  bool has_children(std::int32_t supernode) const { return places_[supernode].children_begin < places_[supernode].children_end; }

  EliminationTree tree_;
  double work_ = 0;
  std::vector<Place> places_;
  // Of each row below a supernode: the row of its parent's front, and the unknown of x that it adds to; that of the top counted from -1 down.
  std::vector<std::int32_t> row_in_parent_, target_;
  std::vector<std::int32_t> children_;
  std::vector<Block> blocks_;
  std::vector<Run> runs_;  // of rows below, to the parent's front
  std::vector<Part> parts_;
  std::vector<std::int32_t> parts_by_work_, top_;
  std::size_t top_unknowns_ = 0, top_memory_ = 0, largest_values_ = 0, largest_update_ = 0, most_rows_ = 0;
  std::size_t kept_size_ = 0;
  std::unique_ptr<float[]> kept_;
  std::vector<std::unique_ptr<std::byte[]>> updates_;  // of each part, then of the top; room for doubles
  std::vector<double> to_top_;                      // of each part: what the top's unknowns get from it
  std::vector<double> top_rows_;                    // of the front of the top that is at hand
};

}  // namespace pigment::solve
