#pragma once
// Arrays with a unit: SI and a `unit` attribute in the file, engine units in memory.
#include <string>
#include <vector>

#include "base/units.h"
#include "io/h5.h"

namespace pigment::io {

// The dimension whose SI unit this is, or else the first that it converts to; Number where it is none.
Dimension dimension_of_unit(const std::string& unit);
// The dataset's `unit`; empty where it has none. Throws FileError where it is there and empty.
std::string unit_of(const h5::InputFile&, const std::string& path);
// Engine value = factor * stored + offset. No unit means SI; throws FileError for a unit of another
// dimension, or of none.
struct FileToEngine {
  double factor = 1, offset = 0;
};
FileToEngine file_to_engine(const h5::InputFile&, const std::string& path, Dimension);

// Throws FileError where a number is not finite.
void require_finite(const h5::InputFile&, const std::string& path, const std::vector<double>&);
std::vector<double> read_quantity(const h5::InputFile&, const std::string& path, Dimension);
std::vector<double> read_quantity_rows(const h5::InputFile&, const std::string& path, Dimension,
                                       std::size_t first, std::size_t count);

void write_unit(h5::OutputFile&, const std::string& path, Dimension);
void write_quantity(h5::OutputFile&, const std::string& path, const h5::Extent&,
                    const std::vector<double>& engine, Dimension, h5::Type stored = h5::Type::Float64);

}  // namespace pigment::io
