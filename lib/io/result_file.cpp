#include "io/result_file.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "base/error.h"
#include "io/file_header.h"
#include "io/file_units.h"

namespace pigment::io {
namespace {

Dataset::Storage storage_of(h5::Type type) {
  switch (type) {
    case h5::Type::Float64:
      return Dataset::Storage::Float64;
    case h5::Type::Float32:
      return Dataset::Storage::Float32;
    default:
      return Dataset::Storage::Int64;
  }
}
h5::Type type_of(Dataset::Storage storage) {
  switch (storage) {
    case Dataset::Storage::Float32:
      return h5::Type::Float32;
    case Dataset::Storage::Int64:
      return h5::Type::Int64;
    case Dataset::Storage::Float64:
      break;
  }
  return h5::Type::Float64;
}

void read_below(const h5::InputFile& file, const std::string& group,
                const std::map<std::string, Dimension>& dimensions, std::vector<Dataset>& out,
                int depth = 0) {
  if (depth > 16) file.fail(group, "groups lie too deep in each other");
  for (const auto& name : file.children(group)) {
    const std::string path = group + "/" + name;
    if (file.is_group(path)) {
      read_below(file, path, dimensions, out, depth + 1);
    } else if (file.is_dataset(path) && file.is_number(path)) {
      Dataset dataset;
      dataset.path = path;
      dataset.shape = file.shape(path);
      dataset.storage = storage_of(file.type(path));
      const auto listed = dimensions.find(path);
      dataset.dimension =
          listed != dimensions.end() ? listed->second : dimension_of_unit(unit_of(file, path));
      dataset.values = read_quantity(file, path, dataset.dimension);
      out.push_back(std::move(dataset));
    }
  }
}

}  // namespace

void write_datasets(h5::OutputFile& file, const std::vector<Dataset>& datasets) {
  for (const auto& dataset : datasets) {
    // Broken invariants of the caller, not of the user.
    if (h5::element_count(dataset.shape) != dataset.values.size())
      throw std::logic_error(fmt::format("{}: {} values for the shape {}", dataset.path,
                                         dataset.values.size(), h5::to_string(dataset.shape)));
    for (const double value : dataset.values)
      if (!std::isfinite(value)) throw std::logic_error(dataset.path + ": a result is not a finite number");
    write_quantity(file, dataset.path, dataset.shape, dataset.values, dataset.dimension,
                   type_of(dataset.storage));
  }
}

const Dataset* ResultFile::find(const std::string& path) const {
  for (const auto& dataset : datasets)
    if (dataset.path == path) return &dataset;
  return nullptr;
}

const Dataset& ResultFile::require(const std::string& path) const {
  if (const Dataset* found = find(path)) return *found;
  std::string there;
  for (const auto& dataset : datasets) there += (there.empty() ? "" : ", ") + dataset.path;
  throw FileError(
      fmt::format("{}: {} is missing; there is {}", file.string(), path, there.empty() ? "nothing" : there));
}

void write_result(const std::filesystem::path& name, const ResultFile& result) {
  h5::OutputFile file(name);
  write_header(file, result.kind, result.attributes, result.provenance);
  const std::string group = "/" + result.kind;
  file.group(group);
  for (const auto& [attribute, value] : result.numbers) {
    if (!std::isfinite(value))
      throw std::logic_error(group + ": attribute " + attribute + " is not a finite number");
    file.attribute(group, attribute, value);
  }
  write_datasets(file, result.datasets);
  file.commit();
}

ResultFile read_result(const std::filesystem::path& name, const std::string& kind,
                       const std::map<std::string, Dimension>& dimensions) {
  const h5::InputFile file(name);
  const Header header = read_header(file);
  const std::string group = "/" + kind;
  if (!header.kind.empty() && header.kind != kind)
    throw FileError(fmt::format("{}: is a {} file, expected a {} file", name.string(), header.kind, kind));
  if (!file.is_group(group))
    throw FileError(fmt::format("{}: has no group {}, expected a {} file", name.string(), group, kind));
  ResultFile result;
  result.kind = kind;
  result.file = name;
  result.attributes = header.attributes;
  result.provenance = header.provenance;
  for (const auto& attribute : file.attributes(group))
    if (const auto values = file.number_attribute(group, attribute); values && values->size() == 1)
      result.numbers[attribute] = values->front();
  read_below(file, group, dimensions, result.datasets);
  return result;
}

}  // namespace pigment::io
