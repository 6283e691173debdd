#pragma once
// Room for numbers that are all written before they are read. A vector's zeros are written by one thread, solve for solve.
#include <cstddef>
#include <memory>

namespace pigment {

class Scratch {
 public:
  explicit Scratch(std::size_t size) : number_(std::make_unique_for_overwrite<double[]>(size)) {}
  double* data() { return number_.get(); }
  const double* data() const { return number_.get(); }
  double& operator[](std::size_t k) { return number_[k]; }
  double operator[](std::size_t k) const { return number_[k]; }

 private:
  std::unique_ptr<double[]> number_;
};

}  // namespace pigment
