#pragma once
// Datasets out of a list of plain results, one row an entry.
#include <string>
#include <type_traits>
#include <vector>

#include "io/result_file.h"

namespace pigment::io {

// value(entry) is a number: shape [entries]; or an array of numbers, of one length in all entries: [entries,
// length].
template <typename Entries, typename Value>
Dataset column(const std::string& path, Dimension dimension, const Entries& entries, const Value& value,
               Dataset::Storage storage = Dataset::Storage::Float64) {
  Dataset dataset{path, {entries.size()}, {}, dimension, storage};
  for (const auto& entry : entries) {
    const auto& of_entry = value(entry);
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(of_entry)>>) {
      dataset.values.push_back(static_cast<double>(of_entry));
    } else {
      if (dataset.shape.size() == 1) dataset.shape.push_back(of_entry.size());
      for (const auto number : of_entry) dataset.values.push_back(static_cast<double>(number));
    }
  }
  return dataset;
}

// The numbers themselves: shape [numbers].
template <typename Number>
Dataset column(const std::string& path, Dimension dimension, const std::vector<Number>& numbers,
               Dataset::Storage storage = Dataset::Storage::Float64) {
  return column(
      path, dimension, numbers, [](Number number) { return number; }, storage);
}

}  // namespace pigment::io
