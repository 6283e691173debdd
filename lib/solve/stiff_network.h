#pragma once
// A preconditioner for layers that bonds or near contacts make stiff. Of the matrix it keeps every particle's own block and, between
// particles, the squeeze of the stiff pairs alone: those whose squeeze (resistance and stiffness) is many times the drag of the
// lesser particle. Those make chains and clusters that block Jacobi moves particle by particle; the rest, shear and far pairs, is
// of the order of the drag. Without rotation between particles, each one's angular velocity is eliminated by itself, and
// what is left, three unknowns a particle and few pairs, has a sparse Cholesky factor (solve/block_cholesky.h).
//   M = [A_uu' A_uw; A_wu A_ww], A_uw and A_ww block-diagonal, A_uu' = diagonal blocks - sum over stiff pairs of squeeze n n^T
//   S = A_uu' - A_uw A_ww^-1 A_wu = L L^T
// M is positive definite: the diagonal blocks hold each stiff pair's share, and without those they are the particles' drag and more.
#include <memory>
#include <string>
#include <vector>

#include "solve/pair_system.h"

namespace pigment::solve {

class StiffNetwork {
 public:
  StiffNetwork();
  ~StiffNetwork();
  StiffNetwork(StiffNetwork&&) noexcept;
  StiffNetwork& operator=(StiffNetwork&&) noexcept;
  // A pair is stiff where its squeeze is so many times the lesser drag. Empty on success, else why not (not positive definite, out of memory).
  std::string factorize(const PairSystem&, double stiff_over_drag);
  bool ready() const;
  // Of factorize, in multiply-adds, about; of a network that is ready.
  double work() const;
  // How many pairs, stiff then or now, have a squeeze more than so many `times` larger or smaller than the factor has it, and how many
  // particles the surface holds or lets go since. The system has the factor's topology.
  int changed(const PairSystem&, double times) const;
  void forget();

  // z = M^-1 r over strided vectors (solve/pair_product.h), in three parts: the first and last over ranges of particles, the second
  // by all threads of a parallel region together; rows of held velocities stay zero. The last returns its part of r . z. For two
  // vectors in hardly more than the time of one: the first and last for each `side`, 0 and 1, the second for both.
  void eliminate(int begin, int end, const double* r, int side = 0);
  void solve(int sides = 1);
  double substitute(int begin, int end, const std::vector<char>& held, const double* r, double* z, int side = 0) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pigment::solve
