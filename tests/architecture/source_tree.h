#pragma once
// The source tree as the architecture tests see it: files, their #include lines, their comments.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace pigment::architecture {

namespace fs = std::filesystem;

inline fs::path source_root() { return PIGMENT_SOURCE_DIR; }

inline std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// The C++ files below a folder of the tree ("lib"), sorted; a folder that is not there has none.
inline std::vector<fs::path> sources_below(const std::string& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(source_root() / folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(source_root() / folder))
    if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

inline std::string path_in_tree(const fs::path& file) { return fs::relative(file, source_root()).string(); }

struct Include {
  std::string name;  // as between the quotes or angle brackets
  bool quoted;
};

inline std::vector<Include> includes_of(const fs::path& file) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
  std::vector<Include> found;
  std::istringstream lines(text_of(file));
  std::smatch match;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_search(line, match, pattern)) found.push_back({match[2], match[1] == "\""});
  return found;
}

// The room of a file below lib/ ("lib/io/x.h" -> "io").
inline std::string room_of(const fs::path& file) {
  return (++fs::relative(file, source_root()).begin())->string();
}

// Room -> row, from the table in lib/README.md, whose lines read "| 2 | model (cell, ...), solve (...) |".
inline std::map<std::string, int> rows_of_rooms() {
  std::map<std::string, int> rows;
  std::istringstream lines(text_of(source_root() / "lib/README.md"));
  const std::regex pattern(R"(^\|\s*(\d+)\s*\|(.*)\|\s*$)"), remark(R"(\([^)]*\))"), word(R"([a-z_]+)");
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_match(line, match, pattern)) continue;
    const std::string rooms = std::regex_replace(match[2].str(), remark, "");
    for (std::sregex_iterator it(rooms.begin(), rooms.end(), word), end; it != end; ++it)
      rows[it->str()] = std::stoi(match[1]);
  }
  return rows;
}

}  // namespace pigment::architecture
