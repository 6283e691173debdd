#pragma once
// Conjugate gradients, preconditioned by block Jacobi while that is quick and by the factor of the stiff network where it is not.
//
// A solve that block Jacobi does not finish in `patience` iterations goes on with a network made of its own matrix. That network serves
// the solves that follow within the step, whose matrices differ by what Newton's method learnt, while it fits. Whether it is made anew then,
// or block Jacobi tried again, is a matter of what they cost: in a layer that bonds make stiff few pairs are, and networks cheap; in a jam of
// charged particles most are, and one pass of Newton's method may go astray. Where block Jacobi fails at most solves there is no choice.
// Nothing but that decision is carried from step to step.
#include <vector>

#include "solve/conjugate_gradients.h"
#include "solve/stiff_network.h"

namespace pigment::solve {

class AdaptiveSolver {
 public:
  // stiff: what is_stiff() said at the last step's end; this one uses networks alone then.
  void begin_step(bool stiff) {
    network_.forget();
    stiff_ = stiff;
    refused_ = false;
    jacobi_iterations_ = jacobi_solves_ = jacobi_failures_ = 0;
  }
  SolveReport solve(const PairSystem&, std::vector<double>& x, const ConjugateGradientOptions&);
  bool has_network() const { return network_.ready(); }
  bool is_stiff() const { return stiff_ && network_.ready(); }

 private:
  void make(const PairSystem&);

  StiffNetwork network_;
  bool stiff_ = false;
  int jacobi_iterations_ = 0, jacobi_solves_ = 0, jacobi_failures_ = 0;  // of this step, finished or not
  bool refused_ = false;  // no factor was to be had (memory): block Jacobi does what is left of the step
};

}  // namespace pigment::solve
