#include "solve/pair_system.h"

#include <algorithm>
#include <cassert>

#include "solve/pair_kernel.h"
#include "solve/pair_product.h"

namespace pigment::solve {

PairTopology::PairTopology(std::size_t particles, const std::vector<std::int32_t>& pair_i,
                           const std::vector<std::int32_t>& pair_j)
    : particles_(particles), chunks_(make_chunks(particles, pair_i)), target_(pair_i.size()) {
  const int count = chunks_.count();
  pair_begin_.assign(count + 1, pair_i.size());
  halo_begin_.assign(count + 1, 0);
  std::vector<std::int32_t> slot_of(particles, -1);
  std::size_t p = 0;
  for (int c = 0; c < count; ++c) {
    pair_begin_[c] = p;
    halo_begin_[c] = owner_.size();
    const std::size_t first = owner_.size();
    for (; p < pair_i.size() && pair_i[p] < chunks_.begin[c + 1]; ++p) {
      assert(pair_i[p] >= chunks_.begin[c]);
      const std::int32_t j = pair_j[p];
      if (j >= chunks_.begin[c] && j < chunks_.begin[c + 1]) {
        target_[p] = j;
        continue;
      }
      if (slot_of[j] < 0) {
        slot_of[j] = static_cast<std::int32_t>(owner_.size());
        owner_.push_back(j);
      }
      target_[p] = static_cast<std::int32_t>(first_slot()) + slot_of[j];
    }
    for (std::size_t s = first; s < owner_.size(); ++s) slot_of[owner_[s]] = -1;
  }
  pair_begin_[count] = pair_i.size();
  halo_begin_[count] = owner_.size();
  slot_begin_.assign(particles + 1, 0);
  for (std::int32_t k : owner_) ++slot_begin_[k + 1];
  for (std::size_t k = 0; k < particles; ++k) slot_begin_[k + 1] += slot_begin_[k];
  slots_.resize(owner_.size());
  std::vector<std::int32_t> next(slot_begin_.begin(), slot_begin_.end() - 1);
  for (std::size_t s = 0; s < owner_.size(); ++s) slots_[next[owner_[s]]++] = static_cast<std::int32_t>(s);
}

namespace {

template <int D>
void apply_all(const PairSystem& system, const std::vector<double>& x, std::vector<double>& y) {
  const PairTopology& topology = *system.topology;
  const int count = topology.chunks().count();
  Scratch in(input_size<D>(topology)), out(output_size<D>(topology));
  to_strided<D>(x, in.data());
  MeanFlowSums sums(system.mean_flow, count);
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) apply_chunk<D>(system, c, in.data(), out.data(), sums);
    if (!system.mean_flow.empty()) {
#pragma omp single
      sums.combine();
    }
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) finish_chunk<D>(system, c, false, in.data(), out.data(), sums);
  }
  y.resize(x.size());
  from_strided<D>(out.data(), y);
}

// What a full pair adds to the block of one of its particles, moving alone. With N = n x, P = 1 - n n^T, l its lever and
// sign = +1 for i, -1 for j: uu: squeeze n n^T + a P;  ww: (a l^2 + 2 sign b l + c) P + twist n n^T;
// uw: -sign (a l + sign b) N, and wu its transpose.
constexpr int at(int row, int column) { return row * (row + 1) / 2 + column; }

template <int D>
void add_full_block(const FullPair& p, double l, double sign, double* m) {
  const double* n = p.n;
  const double spin = p.a * l * l + 2 * sign * p.b * l + p.c, cross = sign * p.a * l + p.b;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c <= r; ++c) {
      const double nn = n[r] * n[c], projection = (r == c ? 1.0 : 0.0) - nn;
      m[at(r, c)] += p.squeeze * nn + p.a * projection;
      if constexpr (D == 6) m[at(r + 3, c + 3)] += spin * projection + p.twist * nn;
    }
  if constexpr (D == 6) {
    // The transpose of -cross N; N = [0 -nz ny; nz 0 -nx; -ny nx 0]
    m[at(4, 0)] += cross * n[2];
    m[at(5, 0)] -= cross * n[1];
    m[at(3, 1)] -= cross * n[2];
    m[at(5, 1)] += cross * n[0];
    m[at(3, 2)] += cross * n[1];
    m[at(4, 2)] -= cross * n[0];
  }
}

}  // namespace

template <int D>
void own_diagonal_blocks(const PairSystem& system, int c, double* block, double* halo) {
  const PairTopology& topology = *system.topology;
  constexpr std::size_t B = D * (D + 1) / 2;
  // Where what a pair adds to its particle j goes: targets from first_slot() on are the halo's.
  const auto of_target = [&, first = static_cast<std::int32_t>(topology.first_slot())](std::int32_t target) {
    return target < first ? block + static_cast<std::size_t>(target) * B : halo + static_cast<std::size_t>(target - first) * B;
  };
  for (int k = topology.chunks().begin[c]; k < topology.chunks().begin[c + 1]; ++k) {
    double* m = block + static_cast<std::size_t>(k) * B;
    for (int d = 0; d < D; ++d) {
      double unit[D] = {}, column[D];
      unit[d] = 1;
      add_particle<D>(system.particle[k], unit, column);
      for (int r = d; r < D; ++r) m[at(r, d)] = column[r];
    }
  }
  std::fill(halo + topology.halo_begin(c) * B, halo + topology.halo_begin(c + 1) * B, 0.0);
  if (!system.own.empty())
    for (const OwnBlock& own : system.own[c])
      for (std::size_t q = 0; q < B; ++q) block[static_cast<std::size_t>(own.particle) * B + q] += own.entry[q];
  for (const SqueezePair& p : system.squeeze[c]) {
    double *i = block + static_cast<std::size_t>(p.i) * B, *j = of_target(p.target);
    for (int r = 0; r < 3; ++r)
      for (int q = 0; q <= r; ++q) {
        const double value = p.squeeze * p.n[r] * p.n[q];
        i[at(r, q)] += value;
        j[at(r, q)] += value;
      }
  }
  for (const FullPair& p : system.full[c]) {
    add_full_block<D>(p, p.l_i, +1, block + static_cast<std::size_t>(p.i) * B);
    add_full_block<D>(p, p.l_j, -1, of_target(p.target));
  }
}

template <int D>
void gather_diagonal_blocks(const PairTopology& topology, int c, const double* halo, double* block) {
  constexpr std::size_t B = D * (D + 1) / 2;
  for (int k = topology.chunks().begin[c]; k < topology.chunks().begin[c + 1]; ++k)
    for (const std::int32_t* slot = topology.slots_begin(k); slot != topology.slots_end(k); ++slot)
      for (std::size_t d = 0; d < B; ++d) block[static_cast<std::size_t>(k) * B + d] += halo[static_cast<std::size_t>(*slot) * B + d];
}

template void own_diagonal_blocks<3>(const PairSystem&, int, double*, double*);
template void own_diagonal_blocks<6>(const PairSystem&, int, double*, double*);
template void gather_diagonal_blocks<3>(const PairTopology&, int, const double*, double*);
template void gather_diagonal_blocks<6>(const PairTopology&, int, const double*, double*);

namespace {

template <int D>
Scratch blocks(const PairSystem& system) {
  const PairTopology& topology = *system.topology;
  const int count = topology.chunks().count();
  constexpr std::size_t B = D * (D + 1) / 2;
  Scratch block(topology.particles() * B), halo(topology.halo_count() * B);
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) own_diagonal_blocks<D>(system, c, block.data(), halo.data());
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) gather_diagonal_blocks<D>(topology, c, halo.data(), block.data());
  }
  return block;
}

}  // namespace

void apply(const PairSystem& system, const std::vector<double>& x, std::vector<double>& y) {
  if (system.rotation) apply_all<6>(system, x, y);
  else apply_all<3>(system, x, y);
}

Scratch diagonal_blocks(const PairSystem& system) {
  return system.rotation ? blocks<6>(system) : blocks<3>(system);
}

}  // namespace pigment::solve
