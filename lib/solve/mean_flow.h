#pragma once
// The liquid's mean vertical flow through horizontal slices, as a term of the system: what the spheres of a slice displace flows
// back through it, and each sphere's drag is relative to that.
//
// With b_ks the drag coefficient of sphere k in slice s and c_ks what its motion adds to the liquid's opposite flow, the slip of
// k in s is U_k + sum_j c_js U_j, and the dissipation (times two) is sum b_ks (U_k + sum_j c_js U_j)^2. Its derivative is
//   y_k = sum_s b_ks (x_k + S_s) + c_ks (T_s + B_s S_s),   S_s = sum_j c_js x_j,  T_s = sum_j b_js x_j,  B_s = sum_j b_js,
// symmetric and positive semi-definite, of rank two a slice besides its diagonal sum_s b_ks. That diagonal stands in the
// particle's own term (ParticleTerm::along); what is here is the rest.
#include <cstdint>
#include <vector>

namespace pigment::solve {

struct MeanFlow {
  struct Share {
    std::int32_t slice;
    double drag, displaced;  // b, c
  };
  std::vector<std::size_t> begin;  // particle k has share[begin[k]] .. share[begin[k + 1] - 1]; empty: no such term
  std::vector<Share> share;
  std::vector<double> slice_drag;  // B

  bool empty() const { return begin.empty(); }
  std::size_t slices() const { return slice_drag.size(); }
};

// The sums over all particles, S and T of every slice: chunk by chunk, then combined in order.
struct MeanFlowSums {
  std::vector<double> partial, total;
  MeanFlowSums() = default;
  MeanFlowSums(const MeanFlow& flow, int chunks) : partial(2 * flow.slices() * static_cast<std::size_t>(chunks)), total(2 * flow.slices()) {}

  void combine() {
    for (std::size_t q = 0; q < total.size(); ++q) {
      double sum = 0;
      for (std::size_t at = q; at < partial.size(); at += total.size()) sum += partial[at];
      total[q] = sum;
    }
  }
};

// Vectors of S entries a particle; the vertical velocity is the third.
template <int S>
inline void sum_mean_flow(const MeanFlow& flow, int chunk, int begin, int end, const double* x, MeanFlowSums& sums) {
  double* own = sums.partial.data() + sums.total.size() * static_cast<std::size_t>(chunk);
  for (std::size_t q = 0; q < sums.total.size(); ++q) own[q] = 0;
  for (int k = begin; k < end; ++k)
    for (std::size_t at = flow.begin[k]; at < flow.begin[k + 1]; ++at) {
      const MeanFlow::Share& share = flow.share[at];
      own[2 * share.slice] += share.displaced * x[k * S + 2];
      own[2 * share.slice + 1] += share.drag * x[k * S + 2];
    }
}
template <int S>
inline void add_mean_flow(const MeanFlow& flow, int begin, int end, const MeanFlowSums& sums, double* y) {
  for (int k = begin; k < end; ++k)
    for (std::size_t at = flow.begin[k]; at < flow.begin[k + 1]; ++at) {
      const MeanFlow::Share& share = flow.share[at];
      const double back = sums.total[2 * share.slice];
      y[k * S + 2] += share.drag * back + share.displaced * (sums.total[2 * share.slice + 1] + flow.slice_drag[share.slice] * back);
    }
}

}  // namespace pigment::solve
