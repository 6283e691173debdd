#include "report/run_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "io/file_header.h"
#include "io/h5.h"

namespace pigment::report {
namespace {

constexpr std::array result_kinds{"dewatering", "kbrown", "solids", "cluster", "separation", "mobility"};

// What /pigment says, or, for a file made by hand, what its groups show.
std::string kind_of(const std::filesystem::path& path) {
  const io::h5::InputFile file(path);
  const std::string kind = io::read_header(file).kind;
  if (!kind.empty()) return kind;
  if (file.is_group("/particles/layer")) return file.is_group("/observables") ? "trajectory" : "packing";
  for (const char* known : result_kinds)
    if (file.is_group(std::string("/") + known)) return known;
  throw FileError(fmt::format(
      "{}: is no file of pigment's: it has neither particles (/particles/layer) nor any of the groups /{}",
      path.string(), fmt::join(result_kinds, ", /")));
}

bool holds(const RunFiles& run, const std::string& kind) {
  if (kind == "trajectory") return run.trajectory != nullptr;
  if (kind == "packing") return run.packing != nullptr;
  return run.results.contains(kind);
}

}  // namespace

const io::ResultFile* RunFiles::result(const std::string& kind) const {
  const auto found = results.find(kind);
  return found == results.end() ? nullptr : &found->second;
}

Surroundings surroundings_of(const io::Provenance& provenance) {
  if (provenance.tool != "pigment-consolidate" || provenance.scene.empty()) return {};
  const std::string scene = "\n" + provenance.scene;
  return {scene.find("\nsubstrate: none") == std::string::npos,
          scene.find("\nfree_surface:") != std::string::npos};
}

std::vector<RunFiles> gather_runs(const std::vector<std::filesystem::path>& paths) {
  std::vector<RunFiles> runs;
  std::vector<std::filesystem::path> folders;
  for (const auto& path : paths) {
    const std::string kind = kind_of(path);
    const bool particles = kind == "trajectory" || kind == "packing";
    if (!particles && std::find(result_kinds.begin(), result_kinds.end(), kind) == result_kinds.end())
      throw FileError(fmt::format(
          "{}: is a {} file, which no section of the report shows; expected packing, trajectory, {}",
          path.string(), kind, fmt::join(result_kinds, ", ")));
    const auto folder = std::filesystem::weakly_canonical(std::filesystem::absolute(path)).parent_path();
    std::size_t at = 0;
    while (at < runs.size() && (folders[at] != folder || holds(runs[at], kind))) ++at;
    if (at == runs.size()) {
      // A second file of one kind in a folder begins a run of its own.
      const bool first = std::find(folders.begin(), folders.end(), folder) == folders.end();
      runs.push_back({first ? folder.filename().string() : path.stem().string(), {}, {}, {}, {}});
      folders.push_back(folder);
    }
    RunFiles& run = runs[at];
    io::Provenance provenance;
    if (particles) {
      auto layer = std::make_shared<io::ParticleFile>(path);
      provenance = layer->provenance();
      (kind == "trajectory" ? run.trajectory : run.packing) = std::move(layer);
    } else {
      io::ResultFile result = io::read_result(path, kind);
      provenance = result.provenance;
      run.results.emplace(kind, std::move(result));
    }
    const io::h5::InputFile file(path);
    const std::string version =
        file.has("/provenance") ? file.text_attribute("/provenance", "version").value_or("") : "";
    run.sources.push_back({path, kind, version, provenance});
  }
  return runs;
}

std::vector<double> Rows::row(std::size_t r) const {
  const auto first = dataset->values.begin() + static_cast<std::ptrdiff_t>(r * columns);
  return {first, first + static_cast<std::ptrdiff_t>(columns)};
}

Rows rows_of(const io::ResultFile& file, const std::string& path, std::optional<std::size_t> rows,
             std::optional<std::size_t> columns) {
  Rows out;
  out.dataset = file.find(path);
  if (!out.dataset) return out;
  const auto& shape = out.dataset->shape;
  if (shape.empty() || shape.size() > 2)
    throw FileError(fmt::format("{}: {}: has {} dimensions, expected one or two", file.file.string(), path,
                                shape.size()));
  out.rows = shape[0];
  out.columns = shape.size() == 2 ? shape[1] : 1;
  if ((rows && out.rows != *rows) || (columns && out.columns != *columns))
    throw FileError(fmt::format("{}: {}: is {} x {}, expected {} x {}", file.file.string(), path, out.rows,
                                out.columns, rows.value_or(out.rows), columns.value_or(out.columns)));
  return out;
}

}  // namespace pigment::report
