#include "dewatering/dewatering_file.h"

#include <fmt/format.h>

#include <string>

#include "base/error.h"
#include "dewatering/table.h"

namespace pigment::dewatering {
namespace {

struct Column {
  const char* path;
  Dimension dimension;
  std::vector<double> DewateringCurve::*values;
  bool required;
};
const Column columns[] = {
    {"/dewatering/time", Dimension::Time, &DewateringCurve::time, true},
    {"/dewatering/absorption_flux", Dimension::Velocity, &DewateringCurve::absorption_flux, true},
    {"/dewatering/evaporation_flux", Dimension::Velocity, &DewateringCurve::evaporation_flux, true},
    {"/dewatering/temperature", Dimension::Temperature, &DewateringCurve::temperature, false},
    {"/dewatering/absorbed", Dimension::Length, &DewateringCurve::absorbed, false},
    {"/dewatering/evaporated", Dimension::Length, &DewateringCurve::evaporated, false},
};

// The first i at which values[i] < values[i - 1], or (strict) <=; the size where there is none.
std::size_t first_fall(const std::vector<double>& values, bool strict) {
  std::size_t i = 1;
  while (i < values.size() && (strict ? values[i] > values[i - 1] : values[i] >= values[i - 1])) ++i;
  return std::min(i, values.size());
}

struct Checker {
  const std::filesystem::path& file;

  void demand(bool holds, const char* path, const std::string& message) const {
    if (!holds) throw FileError(file.string() + ": " + path + ": " + message);
  }
  void rising_from_zero(const std::vector<double>& values, const char* path, bool strict) const {
    demand(values.front() == 0, path, "must start at 0, found " + std::to_string(values.front()));
    const std::size_t i = first_fall(values, strict);
    demand(i == values.size(), path, (strict ? "must rise, and does not at point " : "must not fall, and does at point ") + std::to_string(i));
  }
  void none_below(const std::vector<double>& values, double least, const char* path, const char* message) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      demand(values[i] >= least, path, message + std::string(" at point ") + std::to_string(i));
  }
};

}  // namespace

io::ResultFile result_of(const Profile& profile) {
  io::ResultFile result;
  result.kind = "dewatering";
  for (const Column& column : columns) {
    const std::vector<double>& values = profile.curve.*column.values;
    if (!values.empty()) result.datasets.push_back({column.path, {values.size()}, values, column.dimension});
  }
  result.numbers = {{"scale", profile.scale}, {"duration", to_si(Dimension::Time, profile.duration)}};
  return result;
}

DewateringCurve read_curve(const std::filesystem::path& path) {
  std::map<std::string, Dimension> dimensions;
  for (const Column& column : columns) dimensions[column.path] = column.dimension;
  const io::ResultFile file = io::read_result(path, "dewatering", dimensions);
  const Checker check{path};
  DewateringCurve curve;
  for (const Column& column : columns) {
    const io::Dataset* dataset = column.required ? &file.require(column.path) : file.find(column.path);
    if (!dataset) continue;
    check.demand(dataset->shape.size() == 1 && !dataset->values.empty(), column.path, "must be a list of numbers");
    curve.*column.values = dataset->values;
    check.demand(dataset->values.size() == curve.time.size(), column.path,
                 "has " + std::to_string(dataset->values.size()) + " points, time has " + std::to_string(curve.time.size()));
  }
  check.rising_from_zero(curve.time, "/dewatering/time", true);
  check.none_below(curve.absorption_flux, 0, "/dewatering/absorption_flux", "is negative");
  check.none_below(curve.evaporation_flux, 0, "/dewatering/evaporation_flux", "is negative");
  for (std::size_t i = 0; i < curve.temperature.size(); ++i)
    check.demand(curve.temperature[i] >= coldest && curve.temperature[i] <= hottest, "/dewatering/temperature",
                 fmt::format("is {:.6g} K at point {}, expected {} to {} K", curve.temperature[i], i, coldest, hottest));
  if (!curve.absorbed.empty()) check.rising_from_zero(curve.absorbed, "/dewatering/absorbed", false);
  if (!curve.evaporated.empty()) check.rising_from_zero(curve.evaporated, "/dewatering/evaporated", false);
  return curve;
}

}  // namespace pigment::dewatering
