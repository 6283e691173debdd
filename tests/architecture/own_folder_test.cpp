// Tests run side by side, and several suites may run on one machine: each process writes in its own folder (support/main.cpp).
#include <gtest/gtest.h>

#include "architecture/source_tree.h"

namespace pigment::architecture {
namespace {

TEST(OwnFolder, NoTestNamesAFolderThatItSharesWithOthers) {
  const std::vector<std::string> shared = {std::string("Temp") + "Dir()", "temp_directory" "_path", "\"/t" "mp", "\"/var/t" "mp"};
  ASSERT_FALSE(sources_below("tests").empty());
  for (const fs::path& file : sources_below("tests"))
    for (const std::string& name : shared)
      EXPECT_EQ(text_of(file).find(name), std::string::npos) << path_in_tree(file) << " has " << name;
}

}  // namespace
}  // namespace pigment::architecture
