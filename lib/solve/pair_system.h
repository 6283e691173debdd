#pragma once
// The linear system of one step, (R + dt K) U = F, kept as it is built: five scalars a particle and five (or one) a pair.
//
// Unknowns of particle k: velocity (3) and, with rotation, angular velocity (3), one after the other: x[k*D + ...], D = 3 or 6.
//   particle:  F_xy = across U_xy + coupling (W x z)_xy,  F_z = along U_z,
//              T_xy = spin_across W_xy + coupling (z x U)_xy,  T_z = spin_along W_z
//   pair:      v = u_i - u_j + (l_i w_i + l_j w_j) x n,  w = w_i - w_j,  s = n x v,  q = w - (n.w) n
//              g_s = a s + b q,  g_q = b s + c q
//              F_i = squeeze (n.v) n + g_s x n = -F_j,   T_i = l_i g_s + t,  T_j = l_j g_s - t,  t = twist (n.w) n + g_q
// l = radius + gap/2. The matrix is symmetric by construction. A pair is owned by the chunk of its particle i; what it adds to
// a particle j of another chunk goes to a slot of its own ("halo") and is gathered in fixed order, so no two threads ever
// write to one place and the sum has one order.
#include <cstdint>
#include <vector>

#include "base/scratch.h"
#include "solve/chunks.h"
#include "solve/mean_flow.h"
#include "solve/pair_blocks.h"

namespace pigment::solve {

struct ParticleTerm {
  double across = 0, along = 0, coupling = 0, spin_across = 0, spin_along = 0;
};
// What a particle's contacts with a tilted wall add to its own rows: any symmetric block, its lower triangle row by row (the first
// D (D + 1)/2 entries). Only particles that have such contacts have one.
struct OwnBlock {
  std::int64_t particle = 0;
  double entry[21] = {};
};
// Which pairs there are and who owns them; made once a neighbour list.
class PairTopology {
 public:
  PairTopology() = default;
  // pair_i, pair_j: particles of each pair, sorted by i.
  PairTopology(std::size_t particles, const std::vector<std::int32_t>& pair_i, const std::vector<std::int32_t>& pair_j);
  std::size_t particles() const { return particles_; }
  const Chunks& chunks() const { return chunks_; }
  std::size_t pairs() const { return target_.size(); }
  std::int32_t target(std::size_t pair) const { return target_[pair]; }
  std::size_t pair_begin(int chunk) const { return pair_begin_[chunk]; }  // pairs owned by a chunk
  // Where the halo begins in arrays that hold it behind the particles: at a full four.
  std::size_t first_slot() const { return (particles_ + lanes - 1) / lanes * lanes; }
  std::size_t halo_count() const { return halo_begin_.empty() ? 0 : halo_begin_.back(); }
  std::size_t halo_begin(int chunk) const { return halo_begin_[chunk]; }
  std::int32_t owner(std::size_t slot) const { return owner_[slot]; }  // the particle of a halo slot
  // Halo slots that belong to a particle, in fixed order.
  const std::int32_t* slots_begin(std::size_t k) const { return slots_.data() + slot_begin_[k]; }
  const std::int32_t* slots_end(std::size_t k) const { return slots_.data() + slot_begin_[k + 1]; }

 private:
  std::size_t particles_ = 0;
  Chunks chunks_;
  std::vector<std::int32_t> target_, owner_, slots_, slot_begin_;
  std::vector<std::size_t> pair_begin_, halo_begin_;
};

struct PairSystem {
  bool rotation = true;
  const PairTopology* topology = nullptr;
  std::vector<ParticleTerm> particle;
  // One array a chunk, so that chunks fill and read theirs independently; rising by i, then j.
  std::vector<FullPairs> full;
  std::vector<SqueezePairs> squeeze;
  std::vector<std::vector<OwnBlock>> own;  // one array a chunk, its particles rising; empty: none anywhere
  MeanFlow mean_flow;                   // empty: none
  std::vector<double> right_hand_side;  // D a particle
  // Particles whose velocity along z is given (held by the free surface), not solved for: 1 a particle, empty: none; and the
  // velocities. The force that holds one is what its row leaves: b - A x.
  std::vector<char> held;
  std::vector<double> held_velocity;

  int unknowns_per_particle() const { return rotation ? 6 : 3; }
};

// y = A x; vectors of D entries a particle.
void apply(const PairSystem&, const std::vector<double>& x, std::vector<double>& y);
// Diagonal block of every particle, its lower triangle row by row, D (D + 1)/2 entries a particle; without the mean flow's.
Scratch diagonal_blocks(const PairSystem&);
// The same in two steps, chunk by chunk, for D unknowns: what a chunk's terms add to its own particles (from block on, set, then summed)
// and to those of others (its slots of the halo); and, after all chunks, those slots added to their particles.
template <int D>
void own_diagonal_blocks(const PairSystem&, int chunk, double* block, double* halo);
template <int D>
void gather_diagonal_blocks(const PairTopology&, int chunk, const double* halo, double* block);

}  // namespace pigment::solve
