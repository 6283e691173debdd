#pragma once
// Preconditioned conjugate gradients on a PairSystem; block Jacobi preconditioner, or a factor of a similar matrix. Same bytes
// at any number of threads.
#include <limits>
#include <string>
#include <vector>

#include "solve/cholmod_factor.h"
#include "solve/pair_system.h"

namespace pigment::solve {

struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double residual = -1;  // sqrt(r M^-1 r / scale); block Jacobi also looks at the error's energy e A e
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
// factor: ready, preconditions in place of block Jacobi.
SolveReport conjugate_gradients(const PairSystem&, std::vector<double>& x, const ConjugateGradientOptions&,
                                CholmodFactor* factor = nullptr);

}  // namespace pigment::solve
