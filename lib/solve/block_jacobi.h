#pragma once
// The block-Jacobi preconditioner of a PairSystem: the Cholesky factor of every particle's own D x D block, four particles side by
// side.
#include "base/scratch.h"
#include "solve/pair_product.h"

namespace pigment::solve {

template <int D>
class BlockJacobi {
 public:
  static constexpr int entries = D * (D + 1) / 2;
  // Rows of held velocities are those of the identity.
  explicit BlockJacobi(const PairSystem&);
  // z = M^-1 r for the particles from begin (a multiple of four) to end, strided; returns their part of r . z. r is zero for
  // what stands beyond the last particle.
  double solve(int begin, int end, const double* r, double* z) const;
  // x += alpha p, r -= alpha ap, then z and r . z as above, in one pass.
  double update(int begin, int end, double alpha, const double* p, const double* ap, double* x, double* r, double* z) const;

 private:
  // The blocks of four particles, one after the other, become their factors, side by side.
  static void factorize_four(const PairSystem&, std::size_t first, std::size_t particles, double* block);

  Scratch factor_;  // lower triangle row by row, with reciprocal diagonal, of four particles side by side
};

}  // namespace pigment::solve
