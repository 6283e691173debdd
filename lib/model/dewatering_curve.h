#pragma once
// Liquid lost from the layer against time: what dewatering.h5 holds and the stepper follows.
#include <vector>

namespace pigment {

// Linear between points; constant flux (and temperature) after the last one.
struct DewateringCurve {
  std::vector<double> time;              // ms, rising from 0
  std::vector<double> absorption_flux;   // um/ms, q, into the substrate
  std::vector<double> evaporation_flux;  // um/ms, e
  std::vector<double> temperature;       // K; empty: the scene's
  std::vector<double> absorbed;          // um, cumulative; empty: the integral of the linear flux
  std::vector<double> evaporated;        // um, cumulative; empty likewise

  // Cumulative curves at t, um. Darcy's flux is singular at t = 0, so differences of these are what acts on the layer:
  // where they are given they are interpolated linearly themselves.
  double absorbed_at(double t) const;
  double evaporated_at(double t) const;
  // Mean fluxes over [t0, t1], um/ms, from differences of the cumulative curves.
  double mean_absorption_flux(double t0, double t1) const;
  double mean_evaporation_flux(double t0, double t1) const;
  // Time from which on fluxes and temperature are those at the end, ms; 0 for an empty curve.
  double steady_from() const;
  double temperature_at(double t, double fallback) const;
};

}  // namespace pigment
