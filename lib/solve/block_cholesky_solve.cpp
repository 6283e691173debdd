// Solves with the factor: forward through the parts and the top, and back.
#include <algorithm>

#include "solve/block_cholesky.h"

namespace pigment::solve {

namespace {

constexpr int B = front_block;

// Rows of a front of the top that a thread takes at once.
constexpr int rows_at_once = 16 * lanes;

}  // namespace

KeptColumns BlockCholesky::kept(std::int32_t k) const {
  return {size(k), kept_.get() + places_[k].values};
}

template <int N>
Sides<N> BlockCholesky::own(std::int32_t k, double* x) const {
  Sides<N> s;
  for (int n = 0; n < N; ++n) s.of[n] = x + B * (n * tree_.place.size() + static_cast<std::size_t>(tree_.supernodes[k].first));
  return s;
}
template <int N>
Sides<N> BlockCholesky::rows(double* w) const {
  Sides<N> s;
  for (int n = 0; n < N; ++n) s.of[n] = w + n * most_rows_;
  return s;
}

// Subtracts what the rows below lose: within the part from x, of the top from to_top, which is added to x when all parts are through.
template <int N>
void BlockCholesky::scatter(std::int32_t k, const double* w, double* x, double* to_top) const {
  const FrontSize f = size(k);
  for (int n = 0; n < N; ++n, w += most_rows_, x += B * tree_.place.size(), to_top += top_unknowns_) {
    const std::int32_t* target = target_.data() + tree_.supernodes[k].rows_begin;
    for (int row = f.own_rows(); row < f.own_rows() + f.below; row += B, ++target) {
      double* to = *target >= 0 ? x + *target : to_top - (*target + 1);
      for (int d = 0; d < B; ++d) to[d] -= w[row + d];
    }
  }
}

template <int N>
void BlockCholesky::collect(std::int32_t k, const double* x, double* w) const {
  const FrontSize f = size(k);
  for (int n = 0; n < N; ++n, w += most_rows_, x += B * tree_.place.size()) {
    const std::int32_t* node = tree_.row.data() + tree_.supernodes[k].rows_begin;
    std::fill(w + f.own, w + f.own_rows(), 0.0);
    for (int row = f.own_rows(); row < f.own_rows() + f.below; row += B, ++node) std::copy_n(x + B * static_cast<std::size_t>(*node), B, w + row);
    std::fill(w + f.own_rows() + f.below, w + f.rows(), 0.0);
  }
}

template <int N>
void BlockCholesky::forward(std::int32_t k, double* x, double* to_top, double* w) const {
  const KeptColumns columns = kept(k);
  for (int n = 0; n < N; ++n) std::fill_n(w + n * most_rows_, columns.rows(), 0.0);
  forward_panel(columns, 0, columns.own, own<N>(k, x), rows<N>(w));
  forward_rows(columns, 0, columns.own, own<N>(k, x), columns.own_rows(), columns.rows(), rows<N>(w));
  scatter<N>(k, w, x, to_top);
}

template <int N>
void BlockCholesky::backward(std::int32_t k, double* x, double* w) const {
  const KeptColumns columns = kept(k);
  collect<N>(k, x, w);
  for (int column = 0; column < columns.own; column += B) backward_columns(columns, column, columns.own, own<N>(k, x), rows<N>(w));
  backward_panel(columns, 0, columns.own, own<N>(k, x), rows<N>(w));
}

// The fronts of the top, one after the other, panel by panel: rows, and columns, by all threads.
template <int N>
void BlockCholesky::forward_top(double* x) {
  double* w = top_rows_.data();
  for (const std::int32_t k : top_) {
    const KeptColumns columns = kept(k);
    for (int begin = 0; begin < columns.own; begin += front_panel) {
      const int end = std::min(begin + front_panel, columns.own), rest = whole_lanes(end), last = columns.rows();
#pragma omp single
      {
        for (int n = 0; n < N && begin == 0; ++n) std::fill_n(w + n * most_rows_, last, 0.0);
        forward_panel(columns, begin, end, own<N>(k, x), rows<N>(w));
      }
#pragma omp for schedule(static)
      for (int row = rest; row < last; row += rows_at_once) forward_rows(columns, begin, end, own<N>(k, x), row, std::min(row + rows_at_once, last), rows<N>(w));
    }
#pragma omp single
    scatter<N>(k, w, x, to_top_.data());  // nothing below a front of the top is a part's
  }
}
template <int N>
void BlockCholesky::backward_top(double* x) {
  double* w = top_rows_.data();
  for (auto at = top_.rbegin(); at != top_.rend(); ++at) {
    const KeptColumns columns = kept(*at);
#pragma omp single
    collect<N>(*at, x, w);
    for (int begin = (columns.own - 1) / front_panel * front_panel; begin >= 0; begin -= front_panel) {
      const int end = std::min(begin + front_panel, columns.own);
#pragma omp for schedule(static)
      for (int column = begin; column < end; column += B) backward_columns(columns, column, end, own<N>(*at, x), rows<N>(w));
#pragma omp single
      backward_panel(columns, begin, end, own<N>(*at, x), rows<N>(w));
    }
  }
}

template <int N>
void BlockCholesky::solve_sides(double* x) {
  std::vector<double> work(N * most_rows_);
#pragma omp for schedule(dynamic, 1)
  for (std::size_t q = 0; q < parts_.size(); ++q) {
    const std::int32_t p = parts_by_work_[q];
    double* to_top = to_top_.data() + N * p * top_unknowns_;
    std::fill(to_top, to_top + N * top_unknowns_, 0.0);
    for (std::int32_t k = parts_[p].begin; k < parts_[p].end; ++k)
      if (places_[k].part == p) forward<N>(k, x, to_top, work.data());
  }
#pragma omp single
  for (int n = 0; n < N; ++n) {
    std::size_t at = n * top_unknowns_;
    for (const std::int32_t k : top_) {
      double* own_x = own<N>(k, x).of[n];
      for (int d = 0; d < size(k).own; ++d, ++at)
        for (std::size_t p = 0; p < parts_.size(); ++p) own_x[d] += to_top_[N * p * top_unknowns_ + at];
    }
  }
  forward_top<N>(x);
  backward_top<N>(x);
#pragma omp for schedule(dynamic, 1)
  for (std::size_t q = 0; q < parts_.size(); ++q) {
    const std::int32_t p = parts_by_work_[q];
    for (std::int32_t k = parts_[p].end - 1; k >= parts_[p].begin; --k)
      if (places_[k].part == p) backward<N>(k, x, work.data());
  }
}

void BlockCholesky::solve(double* x, int sides) { sides == 1 ? solve_sides<1>(x) : solve_sides<most_sides>(x); }

}  // namespace pigment::solve
