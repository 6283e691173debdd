#include "model/liquid.h"

#include <cmath>

namespace pigment {
namespace {

// Validity of the correlations below, K.
constexpr double lowest_temperature = 253.15, highest_temperature = 383.15;
constexpr double reference_temperature = 300;  // K

}  // namespace

// [patek2009], IAPWS SR6-08(2011): 1.0016, 0.8900, 0.5465 mPa s at 20, 25, 50 degC.
double water_viscosity(double temperature) {
  const double t = temperature / reference_temperature;
  const double micropascal_seconds = 280.68 * std::pow(t, -1.9) + 511.45 * std::pow(t, -7.7) +
                                     61.131 * std::pow(t, -19.6) + 0.45903 * std::pow(t, -40.0);
  return 1e-3 * micropascal_seconds;
}

// [patek2009], IAPWS SR6-08(2011): 80.19, 78.38, 69.93 at 20, 25, 50 degC.
double water_relative_permittivity(double temperature) {
  const double t = temperature / reference_temperature;
  return -43.7527 * std::pow(t, -0.05) + 299.504 * std::pow(t, -1.47) - 399.364 * std::pow(t, -2.11) +
         221.327 * std::pow(t, -2.31);
}

LiquidParameters read_liquid(config::Node block) {
  LiquidParameters p;
  p.temperature = block.quantity("temperature", Dimension::Temperature, "25 degC",
                                 config::between(lowest_temperature, highest_temperature));
  p.viscosity = block.optional_quantity("viscosity", Dimension::Viscosity, config::positive());
  p.relative_permittivity =
      block.optional_quantity("relative_permittivity", Dimension::Number, config::between(1, 1000));
  p.density = block.quantity("density", Dimension::Density, "1000 kg/m3", config::positive());
  return p;
}

double Liquid::thermal_energy() const { return constants::boltzmann * temperature; }

double Liquid::permittivity() const { return relative_permittivity * constants::vacuum_permittivity; }

Liquid liquid_at(const LiquidParameters& p, double temperature) {
  return {temperature, p.viscosity ? *p.viscosity : water_viscosity(temperature),
          p.relative_permittivity ? *p.relative_permittivity : water_relative_permittivity(temperature), p.density};
}

}  // namespace pigment
