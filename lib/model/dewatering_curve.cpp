#include "model/dewatering_curve.h"

#include <algorithm>
#include <cassert>

namespace pigment {
namespace {

// The piece of the time axis that holds t: [time[i], time[i+1]]; past the end, the last point.
std::size_t piece_of(const std::vector<double>& time, double t) {
  const auto above = std::upper_bound(time.begin(), time.end(), t);
  return above == time.begin() ? 0 : static_cast<std::size_t>(above - time.begin()) - 1;
}

// What is lost over [t0, t1]. Summed piece by piece: a difference of two cumulative values would lose digits late in a
// long run.
double lost_between(const std::vector<double>& time, const std::vector<double>& flux,
                    const std::vector<double>& cumulative, double t0, double t1) {
  if (time.empty()) return 0;
  t0 = std::max(t0, time.front());
  double sum = 0;
  for (std::size_t i = piece_of(time, t0); t0 < t1; ++i) {
    if (i + 1 >= time.size()) return sum + (t1 - t0) * flux.back();
    const double end = std::min(t1, time[i + 1]), length = time[i + 1] - time[i];
    if (!cumulative.empty()) {
      sum += (end - t0) * (cumulative[i + 1] - cumulative[i]) / length;
    } else {
      const double middle = (0.5 * (t0 + end) - time[i]) / length;  // the mean of a linear flux is its middle value
      sum += (end - t0) * ((1 - middle) * flux[i] + middle * flux[i + 1]);
    }
    t0 = end;
  }
  return sum;
}

double value_at(const std::vector<double>& time, const std::vector<double>& values, double t) {
  if (t <= time.front()) return values.front();
  const std::size_t i = piece_of(time, t);
  if (i + 1 >= time.size()) return values.back();
  const double part = (t - time[i]) / (time[i + 1] - time[i]);
  return (1 - part) * values[i] + part * values[i + 1];
}

double mean_flux(const std::vector<double>& time, const std::vector<double>& flux,
                 const std::vector<double>& cumulative, double t0, double t1) {
  assert(t0 <= t1);
  if (time.empty()) return 0;
  if (t0 < t1) return lost_between(time, flux, cumulative, t0, t1) / (t1 - t0);
  const std::size_t i = piece_of(time, t0);
  if (cumulative.empty() || i + 1 >= time.size()) return value_at(time, flux, t0);
  return (cumulative[i + 1] - cumulative[i]) / (time[i + 1] - time[i]);
}

}  // namespace

double DewateringCurve::absorbed_at(double t) const {
  return (absorbed.empty() ? 0 : absorbed.front()) + lost_between(time, absorption_flux, absorbed, 0, t);
}

double DewateringCurve::evaporated_at(double t) const {
  return (evaporated.empty() ? 0 : evaporated.front()) + lost_between(time, evaporation_flux, evaporated, 0, t);
}

double DewateringCurve::mean_absorption_flux(double t0, double t1) const {
  return mean_flux(time, absorption_flux, absorbed, t0, t1);
}

double DewateringCurve::mean_evaporation_flux(double t0, double t1) const {
  return mean_flux(time, evaporation_flux, evaporated, t0, t1);
}

double DewateringCurve::steady_from() const {
  if (time.empty()) return 0;
  std::size_t k = time.size() - 1;
  const auto like_last = [&](const std::vector<double>& v, std::size_t i) { return v.empty() || v[i] == v.back(); };
  while (k > 0 && like_last(absorption_flux, k - 1) && like_last(evaporation_flux, k - 1) && like_last(temperature, k - 1)) --k;
  return time[k];
}

double DewateringCurve::temperature_at(double t, double fallback) const {
  return temperature.empty() ? fallback : value_at(time, temperature, t);
}

}  // namespace pigment
