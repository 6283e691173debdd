#include "solve/pair_product.h"

#include <cstdint>

#include "solve/pair_kernel.h"

namespace pigment::solve {

namespace {

PIGMENT_INLINE void gather(const double* x, const std::int32_t* index, int step, int offset, Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  load(a, x + static_cast<std::size_t>(index[0]) * step + offset);
  load(b, x + static_cast<std::size_t>(index[1]) * step + offset);
  load(c, x + static_cast<std::size_t>(index[2]) * step + offset);
  load(d, x + static_cast<std::size_t>(index[3]) * step + offset);
  transpose(a, b, c, d);
}
// Lane by lane, so that pairs that share a particle add to it one after the other.
PIGMENT_INLINE void scatter(double* y, const std::int32_t* index, int step, int offset, const Lanes& x0, const Lanes& x1, const Lanes& x2) {
  Lanes a = x0, b = x1, c = x2, d = {0, 0, 0, 0};
  transpose(a, b, c, d);
  add_to(y + static_cast<std::size_t>(index[0]) * step + offset, a);
  add_to(y + static_cast<std::size_t>(index[1]) * step + offset, b);
  add_to(y + static_cast<std::size_t>(index[2]) * step + offset, c);
  add_to(y + static_cast<std::size_t>(index[3]) * step + offset, d);
}

// The arithmetic of add_full_pair (solve/pair_kernel.h), four pairs at a time.
template <int D>
PIGMENT_INLINE void add_full_block(const FullBlock& block, const double* x, double* y) {
  constexpr int S = stride<D>;
  Lanes n0, n1, n2, l_i, l_j, squeeze, twist, a, b, c;
  load(n0, block.number[0]);
  load(n1, block.number[1]);
  load(n2, block.number[2]);
  load(squeeze, block.number[5]);
  load(a, block.number[7]);
  Lanes v0, v1, v2, o0, o1, o2, pad;
  gather(x, block.i, S, 0, v0, v1, v2, pad);
  gather(x, block.j, S, 0, o0, o1, o2, pad);
  v0 -= o0;
  v1 -= o1;
  v2 -= o2;
  const Lanes fn = squeeze * (n0 * v0 + n1 * v1 + n2 * v2);
  Lanes s0 = n1 * v2 - n2 * v1, s1 = n2 * v0 - n0 * v2, s2 = n0 * v1 - n1 * v0;
  Lanes g0, g1, g2;
  if constexpr (D == 6) {
    load(l_i, block.number[3]);
    load(l_j, block.number[4]);
    load(twist, block.number[6]);
    load(b, block.number[8]);
    load(c, block.number[9]);
    Lanes w0, w1, w2;
    gather(x, block.i, S, 4, w0, w1, w2, pad);
    gather(x, block.j, S, 4, o0, o1, o2, pad);
    const Lanes m0 = l_i * w0 + l_j * o0, m1 = l_i * w1 + l_j * o1, m2 = l_i * w2 + l_j * o2;
    const Lanes mn = n0 * m0 + n1 * m1 + n2 * m2;
    s0 += m0 - mn * n0;
    s1 += m1 - mn * n1;
    s2 += m2 - mn * n2;
    w0 -= o0;
    w1 -= o1;
    w2 -= o2;
    const Lanes wn = n0 * w0 + n1 * w1 + n2 * w2;
    w0 -= wn * n0;
    w1 -= wn * n1;
    w2 -= wn * n2;
    g0 = a * s0 + b * w0;
    g1 = a * s1 + b * w1;
    g2 = a * s2 + b * w2;
    const Lanes tn = twist * wn;
    const Lanes t0 = b * s0 + c * w0 + tn * n0, t1 = b * s1 + c * w1 + tn * n1, t2 = b * s2 + c * w2 + tn * n2;
    scatter(y, block.i, S, 4, l_i * g0 + t0, l_i * g1 + t1, l_i * g2 + t2);
    scatter(y, block.target, S, 4, l_j * g0 - t0, l_j * g1 - t1, l_j * g2 - t2);
  } else {
    g0 = a * s0;
    g1 = a * s1;
    g2 = a * s2;
  }
  const Lanes f0 = fn * n0 + g1 * n2 - g2 * n1, f1 = fn * n1 + g2 * n0 - g0 * n2, f2 = fn * n2 + g0 * n1 - g1 * n0;
  scatter(y, block.i, S, 0, f0, f1, f2);
  scatter(y, block.target, S, 0, -f0, -f1, -f2);
}

template <int D>
PIGMENT_INLINE void add_squeeze_block(const SqueezeBlock& block, const double* x, double* y) {
  constexpr int S = stride<D>;
  Lanes n0, n1, n2, squeeze;
  load(n0, block.number[0]);
  load(n1, block.number[1]);
  load(n2, block.number[2]);
  load(squeeze, block.number[3]);
  Lanes v0, v1, v2, o0, o1, o2, pad;
  gather(x, block.i, S, 0, v0, v1, v2, pad);
  gather(x, block.j, S, 0, o0, o1, o2, pad);
  const Lanes f = squeeze * (n0 * (v0 - o0) + n1 * (v1 - o1) + n2 * (v2 - o2));
  scatter(y, block.i, S, 0, f * n0, f * n1, f * n2);
  scatter(y, block.target, S, 0, -(f * n0), -(f * n1), -(f * n2));
}

template <int D>
PIGMENT_INLINE void add_own_block(const OwnBlock& block, const double* x, double* y) {
  const double* u = x + static_cast<std::size_t>(block.particle) * stride<D>;
  double* f = y + static_cast<std::size_t>(block.particle) * stride<D>;
  for (int r = 0; r < D; ++r) {
    double sum = 0;
    for (int c = 0; c < D; ++c) sum += block.entry[c <= r ? r * (r + 1) / 2 + c : c * (c + 1) / 2 + r] * u[place<D>(c)];
    f[place<D>(r)] += sum;
  }
}

// A block is read once a product, from far away: asked for this many blocks before its turn.
constexpr std::size_t blocks_ahead = 6, bytes_of_line = 64;
template <typename Block>
PIGMENT_INLINE void ask_beyond(const Block& block) {
  const std::uintptr_t ahead = reinterpret_cast<std::uintptr_t>(&block) + blocks_ahead * sizeof(Block);  // past the end it asks for nothing that is used
  for (std::size_t at = 0; at < sizeof(Block); at += bytes_of_line) __builtin_prefetch(reinterpret_cast<const void*>(ahead + at));
}

template <int D>
PIGMENT_INLINE void add_chunk(const PairSystem& system, int chunk, const double* x, double* y) {
  constexpr int S = stride<D>;
  const PairTopology& topology = *system.topology;
  const int begin = topology.chunks().begin[chunk], end = topology.chunks().begin[chunk + 1];
  for (int k = begin; k < end; ++k) {
    const ParticleTerm& p = system.particle[k];
    const double* u = x + static_cast<std::size_t>(k) * S;
    double* f = y + static_cast<std::size_t>(k) * S;
    f[0] = p.across * u[0];
    f[1] = p.across * u[1];
    f[2] = p.along * u[2];
    f[3] = 0;
    if constexpr (D == 6) {
      // W x z = (W_y, -W_x), z x U = (-U_y, U_x)
      f[0] += p.coupling * u[5];
      f[1] -= p.coupling * u[4];
      f[4] = p.spin_across * u[4] - p.coupling * u[1];
      f[5] = p.spin_across * u[5] + p.coupling * u[0];
      f[6] = p.spin_along * u[6];
      f[7] = 0;
    }
  }
  if (!system.own.empty())
    for (const OwnBlock& block : system.own[chunk]) add_own_block<D>(block, x, y);
  const std::size_t halo = topology.first_slot();
  // What the chunk reads of others lies scattered: asked for all at once, it is there when the pairs need it.
  for (std::size_t h = topology.halo_begin(chunk); h < topology.halo_begin(chunk + 1); ++h) __builtin_prefetch(x + static_cast<std::size_t>(topology.owner(h)) * S);
  for (std::size_t h = (halo + topology.halo_begin(chunk)) * S; h < (halo + topology.halo_begin(chunk + 1)) * S; ++h) y[h] = 0;
  for (const FullBlock& block : system.full[chunk].blocks()) {
    ask_beyond(block);
    add_full_block<D>(block, x, y);
  }
  for (const SqueezeBlock& block : system.squeeze[chunk].blocks()) {
    ask_beyond(block);
    add_squeeze_block<D>(block, x, y);
  }
}

template <int D>
PIGMENT_WIDE void add_chunk_wide(const PairSystem& system, int chunk, const double* x, double* y) {
  add_chunk<D>(system, chunk, x, y);
}
template <int D>
void add_chunk_narrow(const PairSystem& system, int chunk, const double* x, double* y) {
  add_chunk<D>(system, chunk, x, y);
}

}  // namespace

template <int D>
void apply_chunk(const PairSystem& system, int chunk, const double* x, double* y, MeanFlowSums& sums) {
  if (wide_processor()) add_chunk_wide<D>(system, chunk, x, y);
  else add_chunk_narrow<D>(system, chunk, x, y);
  const Chunks& chunks = system.topology->chunks();
  if (!system.mean_flow.empty()) sum_mean_flow<stride<D>>(system.mean_flow, chunk, chunks.begin[chunk], chunks.begin[chunk + 1], x, sums);
}

template <int D>
double finish_chunk(const PairSystem& system, int chunk, bool mask, const double* x, double* y, const MeanFlowSums& sums) {
  constexpr int S = stride<D>;
  const PairTopology& topology = *system.topology;
  const std::size_t halo = topology.first_slot();
  const int begin = topology.chunks().begin[chunk], end = topology.chunks().begin[chunk + 1];
  for (const std::int32_t* slot = topology.slots_begin(begin); slot != topology.slots_begin(end); ++slot)
    __builtin_prefetch(y + (halo + static_cast<std::size_t>(*slot)) * S);
  for (int k = begin; k < end; ++k) {
    Lanes sum[S / lanes];
    for (int q = 0; q < S / lanes; ++q) load(sum[q], y + static_cast<std::size_t>(k) * S + q * lanes);
    for (const std::int32_t* slot = topology.slots_begin(k); slot != topology.slots_end(k); ++slot)
      for (int q = 0; q < S / lanes; ++q) {
        Lanes part;
        load(part, y + (halo + static_cast<std::size_t>(*slot)) * S + q * lanes);
        sum[q] += part;
      }
    for (int q = 0; q < S / lanes; ++q) store(y + static_cast<std::size_t>(k) * S + q * lanes, sum[q]);
  }
  if (!system.mean_flow.empty()) add_mean_flow<S>(system.mean_flow, begin, end, sums, y);
  if (mask)
    for (int k = begin; k < end; ++k)
      if (system.held[k]) y[static_cast<std::size_t>(k) * S + 2] = 0;
  Lanes product = {0, 0, 0, 0};
  for (std::size_t q = static_cast<std::size_t>(begin) * S; q < static_cast<std::size_t>(end) * S; q += lanes) {
    Lanes a, b;
    load(a, x + q);
    load(b, y + q);
    product += a * b;
  }
  return sum_of(product);
}

template <int D>
void to_strided(const std::vector<double>& x, double* strided) {
  const std::size_t n = x.size() / D;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < n; ++k) {
    for (int q = 3; q < stride<D>; q += lanes) strided[k * stride<D> + q] = 0;
    for (int d = 0; d < D; ++d) strided[k * stride<D> + place<D>(d)] = x[k * D + d];
  }
}
template <int D>
void from_strided(const double* strided, std::vector<double>& x) {
  const std::size_t n = x.size() / D;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < n; ++k)
    for (int d = 0; d < D; ++d) x[k * D + d] = strided[k * stride<D> + place<D>(d)];
}

template void apply_chunk<3>(const PairSystem&, int, const double*, double*, MeanFlowSums&);
template void apply_chunk<6>(const PairSystem&, int, const double*, double*, MeanFlowSums&);
template double finish_chunk<3>(const PairSystem&, int, bool, const double*, double*, const MeanFlowSums&);
template double finish_chunk<6>(const PairSystem&, int, bool, const double*, double*, const MeanFlowSums&);
template void to_strided<3>(const std::vector<double>&, double*);
template void to_strided<6>(const std::vector<double>&, double*);
template void from_strided<3>(const double*, std::vector<double>&);
template void from_strided<6>(const double*, std::vector<double>&);

}  // namespace pigment::solve
