#pragma once
// The liquid: temperature, viscosity, relative permittivity, density. Viscosity and permittivity follow the temperature
// by the IAPWS correlations for water unless the scene gives them.
#include <optional>

#include "config/node.h"

namespace pigment {

// Viscosity of water at 0.1 MPa, pN ms/um^2 (= mPa s); T in K, 253.15..383.15 K.
// IAPWS SR6-08(2011); Patek et al., J. Phys. Chem. Ref. Data 38 (2009) 21.
double water_viscosity(double temperature);
// Relative permittivity of water at 0.1 MPa, same source and range.
double water_relative_permittivity(double temperature);

struct LiquidParameters {
  double temperature = 298.15;                  // K
  std::optional<double> viscosity;              // pN ms/um^2; given: holds at every temperature
  std::optional<double> relative_permittivity;  // given: holds at every temperature
  double density = 1e-3;                        // engine units, 1000 kg/m3
};
LiquidParameters read_liquid(config::Node);

// The liquid at one temperature.
struct Liquid {
  double temperature, viscosity, relative_permittivity, density;
  double thermal_energy() const;  // kT, pN um
  double permittivity() const;    // eps_r eps_0, pN/mV^2
};
Liquid liquid_at(const LiquidParameters&, double temperature);

}  // namespace pigment
