#include <fmt/format.h>

#include <cctype>
#include <set>

#include "base/error.h"
#include "report/html_report.h"
#include "report/whole_file.h"

namespace pigment::report {
namespace {

// "Solids over the height, by weight" -> "solids-over-the-height-by-weight"
std::string file_words(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto letter = static_cast<unsigned char>(c);
    if (letter < 128 && std::isalnum(letter))
      out += static_cast<char>(std::tolower(letter));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out;
}

}  // namespace

void write_plots(const std::filesystem::path& folder, const std::vector<DrawnPlot>& plots) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw OutputError(fmt::format("{}: cannot be made: {}", folder.string(), failure.message()));
  std::set<std::string> taken;
  for (const DrawnPlot& p : plots) {
    std::string name;
    for (const std::string& part : {p.chapter, p.section, p.plot.title})
      if (const std::string words = file_words(part); !words.empty()) name += (name.empty() ? "" : "_") + words;
    std::string free = name;
    for (int copy = 2; !taken.insert(free).second; ++copy) free = fmt::format("{}-{}", name, copy);
    write_whole_file(folder / (free + ".svg"), plot_file(p.plot));
  }
}

}  // namespace pigment::report
