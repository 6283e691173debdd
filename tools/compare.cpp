// compare: are two HDF5 files the same within tolerances? For reference files in tests, where h5diff cannot
// see SI-sized numbers (it takes whatever is below 2e-16 for zero when asked for a relative tolerance).
#include "io/compare.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>

#include "app/tool.h"
#include "base/error.h"

namespace {

using namespace pigment;

constexpr std::size_t most_lines = 20;

struct Options {
  std::filesystem::path first, second, tolerances;
  double relative = 0, absolute = 0;
  std::vector<std::string> tolerance, ignore;
  bool ignore_version = false, nan_equal = false;
};

void declare(app::CommandLine& line, Options& options) {
  line.describe(
      "Compares two HDF5 files: objects, types, shapes, attributes, and every number, the same where\n"
      "|a - b| <= A + R max(|a|, |b|). Status 0: the same; 1: different, and standard output says where.",
      "pigment-compare solids.h5 reference.h5 --relative 1e-10 --tolerance /solids/time=0,1e-12");
  line.positional("first", options.first, "an HDF5 file");
  line.positional("second", options.second, "the file to compare it with");
  line.option("--relative", options.relative, "R, where no other tolerance is given (default 0)");
  line.option("--absolute", options.absolute,
              "A, in the stored unit, where no other tolerance is given (default 0)");
  line.option("--tolerance", options.tolerance,
              "PATH=R,A: tolerance of a dataset, or of all below a group; repeatable");
  line.option("--tolerances", options.tolerances,
              "a file with lines \"path relative absolute\", # for comments");
  line.option("--ignore", options.ignore,
              "leave out an object and all below it, or OBJECT@ATTRIBUTE; repeatable");
  line.flag("--ignore-version", options.ignore_version, "leave out which version of pigment wrote the files");
  line.flag("--nan-equal", options.nan_equal, "not-a-number in both files is the same");
  line.output_required(false, "a text file for what differs, instead of standard output");
}

double number(const std::string& text, const std::string& where) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(value) || value < 0)
    throw InputError(fmt::format("{}: \"{}\" is not a tolerance; write a number, 0 or more", where, text));
  return value;
}

// "/solids/" and "solids" mean "/solids".
std::string object_path(std::string path) {
  if (path.empty() || path.front() != '/') path.insert(0, "/");
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

io::CompareOptions compare_options(const Options& options) {
  io::CompareOptions out;
  for (const auto& [flag, value] :
       {std::pair{"--relative", options.relative}, {"--absolute", options.absolute}})
    if (!(value >= 0))
      throw InputError(fmt::format("{}: {} is not a tolerance; write a number, 0 or more", flag, value));
  out.tolerance = {options.relative, options.absolute};
  out.nan_equal = options.nan_equal;
  for (const auto& path : options.ignore) out.ignore.push_back(object_path(path));
  if (options.ignore_version) {
    out.ignore.emplace_back("/provenance@version");
    out.ignore.emplace_back("/h5md/creator@version");
  }
  if (!options.tolerances.empty()) {
    std::ifstream file(options.tolerances);
    if (!file) throw FileError(fmt::format("{}: cannot be read", options.tolerances.string()));
    std::string text;
    for (int line = 1; std::getline(file, text); ++line) {
      std::istringstream words(text.substr(0, text.find('#')));
      std::string path, relative, absolute, more;
      if (!(words >> path)) continue;
      const std::string where = fmt::format("{}:{}", options.tolerances.string(), line);
      if (!(words >> relative >> absolute) || words >> more)
        throw FileError(
            fmt::format("{}: \"{}\": expected a path and two numbers, relative and absolute", where, text));
      try {
        out.by_path[object_path(path)] = {number(relative, where), number(absolute, where)};
      } catch (const InputError& e) {
        throw FileError(e.what());
      }
    }
  }
  for (const auto& text : options.tolerance) {
    const auto equals = text.rfind('='), comma = text.rfind(',');
    if (equals == std::string::npos || comma == std::string::npos || comma < equals || equals == 0)
      throw InputError(fmt::format("--tolerance: \"{}\"; write e.g. /solids/time=1e-10,0", text));
    out.by_path[object_path(text.substr(0, equals))] = {
        number(text.substr(equals + 1, comma - equals - 1), "--tolerance"),
        number(text.substr(comma + 1), "--tolerance")};
  }
  return out;
}

void run(const Options& options, const std::filesystem::path& output) {
  const auto comparison = io::compare_files(options.first, options.second, compare_options(options));
  std::string report;
  const auto& lines = comparison.differences;
  const std::size_t shown = lines.size() <= most_lines ? lines.size() : most_lines - 1;
  for (std::size_t i = 0; i < shown; ++i) report += lines[i] + "\n";
  if (shown < lines.size()) report += fmt::format("and {} more\n", lines.size() - shown);
  if (output.empty()) {
    std::cout << report;
  } else {
    std::ofstream file(output);
    if (!(file << report << std::flush))
      throw OutputError(fmt::format("{}: cannot be written", output.string()));
  }
  if (!comparison.same())
    throw Error(1, fmt::format("{} and {} differ", options.first.string(), options.second.string()));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return app::run_tool(
      "compare", argc, argv, [&](app::CommandLine& line) { declare(line, options); },
      [&](app::CommandLine& line) { run(options, line.common.output); });
}
