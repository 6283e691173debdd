#pragma once
// Any of our HDF5 files as a flat list of datasets: the form that dewatering, kbrown and the analyses share.
// Values are in engine units here and in SI in the file, each with its `unit` attribute.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/units.h"

namespace pigment::io {

struct Dataset {
  enum class Storage { Float64, Float32, Int64 };
  std::string path;                // "/solids/time"
  std::vector<std::size_t> shape;  // {} for a scalar
  std::vector<double> values;      // row-major, engine units
  Dimension dimension = Dimension::Number;
  Storage storage = Storage::Float64;
};

// Who made a file from what: group /provenance. The same inputs give the same bytes: no times, hosts, paths,
// threads.
struct Provenance {
  std::string tool;   // "pigment-pack"
  std::string scene;  // the resolved blocks that this tool reads, YAML; empty: it reads none
  std::map<std::string, std::string> inputs;  // role ("packing") -> SHA-256 of the file
};

std::string sha256_of_file(const std::filesystem::path&);  // throws FileError
std::string sha256_of_text(const std::string&);

struct ResultFile {
  std::string kind;  // "solids", "dewatering", ...: the group that holds the datasets
  std::vector<Dataset> datasets;
  std::map<std::string, std::string>
      attributes;  // text attributes of /pigment beside format version and kind (outcome, ...)
  std::map<std::string, double> numbers;  // numeric attributes of the group /KIND (scale, ...), plain SI
  Provenance provenance;

  const Dataset* find(const std::string& path) const;  // nullptr where absent
  const Dataset& require(
      const std::string& path) const;  // throws FileError naming file, path, and what is there
  std::filesystem::path file;          // where it was read from, for messages
};

// Writes beside the final name and renames when whole; throws OutputError. A NaN or infinity is a logic_error
// (the caller answers for it), so none is ever written as a result.
void write_result(const std::filesystem::path&, const ResultFile&);
// Reads every dataset below /KIND (numeric ones), converting units of the right dimension given by
// `dimensions` (path -> dimension; a dataset not listed keeps the dimension its unit attribute names, or
// Number). Throws FileError: missing, not HDF5, corrupt, newer major version, another kind, or a non-finite
// number.
ResultFile read_result(const std::filesystem::path&, const std::string& kind,
                       const std::map<std::string, Dimension>& dimensions = {});

}  // namespace pigment::io
