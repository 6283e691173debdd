#pragma once
// Sparse Cholesky factor of a PairSystem by CHOLMOD: for layers so stiff that block Jacobi takes hundreds of iterations. A
// factor made some steps ago still serves as a preconditioner.
#include <memory>
#include <string>
#include <vector>

#include "solve/pair_system.h"

namespace pigment::solve {

class CholmodFactor {
 public:
  CholmodFactor();
  ~CholmodFactor();
  CholmodFactor(CholmodFactor&&) noexcept;
  CholmodFactor& operator=(CholmodFactor&&) noexcept;
  // Empty on success, else why not (not positive definite, out of memory).
  std::string factorize(const PairSystem&);
  bool ready() const;
  // x = A^-1 b for the factorised A.
  void solve(const std::vector<double>& b, std::vector<double>& x);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pigment::solve
