#include "solve/pair_system.h"

#include <algorithm>
#include <cassert>

#include "solve/pair_kernel.h"

namespace pigment::solve {

PairTopology::PairTopology(std::size_t particles, const std::vector<std::int32_t>& pair_i,
                           const std::vector<std::int32_t>& pair_j)
    : particles_(particles), chunks_(make_chunks(particles)), target_(pair_i.size()) {
  const int count = chunks_.count();
  pair_begin_.assign(count + 1, pair_i.size());
  halo_begin_.assign(count + 1, 0);
  std::vector<std::int32_t> slot_of(particles, -1);
  std::vector<std::int32_t> owner;  // particle of each halo slot
  std::size_t p = 0;
  for (int c = 0; c < count; ++c) {
    pair_begin_[c] = p;
    halo_begin_[c] = owner.size();
    const std::size_t first = owner.size();
    for (; p < pair_i.size() && pair_i[p] < chunks_.begin[c + 1]; ++p) {
      assert(pair_i[p] >= chunks_.begin[c]);
      const std::int32_t j = pair_j[p];
      if (j >= chunks_.begin[c] && j < chunks_.begin[c + 1]) {
        target_[p] = j;
        continue;
      }
      if (slot_of[j] < 0) {
        slot_of[j] = static_cast<std::int32_t>(owner.size());
        owner.push_back(j);
      }
      target_[p] = static_cast<std::int32_t>(particles) + slot_of[j];
    }
    for (std::size_t s = first; s < owner.size(); ++s) slot_of[owner[s]] = -1;
  }
  pair_begin_[count] = pair_i.size();
  halo_begin_[count] = owner.size();
  slot_begin_.assign(particles + 1, 0);
  for (std::int32_t k : owner) ++slot_begin_[k + 1];
  for (std::size_t k = 0; k < particles; ++k) slot_begin_[k + 1] += slot_begin_[k];
  slots_.resize(owner.size());
  std::vector<std::int32_t> next(slot_begin_.begin(), slot_begin_.end() - 1);
  for (std::size_t s = 0; s < owner.size(); ++s) slots_[next[owner[s]]++] = static_cast<std::int32_t>(s);
}

namespace {

template <int D>
void apply_all(const PairSystem& system, const std::vector<double>& x, std::vector<double>& y) {
  const PairTopology& topology = *system.topology;
  const int count = topology.chunks().count();
  std::vector<double> sum((topology.particles() + topology.halo_count()) * D);
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) apply_chunk<D>(system, c, x.data(), sum.data());
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) gather_halo<D>(topology, c, sum.data());
  }
  y.assign(sum.begin(), sum.begin() + topology.particles() * D);
}

// The diagonal blocks of one pair: its own arithmetic applied to unit motions of one particle, the other at rest.
template <int D>
std::vector<double> blocks(const PairSystem& system) {
  const PairTopology& topology = *system.topology;
  const int count = topology.chunks().count();
  constexpr int B = D * D;
  const std::size_t n = topology.particles();
  std::vector<double> block((n + topology.halo_count()) * B, 0.0);
  const auto add_outer = [](double* m, const double (&u)[D], double weight) {
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) m[r * D + c] += weight * u[r] * u[c];
  };
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) {
      for (int k = topology.chunks().begin[c]; k < topology.chunks().begin[c + 1]; ++k) {
        for (int d = 0; d < D; ++d) {
          double unit[D] = {}, column[D];
          unit[d] = 1;
          add_particle<D>(system.particle[k], unit, column);
          for (int r = 0; r < D; ++r) block[k * B + r * D + d] = column[r];
        }
      }
      for (const SqueezePair& p : system.squeeze[c]) {
        double u[D] = {};
        for (int d = 0; d < 3; ++d) u[d] = p.n[d];
        add_outer(&block[p.i * B], u, p.squeeze);
        add_outer(&block[static_cast<std::size_t>(p.target) * B], u, p.squeeze);
      }
      for (const FullPair& p : system.full[c]) {
        for (int side = 0; side < 2; ++side) {
          double* m = &block[(side == 0 ? static_cast<std::size_t>(p.i) : static_cast<std::size_t>(p.target)) * B];
          const double zero[D] = {};
          for (int d = 0; d < D; ++d) {
            double unit[D] = {}, yi[D] = {}, yj[D] = {};
            unit[d] = 1;
            if (side == 0) add_full_pair<D>(p, unit, zero, yi, yj);
            else add_full_pair<D>(p, zero, unit, yi, yj);
            for (int r = 0; r < D; ++r) m[r * D + d] += side == 0 ? yi[r] : yj[r];
          }
        }
      }
    }
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c)
      for (int k = topology.chunks().begin[c]; k < topology.chunks().begin[c + 1]; ++k)
        for (const std::int32_t* slot = topology.slots_begin(k); slot != topology.slots_end(k); ++slot)
          for (int d = 0; d < B; ++d) block[k * B + d] += block[(n + *slot) * B + d];
  }
  block.resize(n * B);
  return block;
}

}  // namespace

void apply(const PairSystem& system, const std::vector<double>& x, std::vector<double>& y) {
  if (system.rotation) apply_all<6>(system, x, y);
  else apply_all<3>(system, x, y);
}

std::vector<double> diagonal_blocks(const PairSystem& system) {
  return system.rotation ? blocks<6>(system) : blocks<3>(system);
}

}  // namespace pigment::solve
