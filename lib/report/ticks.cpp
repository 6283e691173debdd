#include "report/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pigment::report {
namespace {

std::string with_true_minus(std::string text) {
  if (!text.empty() && text[0] == '-') text.replace(0, 1, "−");
  return text;
}

std::string fixed_text(double value, int decimals) {
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) return "0";
  return with_true_minus(fmt::format("{:.{}f}", value, decimals));
}

}  // namespace

Ticks linear_ticks(double low, double high, int wanted) {
  Ticks ticks;
  if (!(high > low)) {
    ticks.values = {low};
    ticks.labels = {number_text(low)};
    return ticks;
  }
  const double rough = (high - low) / std::max(1, wanted);
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * decade;
  for (const double factor : {5.0, 2.5, 2.0, 1.0})
    if (factor * decade >= rough * 0.999999) step = factor * decade;
  // A quarter step needs one digit more than its decade.
  const bool quarter = std::abs(step / decade - 2.5) < 1e-9;
  const int decimals =
      std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)) + (quarter ? 1 : 0));
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  const bool exponents =
      std::max(std::abs(low), std::abs(high)) >= 1e6 || std::max(std::abs(low), std::abs(high)) < 1e-3;
  for (double i = first; i <= last; ++i) {
    const double value = i == 0 ? 0 : i * step;
    ticks.values.push_back(value);
    ticks.labels.push_back(exponents ? number_text(value, 4) : fixed_text(value, decimals));
  }
  return ticks;
}

Ticks logarithmic_ticks(double low, double high) {
  Ticks ticks;
  const int first = static_cast<int>(std::floor(std::log10(low) - 1e-9)),
            last = static_cast<int>(std::ceil(std::log10(high) + 1e-9));
  const double decades = std::log10(high / low);
  const std::vector<double> factors = decades < 1.2   ? std::vector<double>{1, 2, 3, 5}
                                      : decades < 2.2 ? std::vector<double>{1, 2, 5}
                                                      : std::vector<double>{1};
  const int every = std::max(1, static_cast<int>(std::ceil(decades / 7)));
  for (int e = first; e <= last; ++e)
    for (const double f : factors) {
      const double value = f * std::pow(10.0, e);
      if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9) || (e - first) % every != 0) continue;
      ticks.values.push_back(value);
      ticks.labels.push_back(number_text(value));
    }
  return ticks;
}

double round_below(double limit) {
  const double decade = std::pow(10.0, std::floor(std::log10(limit) + 1e-12));
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * decade <= limit * (1 + 1e-12)) return factor * decade;
  return decade;
}

std::string number_text(double value, int digits) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  std::string text = fmt::format("{:.{}g}", value, digits);
  // "%g" turns to exponents early for whole numbers: 4710 stays 4710.
  if (size >= 1 && size < 1e6 && text.find('e') != std::string::npos) text = fmt::format("{:.0f}", value);
  if (const auto e = text.find('e'); e != std::string::npos) {  // 1e-05 -> 1e-5
    std::string exponent = text.substr(e + 1);
    const bool negative = exponent[0] == '-';
    exponent.erase(0, exponent.find_first_not_of("+-0"));
    text = text.substr(0, e) + "e" + (negative ? "−" : "") + exponent;
  }
  return with_true_minus(text);
}

std::string time_text(double ms) {
  const double size = std::abs(ms);
  if (ms == 0) return "0 s";
  if (size < 1e-3) return number_text(ms * 1e6) + " ns";
  if (size < 1) return number_text(ms * 1e3) + " µs";
  if (size < 100) return number_text(ms) + " ms";
  if (size < 120e3) return number_text(ms / 1e3) + " s";
  return number_text(ms / 60e3) + " min";
}

std::vector<std::size_t> evenly_in_time(const std::vector<double>& time, std::size_t wanted) {
  std::vector<std::size_t> chosen;
  if (time.empty() || wanted == 0) return chosen;
  const double first = time.front(), last = time.back();
  for (std::size_t k = 0; k < wanted; ++k) {
    const double at = wanted == 1
                          ? last
                          : first + (last - first) * static_cast<double>(k) / static_cast<double>(wanted - 1);
    const auto nearest = std::min_element(
        time.begin(), time.end(), [&](double a, double b) { return std::abs(a - at) < std::abs(b - at); });
    const auto index = static_cast<std::size_t>(nearest - time.begin());
    if (chosen.empty() || index > chosen.back()) chosen.push_back(index);
  }
  return chosen;
}

}  // namespace pigment::report
