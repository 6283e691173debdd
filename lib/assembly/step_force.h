#pragma once
// Force along one gap over one step, as a function of the gap at its end: the colloidal laws there and the squeeze resistance
// averaged along the step, c ln(h0/h)/dt for its singular part (resistance::squeeze_step) and linear for the rest.
#include <cmath>
#include <memory>
#include <vector>

#include "forces/pair_law.h"

namespace pigment::assembly {

struct StepForce {
  const std::vector<std::unique_ptr<forces::PreparedPairLaw>>& laws;
  forces::PairGeometry geometry;  // its gap is the guess
  double gap_begin = 0;           // um
  double squeeze_from = 0;        // um, > 0: the same, but in a two-step method
  double singular = 0;            // c/dt times the viscosity, pN
  double linear = 0;              // the rest of the resistance over dt, pN/um, that of 1/h0 left out
  double turn = 0;                // um, the part of the change of the gap that the axis's turning makes: it meets no linear resistance
  double standing = 0;            // pN, in place of the concave laws
  bool split = false;             // whether these are left out
  double least_stiffness = 0;     // pN/um, of the linear law where the laws themselves are softer
  double share = 1;               // by which the laws' forces are multiplied: those of a curved wall over the plane's

  double operator()(double gap) const { return colloidal(gap).force + singular * std::log(squeeze_from / gap) - linear * (gap - gap_begin - turn); }
  // As the system was linearised about the guess.
  double tangent(double gap) const {
    const double guess = geometry.gap;
    const forces::PairTerm t = colloidal(guess);
    return t.force + std::max(t.stiffness, least_stiffness) * (guess - gap) + singular * (std::log(squeeze_from / guess) + (guess - gap) / guess) -
           linear * (gap - gap_begin - turn);
  }
  // Mean stiffness of the laws between two gaps, pN/um.
  double mean_stiffness(double low, double high) const { return (colloidal(low).force - colloidal(high).force) / (high - low); }

 private:
  forces::PairTerm colloidal(double gap) const {
    forces::PairGeometry g = geometry;
    g.gap = gap;
    forces::PairTerm sum;
    sum.force = standing;
    for (const auto& law : laws) {
      if (split && law->concave()) continue;
      const forces::PairTerm t = law->switched(g);
      sum.force += share * t.force;
      sum.stiffness += share * t.stiffness;
    }
    return sum;
  }
};

}  // namespace pigment::assembly
