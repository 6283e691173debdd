#include "resistance/hindered_drag.h"

#include <cmath>

#include "resistance/pair_lubrication.h"

namespace pigment::resistance {

double bed_drag_factor(double phi) {
  const double liquid = 1 - phi;
  return 10 * phi / (liquid * liquid) + liquid * liquid * (1 + 1.5 * std::sqrt(phi));
}

double hindered_drag_factor(double phi, double ratio) {
  const double weight = 1 - taper(phi, 0, 0.1);
  return (1 - phi) * bed_drag_factor(phi) * (1 + weight * (ratio - 1));
}

}  // namespace pigment::resistance
