#pragma once
// Block-Jacobi conjugate gradients while they are quick, a Cholesky factor kept over several steps where they are not.
//
// A solve that block Jacobi does not finish in as many iterations as there are particles (500 at least) is finished with a factor of its
// own matrix, which then preconditions the solves that follow, until one of them takes more than `refactor` iterations and a new factor is made, or
// the neighbour list changes and block Jacobi gets another chance. The matrix that the kept factor was made of is part of the
// state of a run, so that a resumed run goes on with the same factor.
#include <cstdint>
#include <vector>

#include "solve/cholmod_factor.h"
#include "solve/conjugate_gradients.h"

namespace pigment::solve {

class AdaptiveSolver {
 public:
  SolveReport solve(const PairSystem&, std::vector<double>& x, const ConjugateGradientOptions&);
  void forget_factor();  // the neighbour list changed: the factor's unknowns have another order

  // The factor's matrix, bit for bit; empty without a factor.
  const std::vector<std::int64_t>& packed_factor() const { return packed_; }
  long revision() const { return revision_; }  // changes with the factor
  // Makes the factor anew from such a matrix.
  void restore_factor(const std::vector<std::int64_t>&, const PairTopology&);

 private:
  CholmodFactor factor_;
  std::vector<std::int64_t> packed_;
  long revision_ = 0;
};

}  // namespace pigment::solve
