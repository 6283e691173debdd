#include "solve/block_jacobi.h"

#include <cmath>

namespace pigment::solve {

namespace {

constexpr int at(int row, int column) { return row * (row + 1) / 2 + column; }

// Solves L L^T z = r for four particles; v holds r and then z, one Lanes an unknown.
template <int D>
PIGMENT_INLINE void solve_lanes(const double* factor, Lanes* v) {
  Lanes l[D * (D + 1) / 2];
  for (int q = 0; q < D * (D + 1) / 2; ++q) load(l[q], factor + q * lanes);
  for (int i = 0; i < D; ++i) {
    for (int q = 0; q < i; ++q) v[i] -= l[at(i, q)] * v[q];
    v[i] *= l[at(i, i)];
  }
  for (int i = D - 1; i >= 0; --i) {
    for (int q = i + 1; q < D; ++q) v[i] -= l[at(q, i)] * v[q];
    v[i] *= l[at(i, i)];
  }
}

template <int D>
PIGMENT_INLINE double solve_range(const double* factor, int begin, int end, const double* r, double* z) {
  constexpr int S = stride<D>, entries = D * (D + 1) / 2;
  Lanes product = {0, 0, 0, 0};
  for (int k = begin; k < end; k += lanes) {
    const double* from = r + static_cast<std::size_t>(k) * S;
    double* to = z + static_cast<std::size_t>(k) * S;
    Lanes row[2 * lanes];
    for (int part = 0; part < S / lanes; ++part) {
      for (int q = 0; q < lanes; ++q) load(row[part * lanes + q], from + q * S + part * lanes);
      transpose(row[part * lanes], row[part * lanes + 1], row[part * lanes + 2], row[part * lanes + 3]);
    }
    Lanes v[D];
    for (int d = 0; d < D; ++d) v[d] = row[place<D>(d)];
    solve_lanes<D>(factor + static_cast<std::size_t>(k) * entries, v);
    for (int d = 0; d < D; ++d) {
      product += row[place<D>(d)] * v[d];
      row[place<D>(d)] = v[d];
    }
    for (int part = 0; part < S / lanes; ++part) {
      transpose(row[part * lanes], row[part * lanes + 1], row[part * lanes + 2], row[part * lanes + 3]);
      for (int q = 0; q < lanes; ++q) store(to + q * S + part * lanes, row[part * lanes + q]);
    }
  }
  return sum_of(product);
}

template <int D>
PIGMENT_INLINE double update_range(const double* factor, int begin, int end, double alpha, const double* p, const double* ap, double* x,
                                   double* r, double* z) {
  constexpr int S = stride<D>;
  // To the end of the last four: beyond the particles every vector is zero.
  const std::size_t last = static_cast<std::size_t>(begin + (end - begin + lanes - 1) / lanes * lanes) * S;
  for (std::size_t q = static_cast<std::size_t>(begin) * S; q < last; q += lanes) {
    Lanes vp, va, vx, vr;
    load(vp, p + q);
    load(va, ap + q);
    load(vx, x + q);
    load(vr, r + q);
    vx += alpha * vp;
    vr -= alpha * va;
    store(x + q, vx);
    store(r + q, vr);
  }
  return solve_range<D>(factor, begin, end, r, z);
}

template <int D>
PIGMENT_WIDE double solve_wide(const double* f, int begin, int end, const double* r, double* z) { return solve_range<D>(f, begin, end, r, z); }
template <int D>
double solve_narrow(const double* f, int begin, int end, const double* r, double* z) { return solve_range<D>(f, begin, end, r, z); }
template <int D>
PIGMENT_WIDE double update_wide(const double* f, int begin, int end, double alpha, const double* p, const double* ap, double* x, double* r, double* z) {
  return update_range<D>(f, begin, end, alpha, p, ap, x, r, z);
}
template <int D>
double update_narrow(const double* f, int begin, int end, double alpha, const double* p, const double* ap, double* x, double* r, double* z) {
  return update_range<D>(f, begin, end, alpha, p, ap, x, r, z);
}

}  // namespace

template <int D>
BlockJacobi<D>::BlockJacobi(const PairSystem& system) : factor_(system.topology->first_slot() * entries) {
  const PairTopology& topology = *system.topology;
  const std::size_t n = topology.particles();
  const int count = topology.chunks().count();
  // The blocks come into being where their factors will stand: first particle by particle, then four side by side.
  Scratch halo(topology.halo_count() * entries);
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) own_diagonal_blocks<D>(system, c, factor_.data(), halo.data());
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) {
      gather_diagonal_blocks<D>(topology, c, halo.data(), factor_.data());
      for (auto k = static_cast<std::size_t>(topology.chunks().begin[c]); k < static_cast<std::size_t>(topology.chunks().begin[c + 1]); k += lanes)
        factorize_four(system, k, n, &factor_[k * entries]);
    }
  }
}

template <int D>
void BlockJacobi<D>::factorize_four(const PairSystem& system, std::size_t first, std::size_t n, double* block) {
  Lanes l[entries];
  for (int lane = 0; lane < lanes; ++lane) {
    const std::size_t k = first + lane;
    for (int r = 0; r < D; ++r)
      for (int c = 0; c <= r; ++c) l[at(r, c)][lane] = k < n ? block[lane * entries + at(r, c)] : r == c;
    if (k < n && !system.held.empty() && system.held[k]) {
      for (int d = 0; d < D; ++d) l[d < 2 ? at(2, d) : at(d, 2)][lane] = 0;
      l[at(2, 2)][lane] = 1;
    }
  }
  for (int r = 0; r < D; ++r)
    for (int c = 0; c <= r; ++c) {
      Lanes sum = l[at(r, c)];
      for (int q = 0; q < c; ++q) sum -= l[at(r, q)] * l[at(c, q)];
      if (r == c)
        for (int lane = 0; lane < lanes; ++lane) sum[lane] = 1 / std::sqrt(sum[lane]);
      else
        sum *= l[at(c, c)];
      l[at(r, c)] = sum;
    }
  for (int q = 0; q < entries; ++q) store(block + q * lanes, l[q]);
}

template <int D>
double BlockJacobi<D>::solve(int begin, int end, const double* r, double* z) const {
  return wide_processor() ? solve_wide<D>(factor_.data(), begin, end, r, z) : solve_narrow<D>(factor_.data(), begin, end, r, z);
}
template <int D>
double BlockJacobi<D>::update(int begin, int end, double alpha, const double* p, const double* ap, double* x, double* r, double* z) const {
  return wide_processor() ? update_wide<D>(factor_.data(), begin, end, alpha, p, ap, x, r, z)
                          : update_narrow<D>(factor_.data(), begin, end, alpha, p, ap, x, r, z);
}

template class BlockJacobi<3>;
template class BlockJacobi<6>;

}  // namespace pigment::solve
