#include "model/brownian_constant.h"

#include <cmath>
#include <numbers>

namespace pigment {

double brownian_constant(double viscosity, double thermal_energy, double dt) {
  return std::sqrt(36 * std::numbers::pi * viscosity * thermal_energy / dt);
}

double BrownianCalibration::value_at(double t, double dt) const {
  const auto scaled = [this](std::size_t k) { return value[k] * std::sqrt(time_step[k]); };
  std::size_t k = 0;
  while (k + 1 < temperature.size() && temperature[k + 1] < t) ++k;
  double s = scaled(k);
  if (k + 1 < temperature.size() && t > temperature[k]) {
    const double w = (t - temperature[k]) / (temperature[k + 1] - temperature[k]);
    s += w * (scaled(k + 1) - s);
  } else if (t > temperature[k] && k + 1 == temperature.size()) {
    s = scaled(k);
  }
  return s / std::sqrt(dt);
}

}  // namespace pigment
