#pragma once
// Conjugate gradients, preconditioned by block Jacobi while that is quick and by the factor of the stiff network where it is not.
//
// A solve that block Jacobi does not finish in `patience` iterations goes on with a network made of its own matrix. That network serves
// the solves that follow within the step, whose matrices differ by what Newton's method learnt, and is made anew where it no longer fits.
// Nothing but whether there was one is carried from step to step.
#include <vector>

#include "solve/conjugate_gradients.h"
#include "solve/stiff_network.h"

namespace pigment::solve {

class AdaptiveSolver {
 public:
  // stiff: whether the last step ended with a network; this one begins with its own then.
  void begin_step(bool stiff) {
    network_.forget();
    stiff_ = stiff;
    refused_ = false;
  }
  SolveReport solve(const PairSystem&, std::vector<double>& x, const ConjugateGradientOptions&);
  bool has_network() const { return network_.ready(); }

 private:
  void make(const PairSystem&);

  StiffNetwork network_;
  bool stiff_ = false;
  bool refused_ = false;  // no factor was to be had (memory): block Jacobi does what is left of the step
};

}  // namespace pigment::solve
