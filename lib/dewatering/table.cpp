#include "dewatering/table.h"

#include <algorithm>
#include <cmath>

#include "config/csv_table.h"

namespace pigment::dewatering {
namespace {

constexpr double jump = 1e-9;            // of the table's length
constexpr double chord_tolerance = 1e-6;  // of the liquid removed over the table

void check_rows(const config::CsvTable& table) {
  const auto& time = *table.find("time");
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (row == 0 && time[row] != 0) table.fail(row, "the first time must be 0");
    if (row > 0 && time[row] < time[row - 1]) table.fail(row, "time must not fall");
    if (row > 1 && time[row] == time[row - 2]) table.fail(row, "time stands here for the third time; twice is a jump");
    for (const char* flux : {"absorption", "evaporation"})
      if ((*table.find(flux))[row] < 0) table.fail(row, std::string(flux) + " must not be negative");
    if (const auto* temperature = table.find("temperature"))
      if (!((*temperature)[row] >= coldest && (*temperature)[row] <= hottest))
        table.fail(row, "temperature must lie between -20 and 110 degC");
  }
}

// The rows as they stand, jumps apart.
DewateringCurve rows_of(const config::CsvTable& table, double liquid_density) {
  DewateringCurve curve;
  curve.time = *table.find("time");
  const double apart = jump * curve.time.back();
  for (std::size_t row = 1; row < curve.time.size(); ++row)
    if (curve.time[row] <= curve.time[row - 1]) {
      curve.time[row] = curve.time[row - 1] + apart;
      if (apart == 0) table.fail(row, "the table's times are all 0");
      if (row + 1 < curve.time.size() && curve.time[row + 1] <= curve.time[row])
        table.fail(row + 1, "lies too close after a jump");
    }
  for (double flux : *table.find("absorption")) curve.absorption_flux.push_back(flux / liquid_density);
  for (double flux : *table.find("evaporation")) curve.evaporation_flux.push_back(flux / liquid_density);
  if (const auto* temperature = table.find("temperature")) curve.temperature = *temperature;
  return curve;
}

// A chord of the integral of a flux that goes from q0 to q1 errs by (t1 - t0) |q1 - q0| / 8 at most, and by 1/m^2 of
// this over m pieces.
int pieces(double length, double change, double tolerance) {
  if (!(tolerance > 0)) return 1;
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(length * std::abs(change) / (8 * tolerance))), 1.0, 1e4));
}

DewateringCurve refined(const DewateringCurve& rows) {
  const double last = rows.time.back();
  const double tolerance = chord_tolerance * (rows.absorbed_at(last) + rows.evaporated_at(last));
  DewateringCurve curve;
  auto add = [&](std::size_t row, double part) {
    auto between = [&](const std::vector<double>& v) {
      return part == 0 ? v[row] : (1 - part) * v[row] + part * v[row + 1];
    };
    curve.time.push_back(between(rows.time));
    curve.absorption_flux.push_back(between(rows.absorption_flux));
    curve.evaporation_flux.push_back(between(rows.evaporation_flux));
    if (!rows.temperature.empty()) curve.temperature.push_back(between(rows.temperature));
  };
  for (std::size_t row = 0; row + 1 < rows.time.size(); ++row) {
    const double length = rows.time[row + 1] - rows.time[row];
    const int m = std::max(
        pieces(length, rows.absorption_flux[row + 1] - rows.absorption_flux[row], tolerance),
        pieces(length, rows.evaporation_flux[row + 1] - rows.evaporation_flux[row], tolerance));
    for (int i = 0; i < m; ++i) add(row, double(i) / m);
  }
  add(rows.time.size() - 1, 0);
  return curve;
}

// The integral of the linear flux at each point: the trapezium rule is exact.
std::vector<double> integral(const std::vector<double>& time, const std::vector<double>& flux) {
  std::vector<double> sum(time.size(), 0.0);
  for (std::size_t i = 1; i < time.size(); ++i)
    sum[i] = sum[i - 1] + 0.5 * (time[i] - time[i - 1]) * (flux[i] + flux[i - 1]);
  return sum;
}

}  // namespace

DewateringCurve read_table(const std::filesystem::path& file, double liquid_density) {
  const config::CsvTable table = config::read_csv(file, {{"time", Dimension::Time},
                                                         {"absorption", Dimension::MassFlux},
                                                         {"evaporation", Dimension::MassFlux},
                                                         {"temperature", Dimension::Temperature, false}});
  check_rows(table);
  DewateringCurve curve = refined(rows_of(table, liquid_density));
  curve.absorbed = integral(curve.time, curve.absorption_flux);
  curve.evaporated = integral(curve.time, curve.evaporation_flux);
  return curve;
}

}  // namespace pigment::dewatering
