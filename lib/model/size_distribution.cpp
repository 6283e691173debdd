#include "model/size_distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/error.h"
#include "config/csv_table.h"
#include "model/particles.h"

namespace pigment {
namespace {

constexpr int cells = 2000;

std::string micrometres(double d) {
  std::ostringstream text;
  text << d << " um";
  return text.str();
}

double normal_probability(double from, double to) {
  // From the nearer tail, which keeps the accuracy far out.
  const double a = from > 0 ? -to : from, b = from > 0 ? -from : to;
  return 0.5 * (std::erfc(-b / std::numbers::sqrt2) - std::erfc(-a / std::numbers::sqrt2));
}

// A density over x that is Gaussian in x = d or x = ln d, and the range of d that is kept.
struct Bell {
  bool logarithmic;
  double centre, width;
  double low, high;  // um

  double x(double d) const { return ((logarithmic ? std::log(d) : d) - centre) / width; }
};

Bell bell_of(const SizeLaw& law) {
  Bell bell{};
  bell.logarithmic = law.kind == SizeLaw::Kind::Lognormal;
  bell.centre = bell.logarithmic ? std::log(law.median) : law.mean;
  bell.width = bell.logarithmic ? std::log(law.geometric_standard_deviation) : law.standard_deviation;
  if (!(bell.width > 0))
    throw InputError("the size law's standard deviation is not above zero; use law: monodisperse");
  bell.low = law.min;
  bell.high = law.max;
  if (!(bell.low > 0 && bell.low < bell.high))
    throw InputError("the size law's cut-offs, " + micrometres(bell.low) + " and " + micrometres(bell.high) +
                     ", are not above zero and rising");
  // Where the cut-offs leave next to nothing of the law, one of the two is a slip of the pen.
  if (normal_probability(bell.x(bell.low), bell.x(bell.high)) < 1e-6)
    throw InputError("the size law has less than a millionth of its weight between " + micrometres(bell.low) +
                     " and " + micrometres(bell.high));
  // Beyond this the law holds nothing that could be sampled; the grid stays fine within.
  constexpr double farthest = 9;
  const double inner_low = bell.centre - farthest * bell.width,
               inner_high = bell.centre + farthest * bell.width;
  bell.low = std::max(bell.low, bell.logarithmic ? std::exp(inner_low) : inner_low);
  bell.high = std::min(bell.high, bell.logarithmic ? std::exp(inner_high) : inner_high);
  return bell;
}

struct Tabulated {
  std::vector<double> diameter, finer;
};

Tabulated read_table(const SizeLaw& law) {
  const config::CsvTable table =
      config::read_csv(law.file, {{"diameter", Dimension::Length}, {"finer", Dimension::MassFraction}});
  const std::vector<double>& diameter = *table.find("diameter");
  const std::vector<double>& finer = *table.find("finer");
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (!(diameter[row] > 0)) table.fail(row, "diameter is not above zero");
    // Beyond, a slip of the unit.
    if (diameter[row] < 1e-3 || diameter[row] > 1e3)
      table.fail(row, "diameter " + micrometres(diameter[row]) + " is not within 1 nm and 1 mm");
    if (!(finer[row] >= 0 && finer[row] <= 1)) table.fail(row, "finer is not within 0 and 100 wt%");
    if (row > 0 && !(diameter[row] > diameter[row - 1]))
      table.fail(row, "diameter does not rise from row to row");
    if (row > 0 && finer[row] < finer[row - 1]) table.fail(row, "finer falls; a cumulative curve never does");
  }
  if (table.row_count() < 2 || !(finer.back() > finer.front()))
    throw FileError(law.file.string() +
                    ": the curve does not rise; at least two rows with different finer are needed");
  return {diameter, finer};
}

// Linear over ln d between the rows.
double interpolate(const Tabulated& t, double d) {
  const auto above = std::upper_bound(t.diameter.begin(), t.diameter.end(), d);
  if (above == t.diameter.begin()) return t.finer.front();
  if (above == t.diameter.end()) return t.finer.back();
  const auto k = static_cast<std::size_t>(above - t.diameter.begin()) - 1;
  const double part = std::log(d / t.diameter[k]) / std::log(t.diameter[k + 1] / t.diameter[k]);
  return t.finer[k] + part * (t.finer[k + 1] - t.finer[k]);
}

// The rows between the cut-offs, and the curve at the cut-offs themselves.
Tabulated cut(const Tabulated& t, const SizeLaw& law) {
  const double low = law.min > 0 ? std::max(law.min, t.diameter.front()) : t.diameter.front();
  const double high = law.max > 0 ? std::min(law.max, t.diameter.back()) : t.diameter.back();
  if (!(low < high) || !(interpolate(t, high) > interpolate(t, low)))
    throw InputError("the table " + law.file.string() + " holds no weight between min and max");
  Tabulated kept{{low}, {interpolate(t, low)}};
  for (std::size_t k = 0; k < t.diameter.size(); ++k)
    if (t.diameter[k] > low && t.diameter[k] < high) {
      kept.diameter.push_back(t.diameter[k]);
      kept.finer.push_back(t.finer[k]);
    }
  kept.diameter.push_back(high);
  kept.finer.push_back(interpolate(t, high));
  return kept;
}

// Number, times pi/6 and in units of 1/um^3, of weight w spread evenly over ln d from d0 to d1:
// integral of w / ln(d1/d0) d^-3 dln d. Written with expm1, so that a narrow cell keeps its accuracy.
double number_in_cell(double w, double d0, double d1) {
  const double log_ratio = std::log(d1 / d0);
  return w * -std::expm1(-3 * log_ratio) / (3 * log_ratio * d0 * d0 * d0);
}

}  // namespace

SizeDistribution::SizeDistribution(const SizeLaw& law) {
  std::vector<double> weight;
  if (law.kind == SizeLaw::Kind::Monodisperse) {
    if (!(law.diameter > 0)) throw InputError("the diameter of the particles is not above zero");
    diameter_ = {law.diameter};
    weight_ = number_ = {1.0};
    mean_volume_ = Particles::sphere_volume(law.diameter / 2);
    return;
  }
  if (law.kind == SizeLaw::Kind::Table) {
    const Tabulated table = cut(read_table(law), law);
    diameter_ = table.diameter;
    for (std::size_t k = 1; k < table.finer.size(); ++k)
      weight.push_back(table.finer[k] - table.finer[k - 1]);
  } else {
    const Bell bell = bell_of(law);
    for (int k = 0; k <= cells; ++k)
      diameter_.push_back(k == 0 ? bell.low
                          : k == cells
                              ? bell.high
                              : bell.low * std::pow(bell.high / bell.low, static_cast<double>(k) / cells));
    for (int k = 0; k < cells; ++k)
      weight.push_back(normal_probability(bell.x(diameter_[k]), bell.x(diameter_[k + 1])));
  }
  integrate(weight);
}

void SizeDistribution::integrate(const std::vector<double>& weight_in_cell) {
  weight_ = number_ = {0.0};
  for (std::size_t k = 0; k < weight_in_cell.size(); ++k) {
    weight_.push_back(weight_.back() + weight_in_cell[k]);
    number_.push_back(number_.back() + number_in_cell(weight_in_cell[k], diameter_[k], diameter_[k + 1]));
  }
  const double total_weight = weight_.back(), total_number = number_.back();
  for (double& w : weight_) w /= total_weight;
  for (double& n : number_) n /= total_number;
  mean_volume_ = std::numbers::pi / 6 * total_weight / total_number;
}

double SizeDistribution::weight_below(double d) const {
  if (d < smallest()) return 0;
  if (d >= largest()) return 1;
  const auto k =
      static_cast<std::size_t>(std::upper_bound(diameter_.begin(), diameter_.end(), d) - diameter_.begin()) -
      1;
  return weight_[k] + (weight_[k + 1] - weight_[k]) * std::log(d / diameter_[k]) /
                          std::log(diameter_[k + 1] / diameter_[k]);
}

double SizeDistribution::number_below(double d) const {
  if (d < smallest()) return 0;
  if (d >= largest()) return 1;
  const auto k =
      static_cast<std::size_t>(std::upper_bound(diameter_.begin(), diameter_.end(), d) - diameter_.begin()) -
      1;
  const double part = std::expm1(-3 * std::log(d / diameter_[k])) /
                      std::expm1(-3 * std::log(diameter_[k + 1] / diameter_[k]));
  return number_[k] + (number_[k + 1] - number_[k]) * part;
}

double SizeDistribution::diameter_at_number(double u) const {
  if (monodisperse() || u >= 1) return largest();
  if (u <= 0) return smallest();
  // The last point at or below u, so that a stretch of the table without particles is never sampled.
  auto k = static_cast<std::size_t>(std::upper_bound(number_.begin(), number_.end(), u) - number_.begin());
  if (k >= number_.size()) return largest();
  --k;
  const double part = (u - number_[k]) / (number_[k + 1] - number_[k]);
  const double all = std::expm1(-3 * std::log(diameter_[k + 1] / diameter_[k]));
  return std::clamp(diameter_[k] * std::exp(-std::log1p(part * all) / 3), diameter_[k], diameter_[k + 1]);
}

}  // namespace pigment
