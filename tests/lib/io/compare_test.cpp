#include "io/compare.h"

#include <cmath>
#include <limits>

#include "io/h5.h"
#include "lib/io/io_test_support.h"

namespace pigment::io {
namespace {

using namespace test;
namespace fs = std::filesystem;

fs::path write(const fs::path& name, const std::function<void(h5::OutputFile&)>& content) {
  h5::OutputFile file(name);
  content(file);
  file.commit();
  return name;
}
fs::path write_numbers(const fs::path& name, const std::vector<double>& values) {
  return write(name,
               [&](h5::OutputFile& file) { file.write("/group/values", {values.size()}, values.data()); });
}
std::vector<std::string> differences(const fs::path& a, const fs::path& b,
                                     const CompareOptions& options = {}) {
  return compare_files(a, b, options).differences;
}

TEST(Compare, SeesNumbersOfAnySize) {
  const fs::path folder = fresh_folder();
  const fs::path a = write_numbers(folder / "a.h5", {1, 1e-21}),
                 b = write_numbers(folder / "b.h5", {1, 2e-21});
  EXPECT_TRUE(differences(a, a).empty());
  const auto found = differences(a, b, {{0.4, 0}, {}, {}, false});
  ASSERT_EQ(found.size(), 1u);
  expect_contains(found[0], "/group/values [1]: 1e-21 against 2e-21, difference 1e-21");
  expect_contains(found[0], "1 of 2 values differ");
  // |a - b| = 1e-21, max = 2e-21: 0.5 is just enough.
  EXPECT_TRUE(differences(a, b, {{0.5, 0}, {}, {}, false}).empty());
  EXPECT_TRUE(differences(a, b, {{0, 1e-20}, {}, {}, false}).empty());
}

TEST(Compare, TheLongestPathSetsTheTolerance) {
  const fs::path folder = fresh_folder();
  const fs::path a = write_numbers(folder / "a.h5", {1}), b = write_numbers(folder / "b.h5", {1.01});
  EXPECT_TRUE(differences(a, b, {{}, {{"/group", {0.1, 0}}}, {}, false}).empty());
  EXPECT_FALSE(
      differences(a, b, {{1, 0}, {{"/group", {0.1, 0}}, {"/group/values", {0, 0}}}, {}, false}).empty());
  EXPECT_TRUE(differences(a, b, {{}, {{"/", {0.1, 0}}}, {}, false}).empty());
  EXPECT_THROW(differences(a, b, {{}, {{"/grop", {0.1, 0}}}, {}, false}), InputError);
}

TEST(Compare, NamesTheLargestDifference) {
  const fs::path folder = fresh_folder();
  std::vector<double> values(600, 1.0);
  const auto save = [&](const char* name) {
    return write(folder / name, [&](h5::OutputFile& f) { f.write("/x", {20, 30}, values.data()); });
  };
  const fs::path a = save("a.h5");
  values[31] = 1.5;
  values[20 * 30 - 1] = -4;
  const auto found = differences(a, save("b.h5"));
  ASSERT_EQ(found.size(), 1u);
  expect_contains(found[0], "/x [19, 29]: 1 against -4, difference 5, allowed 0; 2 of 600 values differ");
}

TEST(Compare, WhatIsNotANumberIsNeverTheSameUnlessAsked) {
  const fs::path folder = fresh_folder();
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const fs::path a = write_numbers(folder / "a.h5", {nan, infinite}),
                 b = write_numbers(folder / "b.h5", {1, infinite});
  CompareOptions options;
  options.tolerance = {1e300, 1e300};
  EXPECT_FALSE(differences(a, a, options).empty());
  options.nan_equal = true;
  EXPECT_TRUE(differences(a, a, options).empty());
  EXPECT_FALSE(differences(a, b, options).empty());
  EXPECT_FALSE(differences(b, write_numbers(folder / "c.h5", {1, 1}), options).empty());
}

TEST(Compare, SeesShapesTypesObjectsAttributesAndText) {
  const fs::path folder = fresh_folder();
  const double one[] = {1, 1};
  const std::int64_t whole[] = {1, 1};
  const fs::path a = write(folder / "a.h5", [&](h5::OutputFile& f) {
    f.write("/shape", {2, 1}, one);
    f.write("/type", {2}, one);
    f.write("/only_a", {2}, one);
    f.write("/text", std::string("first line\nsecond line"));
    f.group("/group");
    f.attribute("/group", "unit", std::string("m"));
    f.attribute("/group", "number", 1.0);
    f.attribute("/group", "lost", 1.0);
    f.attribute("/group", "other", std::string("1"));
  });
  const fs::path b = write(folder / "b.h5", [&](h5::OutputFile& f) {
    f.write("/shape", {1, 2}, one);
    f.write("/type", {2}, whole);
    f.write("/only_b/deep", {2}, one);
    f.write("/text", std::string("first line\nsecond word"));
    f.group("/group");
    f.attribute("/group", "unit", std::string("s"));
    f.attribute("/group", "number", 2.0);
    f.attribute("/group", "other", std::int64_t{1});
  });
  const auto found = differences(a, b);
  EXPECT_EQ(found, (std::vector<std::string>{
                       "/group@lost: only in the first file",
                       "/group@number: 1 against 2, difference 1, allowed 0; 1 of 1 values differ",
                       "/group@other: text against integers",
                       "/group@unit: \"m\" against \"s\"",
                       "/only_a: only in the first file",
                       "/only_b: only in the second file",
                       "/shape: shape [2, 1] against [1, 2]",
                       "/text: \"second line\" against \"second word\"; 1 of 1 texts differ",
                       "/type: floats against integers",
                   }));
  CompareOptions options;
  options.ignore = {"/group", "/only_a", "/only_b", "/shape", "/text", "/type"};
  EXPECT_TRUE(differences(a, b, options).empty());
  options.ignore = {"/group@lost", "/group@number", "/group@other", "/only_a",
                    "/only_b",     "/shape",        "/text",        "/type"};
  EXPECT_EQ(differences(a, b, options), std::vector<std::string>{"/group@unit: \"m\" against \"s\""});
}

TEST(Compare, WholeNumbersAreExactBeyondWhatDoublesHold) {
  const fs::path folder = fresh_folder();
  const auto save = [&](const char* name, std::int64_t value) {
    return write(folder / name, [&](h5::OutputFile& f) { f.write("/id", {1}, &value); });
  };
  const std::int64_t large = std::int64_t{1} << 60;
  EXPECT_FALSE(differences(save("a.h5", large), save("b.h5", large + 1)).empty());
  EXPECT_TRUE(differences(save("a.h5", large), save("b.h5", large + 1), {{1e-10, 0}, {}, {}, false}).empty());
}

TEST(Compare, RefusesWhatItCannotRead) {
  const fs::path folder = fresh_folder(), a = write_numbers(folder / "a.h5", {1});
  put_bytes(folder / "cut.h5", bytes_of(a).substr(0, 500));
  EXPECT_THROW(differences(a, folder / "cut.h5"), FileError);
  EXPECT_THROW(differences(folder / "absent.h5", a), FileError);
}

}  // namespace
}  // namespace pigment::io
