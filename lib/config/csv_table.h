#pragma once
// A table of numbers in a CSV file whose header names each column's unit: "diameter [um],finer [wt%]".
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"

namespace pigment::config {

struct CsvColumn {
  std::string name;  // without the unit
  Dimension dimension;
  bool required = true;
  std::vector<std::pair<std::string, double>> words = {};  // what may stand in place of a number, and its value
};

struct CsvTable {
  std::filesystem::path file;
  std::vector<CsvColumn> columns;           // those that the file has, in its order
  std::vector<std::vector<double>> values;  // [column][row], engine units
  std::vector<int> line;                    // of each row, counted from 1

  std::size_t row_count() const { return line.size(); }
  // The values of a column; nullptr where the file lacks it.
  const std::vector<double>* find(const std::string& name) const;
  // "F.csv:7: message", for what is wrong with a row although each number is well-formed. Throws FileError.
  [[noreturn]] void fail(std::size_t row, const std::string& message) const;
};

// Reads a file with one header line; empty lines and lines that begin with # are skipped, fields may stand in
// spaces. Any order of columns will do. Throws FileError, with the line, for a file that cannot be read, an
// unknown, missing or repeated column, a unit that is missing or of another dimension, a row of the wrong
// length, a field that is neither a finite number nor one of the column's words, and a file without rows.
CsvTable read_csv(const std::filesystem::path&, const std::vector<CsvColumn>& expected);

}  // namespace pigment::config
