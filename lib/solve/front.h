#pragma once
// A front of the multifrontal method: a dense symmetric matrix, column by column, whose first columns are eliminated and which leaves the rest
// to another front. Its unknowns come in blocks of three; rows are filled up to whole lanes, the own ones and those below each by
// themselves. What stands above the diagonal has no meaning. Compiled for AVX2 and for any processor, with the same bits.
#include <cstddef>

#include "solve/lanes.h"

namespace pigment::solve {

constexpr int front_block = 3;
constexpr int whole_lanes(int n) { return (n + lanes - 1) / lanes * lanes; }

struct Front {
  double* values;  // the columns to eliminate, of own_rows() + below_rows() each; factorised, the diagonal holds its inverse
  double* update;  // the columns that are left, of below_rows() each
  int own, below;  // unknowns to eliminate, and those that are left

  int own_rows() const { return whole_lanes(own); }
  int below_rows() const { return whole_lanes(below); }
  int rows() const { return own_rows() + below_rows(); }
  // The first row of a column of `update` that is written and read.
  static int first_row(int column) { return column / front_block * front_block / lanes * lanes; }
};

// Columns are eliminated panel by panel: those of a panel from begin to end among themselves first; false where a pivot is not positive.
// Then they are subtracted from columns that follow, of which each is a block's first: own ones, and those below, which hold something
// from before or not.
constexpr int front_panel = 16 * front_block;
bool factor_panel(const Front&, int begin, int end);
void subtract_from_own(const Front&, int begin, int end, int column);
void subtract_from_below(const Front&, int begin, int end, int column, bool add);
// All of it by one thread; `add`: whether there is something in `update`.
bool factor_front(const Front&, bool add);

// Own unknowns x from L x = b, in place, and into w (below_rows()) what the rows below lose to them.
void solve_forward(const Front&, double* x, double* w);
// Own unknowns x from L^T x = b, in place, given those of the rows below (w, zero in rows without an unknown).
void solve_backward(const Front&, double* x, const double* w);

// to += from, n numbers.
void add_rows(double* to, const double* from, int n);

}  // namespace pigment::solve
