#pragma once
// A front of the multifrontal method: a dense symmetric matrix, column by column, whose first columns are eliminated and which leaves the rest
// to another front. Its unknowns come in blocks of three; rows are filled up to whole vectors of either precision, the own ones and those
// below each by themselves. What stands above the diagonal has no meaning. Compiled for AVX2 and for any processor, with the same bits.
#include <cstddef>
#include <cstdint>
#include <span>

#include "solve/lanes.h"

namespace pigment::solve {

constexpr int front_block = 3;
constexpr int whole_lanes(int n) { return (n + lanes - 1) / lanes * lanes; }
constexpr int whole_rows(int n) { return (n + lanes_of<float> - 1) / lanes_of<float> * lanes_of<float>; }

struct FrontSize {
  int own, below;  // unknowns to eliminate, and those that are left

  int own_rows() const { return whole_rows(own); }
  int below_rows() const { return whole_rows(below); }
  int rows() const { return own_rows() + below_rows(); }
};

// T: float or double.
template <typename T>
struct Front : FrontSize {
  T* values;  // the columns to eliminate, of own_rows() + below_rows() each; factorised, the diagonal holds its inverse
  T* update;  // the columns that are left, of below_rows() each
};
// The first row of a column of `update` that is written and read.
constexpr int first_row(int column) { return column / front_block * front_block / lanes_of<float> * lanes_of<float>; }

// Columns are eliminated panel by panel: those of a panel from begin to end among themselves first; false where a pivot is not positive.
// Then they are subtracted from columns that follow, of which each is a block's first: own ones, and those below, which hold something
// from before or not.
constexpr int front_panel = 16 * front_block;
template <typename T>
bool factor_panel(const Front<T>&, int begin, int end);
template <typename T>
void subtract_from_own(const Front<T>&, int begin, int end, int column);
template <typename T>
void subtract_from_below(const Front<T>&, int begin, int end, int column, bool add);
// All of it by one thread; `add`: whether there is something in `update`.
template <typename T>
bool factor_front(const Front<T>&, bool add);

// The eliminated columns as they are kept for solves: in single precision, half as much to read, as solves wait for nothing else. Of a stiff
// matrix that is no exact inverse any more, but as good a preconditioner.
struct KeptColumns : FrontSize {
  const float* values;  // of rows() each, as in the front
};
// float of each of the columns from begin to end of `values`.
void keep_columns(const Front<double>&, int begin, int end, float* to);

// Up to two right-hand sides are solved for at once: the columns, read once, are what takes time. Each has its own bits, alone or not.
constexpr int most_sides = 2;
template <int N>
struct Sides {
  double* of[N];
};

// L x = b for own unknowns x, in place, panel by panel; w (rows()) holds what the rows lose to those before, zero at first. The panel's own
// unknowns, then from what rows from row to row_end, after the panel, lose to them. Rows in whole lanes.
template <int N>
void forward_panel(const KeptColumns&, int begin, int end, Sides<N> x, Sides<N> w);
template <int N>
void forward_rows(const KeptColumns&, int begin, int end, Sides<N> x, int row, int row_end, Sides<N> w);
// L^T x = b likewise, from the last panel to the first; w holds the unknowns of all rows after the panel, zero where a row has none. What the three
// unknowns from `column` on lose to them is taken from x; then the panel's own, into x and w.
template <int N>
void backward_columns(const KeptColumns&, int column, int panel_end, Sides<N> x, Sides<N> w);
template <int N>
void backward_panel(const KeptColumns&, int begin, int end, Sides<N> x, Sides<N> w);

// Rows of one front that follow one another in another's too, `length` of them from row `from`, which go to those from row `to`.
struct Run {
  std::int32_t from, to, length;
};
// Adds the three columns at `of`, of of_rows each, from their row `first` on, to those at `to`, of to_rows each. runs: rising, all rows of `of`.
template <typename T>
void add_runs(T* to, std::size_t to_rows, const T* of, std::size_t of_rows, int first, std::span<const Run> runs);

}  // namespace pigment::solve
