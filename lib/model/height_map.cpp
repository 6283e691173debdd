#include "model/height_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/csv_table.h"
#include "model/height_field.h"

namespace pigment {

namespace {

constexpr int points_a_wavelength = 12;  // the spline through them errs by under 1e-4 of the amplitude
constexpr std::size_t fewest_points = 4, most_points = 1'000'000;
constexpr double evenness = 1e-3;  // of the spacing: as good as a table of four digits says it

// The even grid along one axis that a table's coordinates stand on.
struct Axis {
  std::size_t count = 0;
  double first = 0, spacing = 0;
};

Axis axis_of(const config::CsvTable& table, const char* name) {
  const std::vector<double>& at = *table.find(name);
  std::vector<double> sorted = at;
  std::sort(sorted.begin(), sorted.end());
  const double span = sorted.back() - sorted.front();
  // Points closer than a thousandth of the mean spacing of as many as there could be are one.
  const double same = evenness * span / static_cast<double>(sorted.size());
  std::vector<double> distinct;
  for (double x : sorted)
    if (distinct.empty() || x - distinct.back() > same) distinct.push_back(x);
  Axis axis{distinct.size(), distinct.front(), 0};
  if (axis.count == 1) return axis;
  axis.spacing = span / static_cast<double>(axis.count - 1);
  for (std::size_t row = 0; row < at.size(); ++row) {
    const double steps = (at[row] - axis.first) / axis.spacing;
    if (std::abs(steps - std::nearbyint(steps)) > evenness)
      table.fail(row, fmt::format("{} = {:g} um is not on an even grid: the others are {:g} um apart from {:g} um on", name, at[row], axis.spacing, axis.first));
  }
  return axis;
}

HeightMap read_table(const std::filesystem::path& file) {
  const config::CsvTable table = config::read_csv(file, {{"x", Dimension::Length}, {"y", Dimension::Length}, {"height", Dimension::Length}});
  const Axis x = axis_of(table, "x"), y = axis_of(table, "y");
  const std::size_t rows = table.row_count(), points = x.count * y.count;
  if (std::max(x.count, y.count) < fewest_points)
    table.fail(0, fmt::format("the grid has {} x {} points, expected {} or more along x or y", x.count, y.count, fewest_points));
  if (points > most_points) table.fail(0, fmt::format("the grid has {} points, expected at most {}", points, most_points));
  for (const std::size_t count : {x.count, y.count})
    if (count > 1 && count < fewest_points)
      table.fail(0, fmt::format("the grid has {} x {} points; along an axis that has more than one it takes {} or more", x.count, y.count, fewest_points));
  HeightMap map{x.count, y.count, static_cast<double>(x.count) * x.spacing, static_cast<double>(y.count) * y.spacing, std::vector<double>(points)};
  if (x.count == 1) map.period_x = map.period_y;  // any will do
  if (y.count == 1) map.period_y = map.period_x;
  const std::vector<double>&at_x = *table.find("x"), &at_y = *table.find("y"), &height = *table.find("height");
  std::vector<int> line_of(points, 0);
  const auto place = [](const Axis& axis, double at) {
    return axis.count == 1 ? std::size_t{0} : static_cast<std::size_t>(std::lround((at - axis.first) / axis.spacing));
  };
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t at = place(x, at_x[row]) * y.count + place(y, at_y[row]);
    if (line_of[at] > 0) table.fail(row, fmt::format("x = {:g} um, y = {:g} um stands in line {} already", at_x[row], at_y[row], line_of[at]));
    line_of[at] = table.line[row];
    map.height[at] = height[row];
  }
  if (rows < points)
    table.fail(rows - 1, fmt::format("the table ends with {} rows; a grid of {} x {} points takes {}, one for each x with each y", rows, x.count, y.count, points));
  return map;
}

HeightMap waves(const Roughness& roughness) {
  constexpr int n = points_a_wavelength;
  HeightMap map{n, n, roughness.wavelength, roughness.wavelength, {}};
  const auto wave = [](int i) { return std::cos(2 * std::numbers::pi * i / n); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) map.height.push_back(0.25 * roughness.amplitude * (2 + wave(i) + wave(j)));
  return map;
}

}  // namespace

Roughness read_roughness(config::Node node) {
  Roughness roughness;
  if (node.has("file")) {
    for (const char* key : {"amplitude", "wavelength"})
      if (node.has(key)) node.error(key, "the file holds the heights; leave this out, or the file");
    roughness.file = node.file("file");
    return roughness;
  }
  roughness.amplitude = node.quantity("amplitude", Dimension::Length, config::positive());
  roughness.wavelength = node.quantity("wavelength", Dimension::Length, config::positive());
  return roughness;
}

HeightMap height_map(const Roughness& roughness) {
  HeightMap map = roughness.file.empty() ? waves(roughness) : read_table(roughness.file);
  const double lowest = HeightField(map, Cell{map.period_x, map.period_y, 0}).lowest();
  for (double& z : map.height) z -= lowest;
  return map;
}

}  // namespace pigment
