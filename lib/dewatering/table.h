#pragma once
// A dewatering curve from a CSV table of the user's own.
#include <filesystem>

#include "model/dewatering_curve.h"

namespace pigment::dewatering {

inline constexpr double coldest = 253.15, hottest = 383.15;  // K, range of the correlations for water [patek2009]

// Columns `time [s],absorption [g/m2/s],evaporation [g/m2/s]` and optionally `temperature [degC]`; mass fluxes become
// volume fluxes by the liquid's density (engine units). Linear between rows; a time that stands twice is a jump, kept as
// two points a billionth of the table's length apart. Points are added between rows until the cumulative curves, exact at
// the points, err by less than 1e-6 of the liquid removed when read as straight lines.
// Throws FileError with file and line: times that do not rise from 0, negative fluxes, a temperature at which water is not
// liquid.
DewateringCurve read_table(const std::filesystem::path&, double liquid_density);

}  // namespace pigment::dewatering
