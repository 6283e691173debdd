#include "dewatering/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "dewatering/table.h"

namespace pigment::dewatering {
namespace {

// Points over the duration for the square root of time. With t_k = T (k/n)^4 a chord of sqrt(t / T) errs by the same
// amount everywhere, 0.5 / n^2 at most (0.25 / n^2 in the first interval): 5e-7 here.
constexpr int square_root_points = 1000;
// Between a section's last point and the next one's first, in units of the duration.
constexpr double jump = 1e-9;

// Evaporation flux in three sections of equal length.
struct Sections {
  std::array<double, 3> flux{};  // um/ms
  double duration;

  int section(double t) const { return std::min(2, static_cast<int>(3 * t / duration)); }
  double end(int section) const { return section == 2 ? duration : duration * (section + 1) / 3; }
  double evaporated(double t) const {
    double sum = 0, begin = 0;
    for (int s = 0; s < 3 && begin < t; begin = end(s++)) sum += flux[s] * (std::min(t, end(s)) - begin);
    return sum;
  }
};

Sections sections_of(const DewateringParameters& p, double duration, double liquid_density) {
  if (!p.evaporates()) return {{}, duration};
  const double high = p.evaporation->high / liquid_density, low = p.evaporation->low / liquid_density;
  switch (p.strategy) {
    case Strategy::HighLowLow: return {{high, low, low}, duration};
    case Strategy::LowLowHigh: return {{low, low, high}, duration};
    default: return {{high, high, high}, duration};
  }
}

struct Point {
  double time;
  int section;
};

// Each section from its begin to its end, with the points of the square root law between them.
std::vector<Point> points_of(const Sections& sections, bool absorbs) {
  std::vector<Point> points;
  int k = 1;
  for (int s = 0; s < 3; ++s) {
    const double end = sections.end(s), margin = jump * sections.duration;
    const double begin = s == 0 ? 0 : sections.end(s - 1) + margin;
    points.push_back({begin, s});
    for (; absorbs && k < square_root_points; ++k) {
      const double t = sections.duration * std::pow(double(k) / square_root_points, 4);
      if (t >= end - margin) break;
      if (t > begin + (s == 0 ? 0 : margin)) points.push_back({t, s});
    }
    points.push_back({end, s});
  }
  return points;
}

DewateringCurve curve_of(double rate, const Sections& sections) {
  DewateringCurve curve;
  for (const Point& point : points_of(sections, rate > 0)) {
    curve.time.push_back(point.time);
    curve.absorbed.push_back(std::sqrt(rate * point.time));
    curve.absorption_flux.push_back(point.time > 0 ? 0.5 * std::sqrt(rate / point.time) : 0);
    curve.evaporated.push_back(sections.evaporated(point.time));
    curve.evaporation_flux.push_back(sections.flux[point.section]);
  }
  curve.absorption_flux[0] = curve.absorbed[1] / curve.time[1];
  return curve;
}

void multiply(DewateringCurve& curve, double factor) {
  for (auto* values : {&curve.absorption_flux, &curve.evaporation_flux, &curve.absorbed, &curve.evaporated})
    for (double& value : *values) value *= factor;
}

}  // namespace

double darcy_rate(const AbsorptionParameters& p, double volume_fraction, double viscosity) {
  return 2 * p.permeability * (p.capillary_pressure + p.external_pressure) / viscosity *
         (p.cake_solids - volume_fraction) / volume_fraction;
}

double liquid_to_remove(double thickness, double volume_fraction, double final_volume_fraction) {
  return thickness * (1 - volume_fraction / final_volume_fraction);
}

Profile make_profile(const DewateringParameters& p, const Coating& coating) {
  Profile profile;
  if (p.strategy == Strategy::Table) {
    profile.curve = read_table(p.file, coating.liquid.density);
    profile.duration = p.duration.value_or(profile.curve.time.back());
  } else {
    profile.duration = p.duration.value();
    const double rate =
        p.absorbs() ? darcy_rate(*p.absorption, coating.volume_fraction, coating.liquid.viscosity) : 0;
    assert(rate >= 0);
    profile.curve = curve_of(rate, sections_of(p, profile.duration, coating.liquid.density));
  }
  const DewateringCurve& curve = profile.curve;
  profile.removed = curve.absorbed_at(profile.duration) + curve.evaporated_at(profile.duration);
  if (p.final_solids) {
    const double final = p.final_solids->volume_fraction(coating.dry_density, coating.liquid.density);
    const double wanted =
        liquid_to_remove(p.reference_thickness.value_or(coating.thickness), coating.volume_fraction, final);
    profile.scale = wanted / profile.removed;
    if (!(profile.removed > 0 && std::isfinite(profile.scale)))
      throw InputError(fmt::format("dewatering.final_solids: the fluxes remove no liquid within {:.4g} s; no factor could "
                                   "bring the layer to these solids",
                                   to_si(Dimension::Time, profile.duration)));
    multiply(profile.curve, profile.scale);
    profile.removed = wanted;
  }
  return profile;
}

}  // namespace pigment::dewatering
