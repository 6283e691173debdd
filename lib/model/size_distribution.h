#pragma once
// A size law ready for use: cumulative by weight and by number, quantiles, mean volume.
#include <vector>

#include "model/species.h"

namespace pigment {

// Between its cut-offs a law is held as weight on a fine logarithmic grid of diameters, spread evenly over ln
// d within each cell; tables are taken at their own points, which makes them straight lines over ln d. Number
// follows from weight by dN = dW / (density pi/6 d^3), cell by cell in closed form. The normal and log-normal
// laws have cut-offs; a table ends with its rows, or at cut-offs inside them.
class SizeDistribution {
 public:
  // Throws FileError for a table that cannot be used (with its line) and InputError for a law without weight
  // between its cut-offs.
  explicit SizeDistribution(const SizeLaw&);

  bool monodisperse() const { return diameter_.size() == 1; }
  double smallest() const { return diameter_.front(); }  // um, diameter
  double largest() const { return diameter_.back(); }
  // Fractions of weight and of number in particles of diameter up to d.
  double weight_below(double d) const;
  double number_below(double d) const;
  // The diameter below which the fraction u (0..1) of the number lies: the inverse of number_below.
  double diameter_at_number(double u) const;
  double mean_volume() const { return mean_volume_; }  // um^3, mean over the number

 private:
  void integrate(const std::vector<double>& weight_in_cell);

  std::vector<double> diameter_;  // grid points, rising; one: monodisperse
  std::vector<double> weight_;    // cumulative at the grid points, 0..1
  std::vector<double> number_;    // likewise
  double mean_volume_ = 0;
};

}  // namespace pigment
