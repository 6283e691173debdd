#pragma once
// K_Brown of (25) in [sand2010]: F = K a0 sqrt(a) on each particle and step, a0 a random unit vector.
#include <vector>

namespace pigment {

// The value that makes a lone sphere's displacement obey (23), (24): each component of F has variance K^2 a/3, and a step dt
// moves the sphere by F dt/(6 pi mu a); setting the variance to 2 kT dt/(6 pi mu a) gives K = sqrt(36 pi mu kT/dt), free of a.
// viscosity in pN ms/um^2, thermal_energy in pN um, dt in ms; result in pN um^-1/2.
double brownian_constant(double viscosity, double thermal_energy, double dt);

// A calibration: values at rising temperatures, each belonging to a step; what kbrown.h5 holds.
struct BrownianCalibration {
  std::vector<double> temperature;         // K
  std::vector<double> time_step;           // ms
  std::vector<double> value;               // pN um^-1/2
  std::vector<double> standard_deviation;  // over the simulations
  std::vector<double> closed_form;

  // At a temperature and step: linear in temperature between points of value sqrt(time_step) (constant outside), over sqrt(dt).
  double value_at(double temperature, double dt) const;
};

}  // namespace pigment
