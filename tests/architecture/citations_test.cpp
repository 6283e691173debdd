// Citations: a [key] in a comment or a document has its entry in data/references.bib, and the entries are sound.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "architecture/source_tree.h"

namespace pigment::architecture {
namespace {

// [sand2010], [patek2009a]; several in one pair of brackets are set apart by semicolons or commas: [a2001; b2002].
std::set<std::string> citations_in(const std::string& text) {
  static const std::regex group(R"(\[([a-z_]+[12][0-9]{3}[a-z]?(?:\s*[;,]\s*[a-z_]+[12][0-9]{3}[a-z]?)*)\])");
  static const std::regex key(R"([a-z_]+[12][0-9]{3}[a-z]?)");
  std::set<std::string> keys;
  for (std::sregex_iterator g(text.begin(), text.end(), group), end; g != end; ++g) {
    const std::string inside = (*g)[1];
    for (std::sregex_iterator k(inside.begin(), inside.end(), key); k != end; ++k) keys.insert(k->str());
  }
  return keys;
}

struct Entry {
  std::string type, body;
};

// Entries of the BibTeX file by key; a brace that does not close or a key that stands twice is reported.
std::map<std::string, Entry> bibliography() {
  const std::string text = text_of(source_root() / "data/references.bib");
  std::map<std::string, Entry> entries;
  for (std::size_t at = text.find('@'); at != std::string::npos;) {
    const std::size_t open = text.find('{', at), comma = text.find(',', at);
    if (open == std::string::npos || comma == std::string::npos || comma < open) {
      ADD_FAILURE() << "data/references.bib: no entry at \"" << text.substr(at, 40) << "\"";
      break;
    }
    int depth = 1;
    std::size_t close = open + 1;
    for (; close < text.size() && depth > 0; ++close) depth += (text[close] == '{') - (text[close] == '}');
    const std::string key = text.substr(open + 1, comma - open - 1);
    EXPECT_EQ(depth, 0) << "data/references.bib: braces of " << key << " do not close";
    EXPECT_TRUE(entries.emplace(key, Entry{text.substr(at + 1, open - at - 1), text.substr(comma, close - comma)}).second)
        << "data/references.bib: " << key << " stands twice";
    at = text.find('@', close);
  }
  return entries;
}

TEST(Citations, EachKeyHasItsEntry) {
  const auto entries = bibliography();
  std::size_t found = 0;
  auto check = [&](const fs::path& file) {
    for (const std::string& key : citations_in(text_of(file))) {
      ++found;
      EXPECT_TRUE(entries.contains(key)) << path_in_tree(file) << " cites [" << key << "], which data/references.bib lacks";
    }
  };
  for (const char* folder : {"lib", "tools", "tests/lib", "tests/physics", "tests/support"})
    for (const fs::path& file : sources_below(folder)) check(file);
  for (const char* folder : {"docs", "workflows", "lib", "data"})
    if (fs::exists(source_root() / folder))
      for (const auto& entry : fs::recursive_directory_iterator(source_root() / folder))
        if (entry.path().extension() == ".md") check(entry.path());
  check(source_root() / "README.md");
  EXPECT_GT(found, 0u) << "no citation was recognised";
}

TEST(Citations, EntriesAreSound) {
  const std::map<std::string, std::vector<std::string>> required = {
      {"article", {"author", "title", "journal", "year"}},
      {"book", {"author", "title", "publisher", "year"}},
      {"phdthesis", {"author", "title", "school", "year"}},
      {"inproceedings", {"author", "title", "booktitle", "year"}},
      {"incollection", {"author", "title", "booktitle", "year"}},
      {"techreport", {"author", "title", "institution", "year"}},
      {"misc", {"title", "year"}},
  };
  for (const auto& [key, entry] : bibliography()) {
    ASSERT_TRUE(required.contains(entry.type)) << key << ": @" << entry.type;
    for (const std::string& field : required.at(entry.type))
      EXPECT_TRUE(std::regex_search(entry.body, std::regex("[,\\s]" + field + "\\s*="))) << key << " has no " << field;
  }
}

TEST(Citations, KeysAreRecognised) {
  EXPECT_EQ(citations_in("Eq. (3) [sand2010], x[i], [3], a [jeffrey1984; patek2009a] [N]"),
            (std::set<std::string>{"sand2010", "jeffrey1984", "patek2009a"}));
}

}  // namespace
}  // namespace pigment::architecture
