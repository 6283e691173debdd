#pragma once
// What a study decided and drew: its claims (CSV) and its figures (SVG or PNG). Those of one folder belong together; figures
// may stand in its subfolder `figures`.
#include <filesystem>
#include <string>
#include <vector>

namespace pigment::report {

// One row of claims.csv. verdict: reproduced, not reproduced, not decidable, follows from the input.
struct Claim {
  std::string study, section, claim, source, ours, decided_by, verdict;
};

struct StudyFigure {
  std::filesystem::path path;
  std::string caption;   // an SVG's <title>, else the file's stem
  std::string data_uri;  // "data:image/svg+xml;base64,..."
  bool wide = false;     // several panels side by side: takes the page's whole width
};

struct StudyFiles {
  std::string name;  // as the claims have it, else that of the folder
  std::vector<Claim> claims;
  std::vector<StudyFigure> figures;
};

// Reads a claims.csv: fields as RFC 4180 has them (quotes around commas, line ends, doubled quotes). Throws FileError, with
// the line, for another header, a row of the wrong length, a quote that is not closed, or an unknown verdict.
std::vector<Claim> read_claims(const std::filesystem::path&);

// One entry a folder, in the order in which they are first named. Throws FileError for what cannot be used.
std::vector<StudyFiles> gather_studies(const std::vector<std::filesystem::path>& claims,
                                       const std::vector<std::filesystem::path>& figures);

}  // namespace pigment::report
