// main of every test program: each process works in a folder of its own, so that tests that write files can run side by
// side. The folder is removed when they pass, and named when they fail.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  testing::InitGoogleTest(&argc, argv);
  const fs::path home = fs::current_path(), folder = home / ("run-" + std::to_string(getpid()));
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
  fs::remove_all(folder);
  fs::create_directories(folder);
  fs::current_path(folder);
  const int status = RUN_ALL_TESTS();
  fs::current_path(home);
  if (status == 0)
    fs::remove_all(folder);
  else
    std::cerr << "files of the failed tests, if any: " << folder.string() << "\n";
  return status;
}
