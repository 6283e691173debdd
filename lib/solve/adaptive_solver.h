#pragma once
// Conjugate gradients, preconditioned by block Jacobi while that is quick and by the factor of the stiff network where it is not.
//
// A solve that block Jacobi does not finish in `patience` iterations goes on with a network made of its own matrix. That network serves
// the solves that follow within the step, whose matrices differ by what Newton's method learnt, while it fits. Whether it is made anew then,
// or block Jacobi tried again, is a matter of what they cost: in a layer that bonds make stiff few pairs are, and networks cheap; in a jam of
// charged particles most are, and one pass of Newton's method may go astray. Where block Jacobi fails at most solves there is no choice.
// Block Jacobi is let go on for as long as a network would have taken, so that a solve never costs much more than twice what the better of
// the two had. Nothing but that decision and what the last network cost is carried from step to step (SolverMemory).
#include <vector>

#include "solve/conjugate_gradients.h"
#include "solve/stiff_network.h"

namespace pigment::solve {

struct SolverMemory {
  bool stiff = false;    // the step uses networks alone
  int network_cost = 0;  // of a solve with a new network, in iterations of block Jacobi; 0: none was made yet
  bool operator==(const SolverMemory&) const = default;
};

class AdaptiveSolver {
 public:
  // memory: that of the last step's end.
  void begin_step(SolverMemory memory) {
    network_.forget();
    stiff_ = memory.stiff;
    network_cost_ = memory.network_cost;
    refused_ = false;
    jacobi_iterations_ = jacobi_solves_ = jacobi_failures_ = 0;
  }
  SolveReport solve(const PairSystem&, std::vector<double>& x, const ConjugateGradientOptions&);
  bool has_network() const { return network_.ready(); }
  SolverMemory memory() const { return {stiff_ && network_.ready(), network_cost_}; }

 private:
  void make(const PairSystem&, double tolerance);

  StiffNetwork network_;
  bool stiff_ = false;
  int network_cost_ = 0;
  int jacobi_iterations_ = 0, jacobi_solves_ = 0, jacobi_failures_ = 0;  // of this step, finished or not
  bool refused_ = false;  // no factor was to be had (memory): block Jacobi does what is left of the step
};

}  // namespace pigment::solve
