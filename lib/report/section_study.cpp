// What a study decided (its claims) and drew (its figures).
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "report/sections.h"

namespace pigment::report {
namespace {

std::string count_of(const std::vector<Claim>& claims) {
  std::map<std::string, int> counts;
  for (const Claim& claim : claims) ++counts[claim.verdict];
  std::string text;
  for (const char* verdict : {"reproduced", "not reproduced", "not decidable", "follows from the input"})
    if (counts[verdict] > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[verdict], verdict);
  return text;
}

}  // namespace

void add_study(HtmlReport& page, const StudyFiles& study) {
  if (!study.claims.empty()) {
    page.section("Claims", fmt::format("Of {} claims: {}.", study.claims.size(), count_of(study.claims)));
    std::vector<std::vector<std::string>> rows;
    for (const Claim& c : study.claims)
      rows.push_back({c.verdict, c.section, c.claim, c.source, c.ours, c.decided_by});
    page.table({"Verdict", "Section", "Claim", "The source", "Ours", "Decided by"}, rows, TableStyle::VerdictFirst);
  }
  if (!study.figures.empty()) {
    page.section("Figures");
    page.figures(study.figures);
  }
}

}  // namespace pigment::report
