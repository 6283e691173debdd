#pragma once
// The files of one run, by kind, as a report reads them. Files of one folder belong together.
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/particle_file.h"
#include "io/result_file.h"

namespace pigment::report {

struct SourceFile {
  std::filesystem::path path;
  std::string kind;     // "trajectory", "packing", "solids", ...
  std::string version;  // of the tool that wrote it; empty for a file made by hand
  io::Provenance provenance;
};

struct RunFiles {
  std::string name;  // of the folder
  std::shared_ptr<io::ParticleFile> trajectory, packing;
  std::map<std::string, io::ResultFile>
      results;                      // by kind: dewatering, kbrown, solids, cluster, separation, mobility
  std::vector<SourceFile> sources;  // in the order given

  // nullptr where the run has no such file.
  const io::ResultFile* result(const std::string& kind) const;
  // The trajectory, else the packing, else nullptr.
  const io::ParticleFile* particles() const { return trajectory ? trajectory.get() : packing.get(); }
};

// What the run that made a particle file had around the particles, as its scene says; both, where it says
// nothing.
struct Surroundings {
  bool substrate = true, free_surface = true;
};
Surroundings surroundings_of(const io::Provenance&);

// Reads every file and sorts them into runs. Throws FileError for a file that is missing, damaged or none of
// ours.
std::vector<RunFiles> gather_runs(const std::vector<std::filesystem::path>&);

// One dataset seen as rows: [rows] or [rows, columns]. Throws FileError where its shape is another.
struct Rows {
  const io::Dataset* dataset = nullptr;  // nullptr: the file has none, and rows is 0
  std::size_t rows = 0, columns = 1;
  double at(std::size_t row, std::size_t column = 0) const { return dataset->values[row * columns + column]; }
  std::vector<double> row(std::size_t) const;
  std::vector<double> all() const { return dataset ? dataset->values : std::vector<double>{}; }
  explicit operator bool() const { return rows > 0; }
};
// rows: how many it must have (that of the file's times); columns likewise where given.
Rows rows_of(const io::ResultFile&, const std::string& path, std::optional<std::size_t> rows = {},
             std::optional<std::size_t> columns = {});

}  // namespace pigment::report
