#pragma once
// The matrix-vector product of a PairSystem over strided vectors: particle k's D unknowns stand at k * stride(D), velocity first,
// angular velocity from the fifth on; what is between and behind stays zero.
#include <vector>

#include "solve/pair_system.h"

namespace pigment::solve {

template <int D>
inline constexpr int stride = D == 6 ? 8 : 4;
// Where unknown d of a particle stands.
template <int D>
constexpr int place(int d) { return d < 3 ? d : d + 1; }

// Entries of a strided vector that is multiplied (particles up to a full four), and of one that is written (and the halo).
template <int D>
std::size_t input_size(const PairTopology& t) { return t.first_slot() * stride<D>; }
template <int D>
std::size_t output_size(const PairTopology& t) { return input_size<D>(t) + t.halo_count() * stride<D>; }

// What one chunk adds: its own rows of y (set, then summed), its halo slots and its share of the slices' sums.
template <int D>
void apply_chunk(const PairSystem&, int chunk, const double* x, double* y, MeanFlowSums&);
// Finishes the rows of one chunk after apply_chunk of all, and after sums.combine() where there is a mean flow; held rows zero
// where `mask`. Returns the chunk's part of x . y.
template <int D>
double finish_chunk(const PairSystem&, int chunk, bool mask, const double* x, double* y, const MeanFlowSums&);

// Between vectors of D entries a particle and strided ones. What is between a particle's unknowns becomes zero.
template <int D>
void to_strided(const std::vector<double>& x, double* strided);
template <int D>
void from_strided(const double* strided, std::vector<double>& x);

}  // namespace pigment::solve
