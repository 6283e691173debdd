#include "io/file_units.h"

#include <fmt/format.h>

#include <cmath>

namespace pigment::io {
namespace {

constexpr int dimension_count = static_cast<int>(Dimension::VolumeFraction) + 1;

void convert(const h5::InputFile& file, const std::string& path, Dimension dimension,
             std::vector<double>& values) {
  require_finite(file, path, values);
  const FileToEngine to = file_to_engine(file, path, dimension);
  for (double& value : values) value = to.factor * value + to.offset;
  require_finite(file, path, values);
}

}  // namespace

Dimension dimension_of_unit(const std::string& unit) {
  for (int d = 0; d < dimension_count; ++d)
    if (unit == info(static_cast<Dimension>(d)).si_unit) return static_cast<Dimension>(d);
  for (int d = 1; d < dimension_count; ++d)
    if (!unit.empty() && conversion_to_si(unit, static_cast<Dimension>(d)).ok)
      return static_cast<Dimension>(d);
  return Dimension::Number;
}

std::string unit_of(const h5::InputFile& file, const std::string& path) {
  const auto unit = file.text_attribute(path, "unit");
  // Also what a lost text reads as.
  if (unit && unit->empty())
    file.fail(path, "its unit is empty; a number without a dimension has the unit 1");
  return unit.value_or("");
}

FileToEngine file_to_engine(const h5::InputFile& file, const std::string& path, Dimension dimension) {
  const double engine_per_si = info(dimension).engine_per_si;
  const std::string unit = unit_of(file, path);
  if (unit.empty() || unit == info(dimension).si_unit) return {engine_per_si, 0};
  const UnitConversion c = conversion_to_si(unit, dimension);
  if (!c.ok)
    file.fail(path, dimension == Dimension::Number ? fmt::format("its unit \"{}\" is not known", unit)
                                                   : "its unit " + c.error);
  return {c.factor * engine_per_si, c.offset * engine_per_si};
}

void require_finite(const h5::InputFile& file, const std::string& path, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      file.fail(path, fmt::format("entry {} (counted row by row) is not a finite number", i));
}

std::vector<double> read_quantity(const h5::InputFile& file, const std::string& path, Dimension dimension) {
  std::vector<double> values = file.doubles(path);
  convert(file, path, dimension, values);
  return values;
}

std::vector<double> read_quantity_rows(const h5::InputFile& file, const std::string& path,
                                       Dimension dimension, std::size_t first, std::size_t count) {
  std::vector<double> values = file.rows(path, first, count);
  convert(file, path, dimension, values);
  return values;
}

void write_unit(h5::OutputFile& file, const std::string& path, Dimension dimension) {
  file.attribute(path, "unit", std::string(info(dimension).si_unit));
}

void write_quantity(h5::OutputFile& file, const std::string& path, const h5::Extent& shape,
                    const std::vector<double>& engine, Dimension dimension, h5::Type stored) {
  std::vector<double> si(engine);
  for (double& value : si) value = to_si(dimension, value);
  file.write(path, shape, si.data(), stored);
  write_unit(file, path, dimension);
}

}  // namespace pigment::io
