// Rooms and doors: who may include what. The rows stand in lib/README.md, the doors in lib/CMakeLists.txt.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "architecture/source_tree.h"

namespace pigment::architecture {
namespace {

// Outside libraries by the beginning of their headers' names, and the rooms that may include them. `sources_only`: in
// .cpp files, so that nothing of it shows in a public header.
struct Door {
  const char* header;
  std::set<std::string> rooms;
  bool sources_only;
};
const std::vector<Door> doors = {
    {"CLI/", {"app"}, true},
    {"yaml-cpp/", {"config"}, false},
    {"hdf5", {"io"}, false},
    {"H5", {"io"}, false},
    {"openssl/", {"io"}, true},
    {"amd", {"solve"}, false},
    {"suitesparse/", {"solve"}, false},
    {"Random123/", {"base"}, true},
    {"udunits2", {"base"}, true},
    {"gsl/", {"model", "forces", "packing", "analysis"}, true},
    {"voro++/", {"analysis"}, true},
    {"png", {"report"}, true},
    {"zlib", {"report"}, true},
};

// Standard headers have no dot and no slash (<vector>, <cmath>); these are free beside them.
bool is_free_everywhere(const std::string& name) {
  return name.find_first_of("./") == std::string::npos || name.starts_with("Eigen/") || name == "omp.h";
}
// POSIX and the C library, in .cpp files, and fmt in .cpp files.
bool is_free_in_sources(const std::string& name) {
  static const std::set<std::string> posix = {"malloc.h", "unistd.h", "fcntl.h", "signal.h", "sys/stat.h", "sys/types.h", "sys/file.h"};
  return name.starts_with("fmt/") || posix.contains(name);
}

TEST(Layers, EveryRoomHasItsRow) {
  const auto rows = rows_of_rooms();
  ASSERT_FALSE(rows.empty()) << "lib/README.md has no table of rows";
  for (const auto& entry : fs::directory_iterator(source_root() / "lib"))
    if (entry.is_directory()) {
      EXPECT_TRUE(rows.contains(entry.path().filename())) << entry.path() << " is in no row of lib/README.md";
    }
}

TEST(Layers, RoomsIncludeThemselvesAndLowerRowsOnly) {
  const auto rows = rows_of_rooms();
  int checked = 0;
  for (const fs::path& file : sources_below("lib"))
    for (const Include& include : includes_of(file)) {
      if (!include.quoted) continue;
      const std::string here = room_of(file), there = include.name.substr(0, include.name.find('/'));
      ASSERT_TRUE(rows.contains(here)) << path_in_tree(file);
      if (here == there) continue;
      ++checked;
      ASSERT_TRUE(rows.contains(there)) << path_in_tree(file) << " includes \"" << include.name << "\", which is in no room";
      EXPECT_LT(rows.at(there), rows.at(here))
          << path_in_tree(file) << " (row " << rows.at(here) << ") includes " << include.name << " (row " << rows.at(there) << ")";
    }
  EXPECT_GT(checked, 0) << "no include line was recognised";
}

TEST(Layers, IncludedProjectFilesExist) {
  for (const char* folder : {"lib", "tools"})
    for (const fs::path& file : sources_below(folder))
      for (const Include& include : includes_of(file))
        if (include.quoted && include.name != "base/version.h") {  // made by CMake
          EXPECT_TRUE(fs::exists(source_root() / "lib" / include.name)) << path_in_tree(file) << ": " << include.name;
        }
}

TEST(Layers, EachOutsideLibraryHasItsDoor) {
  for (const fs::path& file : sources_below("lib"))
    for (const Include& include : includes_of(file)) {
      if (include.quoted || is_free_everywhere(include.name)) continue;
      const bool is_header = file.extension() == ".h";
      const auto door = std::find_if(doors.begin(), doors.end(),
                                     [&](const Door& d) { return include.name.starts_with(d.header); });
      if (door == doors.end()) {
        EXPECT_TRUE(!is_header && is_free_in_sources(include.name))
            << path_in_tree(file) << " includes <" << include.name << ">, for which there is no door here";
        continue;
      }
      EXPECT_TRUE(door->rooms.contains(room_of(file))) << path_in_tree(file) << " includes <" << include.name << ">";
      if (door->sources_only) {
        EXPECT_FALSE(is_header) << path_in_tree(file) << " shows <" << include.name << "> in a header";
      }
    }
}

TEST(Layers, ToolsSeeRoomsAndTheStandardLibraryOnly) {
  for (const fs::path& file : sources_below("tools"))
    for (const Include& include : includes_of(file))
      if (!include.quoted) {
        EXPECT_TRUE(is_free_everywhere(include.name) || include.name.starts_with("fmt/"))
            << path_in_tree(file) << " includes <" << include.name << ">";
      }
}

// A header seen from another room must not drag an outside library along: doors that are open to headers (HDF5, yaml-cpp, AMD)
// are for the room's own internal headers.
TEST(Layers, NoRoomShowsAnOutsideLibraryToAnother) {
  for (const fs::path& file : sources_below("lib"))
    for (const Include& include : includes_of(file)) {
      if (!include.quoted || include.name.starts_with(room_of(file) + "/")) continue;
      const fs::path seen = source_root() / "lib" / include.name;
      if (!fs::exists(seen)) continue;
      for (const Include& inner : includes_of(seen))
        if (!inner.quoted) {
          EXPECT_TRUE(is_free_everywhere(inner.name))
              << path_in_tree(file) << " sees <" << inner.name << "> through " << include.name;
        }
    }
}

// pigment_room(NAME USES a b DOORS c) in lib/CMakeLists.txt keeps to the rows too.
TEST(Layers, CMakeLinksRoomsAlongTheRows) {
  const auto rows = rows_of_rooms();
  const std::string text = text_of(source_root() / "lib/CMakeLists.txt");
  const std::regex call(R"(pigment_room\((\w+)\s*(?:USES\s+([\w\s]*?))?\s*(?:DOORS\s+([^)]*))?\))"), word(R"(\w+)");
  std::set<std::string> declared;
  for (std::sregex_iterator it(text.begin(), text.end(), call), end; it != end; ++it) {
    const std::string room = (*it)[1], uses = (*it)[2];
    declared.insert(room);
    ASSERT_TRUE(rows.contains(room)) << room;
    for (std::sregex_iterator u(uses.begin(), uses.end(), word); u != end; ++u) {
      ASSERT_TRUE(rows.contains(u->str())) << room << " uses " << u->str();
      EXPECT_LT(rows.at(u->str()), rows.at(room)) << room << " uses " << u->str();
    }
  }
  for (const auto& [room, row] : rows) EXPECT_TRUE(declared.contains(room)) << "lib/CMakeLists.txt does not build " << room;
}

}  // namespace
}  // namespace pigment::architecture
