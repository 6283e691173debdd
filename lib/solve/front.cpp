#include "solve/front.h"

#include <algorithm>
#include <cmath>

namespace pigment::solve {

namespace {

constexpr int B = front_block;
template <typename T>
constexpr int lane_start(int n) {
  return n / lanes_of<T> * lanes_of<T>;
}

// c (B columns, rows in whole vectors, column by column) -= a b^T, where a has K columns and b is three rows of the same. Named sums, since an
// array of them would be kept in memory.
template <typename T>
PIGMENT_INLINE void subtract_three_vectors(T* c, int ldc, const T* a, const T* b, int lda, int K, bool add) {
  using V = typename VectorOf<T>::type;
  constexpr int L = lanes_of<T>;
  V s00{}, s01{}, s02{}, s10{}, s11{}, s12{}, s20{}, s21{}, s22{};
  T *c1 = c + ldc, *c2 = c1 + ldc;
  if (add) {
    load(s00, c), load(s01, c + L), load(s02, c + 2 * L);
    load(s10, c1), load(s11, c1 + L), load(s12, c1 + 2 * L);
    load(s20, c2), load(s21, c2 + L), load(s22, c2 + 2 * L);
  }
  for (int k = 0; k < K; ++k, a += lda, b += lda) {
    V x, y, z;
    load(x, a), load(y, a + L), load(z, a + 2 * L);
    subtract_fused(s00, x, b[0]), subtract_fused(s01, y, b[0]), subtract_fused(s02, z, b[0]);
    subtract_fused(s10, x, b[1]), subtract_fused(s11, y, b[1]), subtract_fused(s12, z, b[1]);
    subtract_fused(s20, x, b[2]), subtract_fused(s21, y, b[2]), subtract_fused(s22, z, b[2]);
  }
  store(c, s00), store(c + L, s01), store(c + 2 * L, s02);
  store(c1, s10), store(c1 + L, s11), store(c1 + 2 * L, s12);
  store(c2, s20), store(c2 + L, s21), store(c2 + 2 * L, s22);
}
template <typename T>
PIGMENT_INLINE void subtract_one_vector(T* c, int ldc, const T* a, const T* b, int lda, int K, bool add) {
  using V = typename VectorOf<T>::type;
  V s0{}, s1{}, s2{};
  T *c1 = c + ldc, *c2 = c1 + ldc;
  if (add) load(s0, c), load(s1, c1), load(s2, c2);
  for (int k = 0; k < K; ++k, a += lda, b += lda) {
    V x;
    load(x, a);
    subtract_fused(s0, x, b[0]), subtract_fused(s1, x, b[1]), subtract_fused(s2, x, b[2]);
  }
  store(c, s0), store(c1, s1), store(c2, s2);
}

template <typename T>
PIGMENT_INLINE void subtract_product(T* c, int ldc, int begin, int end, const T* a, const T* b, int lda, int K, bool add) {
  constexpr int L = lanes_of<T>;
  int i = begin;
  for (; i + 3 * L <= end; i += 3 * L) subtract_three_vectors(c + i, ldc, a + i, b, lda, K, add);
  for (; i < end; i += L) subtract_one_vector(c + i, ldc, a + i, b, lda, K, add);
}

// Columns j to j + 2 of a front, from which those before have been subtracted. The diagonal is left as its inverse.
template <typename T>
PIGMENT_INLINE bool factor_columns(T* v, int ld, int j) {
  using V = typename VectorOf<T>::type;
  T *c0 = v + static_cast<std::size_t>(j) * ld, *c1 = c0 + ld, *c2 = c1 + ld;
  const T d00 = c0[j], d10 = c0[j + 1], d20 = c0[j + 2];
  if (!(d00 > 0)) return false;
  const T i0 = 1 / std::sqrt(d00), l10 = d10 * i0, l20 = d20 * i0;
  const T d11 = c1[j + 1] - l10 * l10;
  if (!(d11 > 0)) return false;
  const T i1 = 1 / std::sqrt(d11), l21 = (c1[j + 2] - l20 * l10) * i1;
  const T d22 = c2[j + 2] - l20 * l20 - l21 * l21;
  if (!(d22 > 0)) return false;
  const T i2 = 1 / std::sqrt(d22);
  if (!(i0 > 0 && i1 > 0 && i2 > 0)) return false;
  for (int i = lane_start<T>(j); i < ld; i += lanes_of<T>) {
    V x, y, z;
    load(x, c0 + i);
    load(y, c1 + i);
    load(z, c2 + i);
    x *= i0;
    y = (y - x * l10) * i1;
    z = (z - x * l20 - y * l21) * i2;
    store(c0 + i, x);
    store(c1 + i, y);
    store(c2 + i, z);
  }
  c0[j] = i0, c0[j + 1] = l10, c0[j + 2] = l20;
  c1[j] = 0, c1[j + 1] = i1, c1[j + 2] = l21;
  c2[j] = c2[j + 1] = 0, c2[j + 2] = i2;
  return true;
}

namespace kernel {

template <typename T>
PIGMENT_INLINE void subtract_from_own(const Front<T>& f, int begin, int end, int column) {
  const auto rows = static_cast<std::size_t>(f.rows());
  const T* panel = f.values + begin * rows;
  subtract_product(f.values + column * rows, f.rows(), lane_start<T>(column), f.rows(), panel, panel + column, f.rows(), end - begin, true);
}
template <typename T>
PIGMENT_INLINE void subtract_from_below(const Front<T>& f, int begin, int end, int column, bool add) {
  const T* panel = f.values + static_cast<std::size_t>(begin) * f.rows() + f.own_rows();
  subtract_product(f.update + static_cast<std::size_t>(column) * f.below_rows(), f.below_rows(), first_row(column), f.below_rows(), panel, panel + column,
                   f.rows(), end - begin, add || begin > 0);
}
template <typename T>
PIGMENT_INLINE bool factor_panel(const Front<T>& f, int begin, int end) {
  for (int column = begin; column < end; column += B) {
    kernel::subtract_from_own(f, begin, column, column);
    if (!factor_columns(f.values, f.rows(), column)) return false;
  }
  return true;
}
template <typename T>
PIGMENT_INLINE bool factor_front(const Front<T>& f, bool add) {
  for (int begin = 0; begin < f.own; begin += front_panel) {
    const int end = std::min(begin + front_panel, f.own);
    if (!kernel::factor_panel(f, begin, end)) return false;
    for (int column = end; column < f.own; column += B) kernel::subtract_from_own(f, begin, end, column);
    for (int column = 0; column < f.below; column += B) kernel::subtract_from_below(f, begin, end, column, add);
  }
  return true;
}

PIGMENT_INLINE void keep_columns(const Front<double>& f, int begin, int end, float* to) {
  const auto rows = static_cast<std::size_t>(f.rows());
  for (std::size_t q = begin * rows; q < end * rows; q += lanes) {
    Lanes v;
    load(v, f.values + q);
    store_single(to + q, v);
  }
}

// Three columns from `column` on.
struct Three {
  const float *c0, *c1, *c2;
};
PIGMENT_INLINE Three columns(const KeptColumns& f, int column) {
  const float* c0 = f.values + static_cast<std::size_t>(column) * f.rows();
  return {c0, c0 + f.rows(), c0 + 2 * f.rows()};
}

template <int N>
PIGMENT_INLINE void forward_rows(const KeptColumns& f, int begin, int end, Sides<N> x, int row, int row_end, Sides<N> w) {
  for (int j = begin; j < end; j += B) {
    const auto [c0, c1, c2] = columns(f, j);
    for (int i = row; i < row_end; i += lanes) {
      Lanes a, b, c;
      load_single(a, c0 + i), load_single(b, c1 + i), load_single(c, c2 + i);
      for (int n = 0; n < N; ++n) add_to(w.of[n] + i, a * x.of[n][j] + b * x.of[n][j + 1] + c * x.of[n][j + 2]);
    }
  }
}
template <int N>
PIGMENT_INLINE void forward_panel(const KeptColumns& f, int begin, int end, Sides<N> x, Sides<N> w) {
  for (int j = begin; j < end; j += B) {
    const auto [c0, c1, c2] = columns(f, j);
    for (int n = 0; n < N; ++n) {
      double *y = x.of[n], *lost = w.of[n];
      const double x0 = (y[j] - lost[j]) * c0[j], x1 = (y[j + 1] - lost[j + 1] - c0[j + 1] * x0) * c1[j + 1],
                   x2 = (y[j + 2] - lost[j + 2] - c0[j + 2] * x0 - c1[j + 2] * x1) * c2[j + 2];
      y[j] = x0, y[j + 1] = x1, y[j + 2] = x2;
      for (int i = j + B; i % lanes && i < end; ++i) lost[i] += c0[i] * x0 + c1[i] * x1 + c2[i] * x2;
    }
    if (const int i = whole_lanes(j + B); i < end) kernel::forward_rows(f, j, j + B, x, i, whole_lanes(end), w);
  }
}
template <int N>
PIGMENT_INLINE void backward_columns(const KeptColumns& f, int column, int panel_end, Sides<N> x, Sides<N> w) {
  const auto [c0, c1, c2] = columns(f, column);
  Lanes s0[N] = {}, s1[N] = {}, s2[N] = {};
  for (int i = whole_lanes(panel_end); i < f.rows(); i += lanes) {
    Lanes a, b, c;
    load_single(a, c0 + i), load_single(b, c1 + i), load_single(c, c2 + i);
    for (int n = 0; n < N; ++n) {
      Lanes at;
      load(at, w.of[n] + i);
      s0[n] += a * at, s1[n] += b * at, s2[n] += c * at;
    }
  }
  for (int n = 0; n < N; ++n) {
    double* y = x.of[n] + column;
    y[0] -= sum_of(s0[n]), y[1] -= sum_of(s1[n]), y[2] -= sum_of(s2[n]);
  }
}
template <int N>
PIGMENT_INLINE void backward_panel(const KeptColumns& f, int begin, int end, Sides<N> x, Sides<N> w) {
  for (int j = end - B; j >= begin; j -= B) {
    const auto [c0, c1, c2] = columns(f, j);
    for (int n = 0; n < N; ++n) {
      double* y = x.of[n];
      double r0 = y[j], r1 = y[j + 1], r2 = y[j + 2];
      for (int i = j + B; i < end; ++i) r0 -= c0[i] * y[i], r1 -= c1[i] * y[i], r2 -= c2[i] * y[i];
      y[j + 2] = r2 * c2[j + 2];
      y[j + 1] = (r1 - c1[j + 2] * y[j + 2]) * c1[j + 1];
      y[j] = (r0 - c0[j + 1] * y[j + 1] - c0[j + 2] * y[j + 2]) * c0[j];
    }
  }
  for (int n = 0; n < N; ++n) std::copy(x.of[n] + begin, x.of[n] + end, w.of[n] + begin);
}

template <typename T>
PIGMENT_INLINE void add_runs(T* to, std::size_t to_rows, const T* of, std::size_t of_rows, int first, std::span<const Run> runs) {
  using V = typename VectorOf<T>::type;
  for (const Run& run : runs) {
    const int skipped = std::max(first - run.from, 0), n = run.length - skipped;
    if (n <= 0) continue;
    for (int column = 0; column < B; ++column) {
      T* t = to + column * to_rows + run.to + skipped;
      const T* o = of + column * of_rows + run.from + skipped;
      int i = 0;
      for (; i + lanes_of<T> <= n; i += lanes_of<T>) {
        V v, sum;
        load(v, o + i);
        load(sum, t + i);
        sum += v;
        store(t + i, sum);
      }
      for (; i < n; ++i) t[i] += o[i];
    }
  }
}

}  // namespace kernel

namespace wide {
template <typename T>
PIGMENT_WIDE bool factor_panel(const Front<T>& f, int begin, int end) { return kernel::factor_panel(f, begin, end); }
template <typename T>
PIGMENT_WIDE void subtract_from_own(const Front<T>& f, int begin, int end, int column) { kernel::subtract_from_own(f, begin, end, column); }
template <typename T>
PIGMENT_WIDE void subtract_from_below(const Front<T>& f, int begin, int end, int column, bool add) { kernel::subtract_from_below(f, begin, end, column, add); }
template <typename T>
PIGMENT_WIDE bool factor_front(const Front<T>& f, bool add) { return kernel::factor_front(f, add); }
PIGMENT_WIDE void keep_columns(const Front<double>& f, int begin, int end, float* to) { kernel::keep_columns(f, begin, end, to); }
template <int N>
PIGMENT_WIDE void forward_panel(const KeptColumns& f, int begin, int end, Sides<N> x, Sides<N> w) { kernel::forward_panel(f, begin, end, x, w); }
template <int N>
PIGMENT_WIDE void forward_rows(const KeptColumns& f, int begin, int end, Sides<N> x, int row, int row_end, Sides<N> w) { kernel::forward_rows(f, begin, end, x, row, row_end, w); }
template <int N>
PIGMENT_WIDE void backward_columns(const KeptColumns& f, int column, int panel_end, Sides<N> x, Sides<N> w) { kernel::backward_columns(f, column, panel_end, x, w); }
template <int N>
PIGMENT_WIDE void backward_panel(const KeptColumns& f, int begin, int end, Sides<N> x, Sides<N> w) { kernel::backward_panel(f, begin, end, x, w); }
template <typename T>
PIGMENT_WIDE void add_runs(T* to, std::size_t to_rows, const T* of, std::size_t of_rows, int first, std::span<const Run> runs) { kernel::add_runs(to, to_rows, of, of_rows, first, runs); }
}  // namespace wide

}  // namespace

template <typename T>
bool factor_panel(const Front<T>& f, int begin, int end) {
  return wide_processor() ? wide::factor_panel(f, begin, end) : kernel::factor_panel(f, begin, end);
}
template <typename T>
void subtract_from_own(const Front<T>& f, int begin, int end, int column) {
  wide_processor() ? wide::subtract_from_own(f, begin, end, column) : kernel::subtract_from_own(f, begin, end, column);
}
template <typename T>
void subtract_from_below(const Front<T>& f, int begin, int end, int column, bool add) {
  wide_processor() ? wide::subtract_from_below(f, begin, end, column, add) : kernel::subtract_from_below(f, begin, end, column, add);
}
template <typename T>
bool factor_front(const Front<T>& f, bool add) {
  return wide_processor() ? wide::factor_front(f, add) : kernel::factor_front(f, add);
}
void keep_columns(const Front<double>& f, int begin, int end, float* to) { wide_processor() ? wide::keep_columns(f, begin, end, to) : kernel::keep_columns(f, begin, end, to); }
template <int N>
void forward_panel(const KeptColumns& f, int begin, int end, Sides<N> x, Sides<N> w) {
  wide_processor() ? wide::forward_panel(f, begin, end, x, w) : kernel::forward_panel(f, begin, end, x, w);
}
template <int N>
void forward_rows(const KeptColumns& f, int begin, int end, Sides<N> x, int row, int row_end, Sides<N> w) {
  wide_processor() ? wide::forward_rows(f, begin, end, x, row, row_end, w) : kernel::forward_rows(f, begin, end, x, row, row_end, w);
}
template <int N>
void backward_columns(const KeptColumns& f, int column, int panel_end, Sides<N> x, Sides<N> w) {
  wide_processor() ? wide::backward_columns(f, column, panel_end, x, w) : kernel::backward_columns(f, column, panel_end, x, w);
}
template <int N>
void backward_panel(const KeptColumns& f, int begin, int end, Sides<N> x, Sides<N> w) {
  wide_processor() ? wide::backward_panel(f, begin, end, x, w) : kernel::backward_panel(f, begin, end, x, w);
}
template void forward_panel<1>(const KeptColumns&, int, int, Sides<1>, Sides<1>);
template void forward_panel<2>(const KeptColumns&, int, int, Sides<2>, Sides<2>);
template void forward_rows<1>(const KeptColumns&, int, int, Sides<1>, int, int, Sides<1>);
template void forward_rows<2>(const KeptColumns&, int, int, Sides<2>, int, int, Sides<2>);
template void backward_columns<1>(const KeptColumns&, int, int, Sides<1>, Sides<1>);
template void backward_columns<2>(const KeptColumns&, int, int, Sides<2>, Sides<2>);
template void backward_panel<1>(const KeptColumns&, int, int, Sides<1>, Sides<1>);
template void backward_panel<2>(const KeptColumns&, int, int, Sides<2>, Sides<2>);
template <typename T>
void add_runs(T* to, std::size_t to_rows, const T* of, std::size_t of_rows, int first, std::span<const Run> runs) {
  wide_processor() ? wide::add_runs(to, to_rows, of, of_rows, first, runs) : kernel::add_runs(to, to_rows, of, of_rows, first, runs);
}
template bool factor_panel(const Front<float>&, int, int);
template bool factor_panel(const Front<double>&, int, int);
template void subtract_from_own(const Front<float>&, int, int, int);
template void subtract_from_own(const Front<double>&, int, int, int);
template void subtract_from_below(const Front<float>&, int, int, int, bool);
template void subtract_from_below(const Front<double>&, int, int, int, bool);
template bool factor_front(const Front<float>&, bool);
template bool factor_front(const Front<double>&, bool);
template void add_runs(float*, std::size_t, const float*, std::size_t, int, std::span<const Run>);
template void add_runs(double*, std::size_t, const double*, std::size_t, int, std::span<const Run>);

}  // namespace pigment::solve
