#include "report/study_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>

#include "base/error.h"
#include "report/base64.h"

namespace pigment::report {
namespace {

namespace fs = std::filesystem;

constexpr std::array columns{"study", "section", "claim", "source", "ours", "decided_by", "verdict"};
constexpr std::array verdicts{"reproduced", "not reproduced", "not decidable", "follows from the input"};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path)) throw FileError(path.string() + ": cannot be read");
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw FileError(path.string() + ": cannot be read");
  return bytes;
}

struct Row {
  int line = 0;  // at which it begins, counted from 1
  std::vector<std::string> fields;
};

std::vector<Row> rows_of_csv(const fs::path& path) {
  const std::string text = bytes_of(path);
  std::vector<Row> rows;
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    Row row{line, {""}};
    bool quoted = false;
    for (; at < text.size(); ++at) {
      const char c = text[at];
      if (c == '\n') ++line;
      if (quoted) {
        if (c != '"') row.fields.back() += c;
        else if (at + 1 < text.size() && text[at + 1] == '"') row.fields.back() += text[++at];
        else quoted = false;
      } else if (c == '"') {
        quoted = true;
      } else if (c == ',') {
        row.fields.emplace_back();
      } else if (c == '\n') {
        ++at;
        break;
      } else if (c != '\r') {
        row.fields.back() += c;
      }
    }
    if (quoted) throw FileError(fmt::format("{}:{}: a quote that opens here is not closed", path.string(), row.line));
    if (row.fields.size() > 1 || !row.fields[0].empty()) rows.push_back(std::move(row));
  }
  return rows;
}

// The text between <title> and </title>; captions are plain text there, with the entities of XML.
std::string svg_title(const std::string& svg) {
  const auto begin = svg.find("<title>");
  const auto end = svg.find("</title>");
  if (begin == std::string::npos || end == std::string::npos || end < begin) return {};
  std::string title = svg.substr(begin + 7, end - begin - 7);
  for (const auto& [entity, character] :
       {std::pair{"&lt;", "<"}, std::pair{"&gt;", ">"}, std::pair{"&quot;", "\""}, std::pair{"&amp;", "&"}})
    for (std::size_t at = 0; (at = title.find(entity, at)) != std::string::npos; ++at)
      title.replace(at, std::string(entity).size(), character);
  return title;
}

// Width over height by an SVG's viewBox or a PNG's header; 1 where it is not there.
double aspect_of(const std::string& bytes) {
  double width = 0, height = 0;
  if (const auto at = bytes.find("viewBox=\"0 0 "); at != std::string::npos) {
    std::istringstream(bytes.substr(at + 13, 60)) >> width >> height;
  } else if (bytes.starts_with("\x89PNG") && bytes.size() > 24) {
    const auto number = [&](std::size_t begin) {
      double value = 0;
      for (std::size_t i = begin; i < begin + 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes[i]);
      return value;
    };
    width = number(16);
    height = number(20);
  }
  return width > 0 && height > 0 ? width / height : 1;
}

StudyFigure read_figure(const fs::path& path) {
  const std::string bytes = bytes_of(path);
  const bool wide = aspect_of(bytes) > 1.4;
  if (bytes.starts_with("\x89PNG"))
    return {path, path.stem().string(), "data:image/png;base64," + base64(bytes), wide};
  if (bytes.find("<svg") == std::string::npos || bytes.find("</svg>") == std::string::npos)
    throw FileError(path.string() + ": is neither a whole SVG nor a PNG file");
  const std::string title = svg_title(bytes);
  return {path, title.empty() ? path.stem().string() : title, "data:image/svg+xml;base64," + base64(bytes), wide};
}

fs::path folder_of(const fs::path& path) {
  const fs::path folder = fs::weakly_canonical(fs::absolute(path)).parent_path();
  return folder.filename() == "figures" ? folder.parent_path() : folder;
}

}  // namespace

std::vector<Claim> read_claims(const fs::path& path) {
  std::vector<Row> rows = rows_of_csv(path);
  const std::string header = fmt::format("{}", fmt::join(columns, ","));
  if (rows.empty() || fmt::format("{}", fmt::join(rows[0].fields, ",")) != header)
    throw FileError(fmt::format("{}:1: is no table of claims; expected the header \"{}\"", path.string(), header));
  std::vector<Claim> claims;
  for (auto row = rows.begin() + 1; row != rows.end(); ++row) {
    auto& f = row->fields;
    if (f.size() != columns.size())
      throw FileError(
          fmt::format("{}:{}: has {} fields, expected {}", path.string(), row->line, f.size(), columns.size()));
    if (std::find(verdicts.begin(), verdicts.end(), f[6]) == verdicts.end())
      throw FileError(fmt::format("{}:{}: verdict \"{}\" is none of: {}", path.string(), row->line, f[6],
                                  fmt::join(verdicts, ", ")));
    claims.push_back({f[0], f[1], f[2], f[3], f[4], f[5], f[6]});
  }
  return claims;
}

std::vector<StudyFiles> gather_studies(const std::vector<fs::path>& claims, const std::vector<fs::path>& figures) {
  std::vector<StudyFiles> studies;
  std::vector<fs::path> folders;
  const auto of = [&](const fs::path& path) -> StudyFiles& {
    const fs::path folder = folder_of(path);
    const auto found = std::find(folders.begin(), folders.end(), folder);
    if (found != folders.end()) return studies[static_cast<std::size_t>(found - folders.begin())];
    folders.push_back(folder);
    return studies.emplace_back(StudyFiles{folder.filename().string(), {}, {}});
  };
  for (const fs::path& path : claims) {
    StudyFiles& study = of(path);
    for (Claim& claim : read_claims(path)) study.claims.push_back(std::move(claim));
    if (!study.claims.empty()) study.name = study.claims.front().study;
  }
  for (const fs::path& path : figures) of(path).figures.push_back(read_figure(path));
  return studies;
}

}  // namespace pigment::report
