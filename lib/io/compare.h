#pragma once
// Two HDF5 files, object by object: what is there, type, shape, attributes, and every number within a stated
// tolerance. Numbers are compared as they are stored (SI), whatever their size: 1e-21 and 2e-21 differ.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pigment::io {

// a and b are the same where |a - b| <= absolute + relative * max(|a|, |b|).
struct Tolerance {
  double relative = 0, absolute = 0;
};

struct CompareOptions {
  Tolerance tolerance;                       // where no other is given
  std::map<std::string, Tolerance> by_path;  // dataset, or a group for all below it; the longest path wins
  std::vector<std::string> ignore;           // object (with all below it), or OBJECT@ATTRIBUTE
  bool nan_equal = false;                    // not-a-number in both files is the same
};

struct Comparison {
  std::vector<std::string> differences;  // one line each: path, index, both values, largest difference
  bool same() const { return differences.empty(); }
};

// Throws FileError where a file cannot be read, InputError for a tolerance of a path that neither file has.
Comparison compare_files(const std::filesystem::path& first, const std::filesystem::path& second,
                         const CompareOptions&);

}  // namespace pigment::io
