// What the documents say of the program: every key of a scene has its line in docs/scenes.md, every
// tool its name in README.md, every link its file.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "architecture/source_tree.h"

namespace pigment::architecture {
namespace {

// node.quantity("thickness", ...), node.choice<Model>("model", ...), root.block("layer"), ...
std::set<std::string> keys_read_in(const std::string& text) {
  static const std::regex call(
      R"re(\b\w+(?:\.|->)(?:optional_)?(?:quantity|quantities|number|integer|boolean|text|choice|file|block|blocks)(?:<[^>]*>)?\(\s*"(\w+)")re");
  std::set<std::string> keys;
  for (std::sregex_iterator it(text.begin(), text.end(), call), end; it != end; ++it) keys.insert((*it)[1]);
  return keys;
}

TEST(Documents, EveryKeyOfASceneIsExplained) {
  const std::string page = text_of(source_root() / "docs/scenes.md");
  ASSERT_FALSE(page.empty());
  std::set<std::string> keys;
  for (const fs::path& file : sources_below("lib"))
    for (const std::string& key : keys_read_in(text_of(file))) {
      keys.insert(key);
      EXPECT_TRUE(std::regex_search(page, std::regex("\\b" + key + "\\b"))) << path_in_tree(file) << " reads \"" << key << "\"";
    }
  EXPECT_TRUE(keys.contains("thickness") && keys.contains("strategy") && keys.contains("layer")) << "calls are not recognised";
}

TEST(Documents, ReadmeNamesEveryTool) {
  const std::string readme = text_of(source_root() / "README.md");
  for (const fs::path& file : sources_below("tools"))
    EXPECT_NE(readme.find("`pigment-" + file.stem().string() + "`"), std::string::npos) << path_in_tree(file);
}

TEST(Documents, LinksLeadSomewhere) {
  static const std::regex link(R"(\]\(([^)#:]+)(?:#[^)]*)?\))");
  std::vector<fs::path> pages = {source_root() / "README.md", source_root() / "lib/README.md"};
  for (const char* folder : {"docs", "workflows"})
    if (fs::exists(source_root() / folder))
      for (const auto& entry : fs::recursive_directory_iterator(source_root() / folder))
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
  for (const fs::path& page : pages) {
    const std::string text = text_of(page);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it)
      EXPECT_TRUE(fs::exists(page.parent_path() / (*it)[1].str())) << path_in_tree(page) << " links to " << (*it)[1];
  }
}

}  // namespace
}  // namespace pigment::architecture
