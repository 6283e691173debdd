#pragma once
// Preconditioned conjugate gradients on a PairSystem; preconditioned by block Jacobi, or by the factor of a stiff network made of
// the same system or a similar one. Same bytes at any number of threads.
#include <limits>
#include <string>
#include <vector>

#include "solve/stiff_network.h"
#include "solve/pair_system.h"

namespace pigment::solve {

struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double residual = -1;  // sqrt(r M^-1 r / scale); the error's energy e A e is looked at as well
  double scale = 0;      // b M^-1 b, b with what held particles contribute; or the largest scale asked for, if that is smaller
  std::string message;
};

struct ConjugateGradientOptions {
  double tolerance = 1e-6;   // on the residual above
  int max_iterations = 2000;
  // Newton's method adds large forces that nearly cancel: their size must not loosen the solve.
  double largest_scale = std::numeric_limits<double>::infinity();
};

// x: in, the starting guess (empty: zero); out, the solution. An unconverged or non-finite solve is a report, not an error.
// network: ready, preconditions in place of block Jacobi.
SolveReport conjugate_gradients(const PairSystem&, std::vector<double>& x, const ConjugateGradientOptions&,
                                StiffNetwork* network = nullptr);

}  // namespace pigment::solve
