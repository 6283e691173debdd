#include "io/result_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/h5.h"
#include "lib/io/io_test_support.h"

namespace pigment::io {
namespace {

namespace fs = std::filesystem;

using namespace test;

fs::path fresh(const std::string& name) { return fresh_folder() / name; }

ResultFile example() {
  ResultFile result;
  result.kind = "solids";
  result.datasets = {
      {"/solids/time", {3}, {0, 0.5, 1e3}, Dimension::Time, Dataset::Storage::Float64},
      {"/solids/volume_fraction",
       {3, 2},
       {0.1, 0.2, 0.3, 0.4, 0.5, 0.6},
       Dimension::VolumeFraction,
       Dataset::Storage::Float64},
      {"/solids/classes/mass", {1}, {1e-9}, Dimension::Mass, Dataset::Storage::Float64},
      {"/solids/count", {2}, {7, 123456789}, Dimension::Number, Dataset::Storage::Int64},
      {"/solids/pressure", {}, {101325}, Dimension::Pressure, Dataset::Storage::Float32},
      {"/solids/nothing", {0, 4}, {}, Dimension::Length, Dataset::Storage::Float64},
  };
  result.attributes = {{"outcome", "until"}};
  result.numbers = {{"scale", 1.25}};
  result.provenance = {"pigment-solids", "analysis:\n  slices: 30\n", {{"trajectory", std::string(64, 'a')}}};
  return result;
}

TEST(ResultFile, ComesBackAsItWasWritten) {
  const fs::path file = fresh("a.h5");
  const ResultFile written = example();
  write_result(file, written);
  const ResultFile read =
      read_result(file, "solids", {{"/solids/volume_fraction", Dimension::VolumeFraction}});
  ASSERT_EQ(read.datasets.size(), written.datasets.size());
  for (const auto& dataset : written.datasets) {
    const Dataset& back = read.require(dataset.path);
    EXPECT_EQ(back.shape, dataset.shape) << dataset.path;
    EXPECT_EQ(back.dimension, dataset.dimension) << dataset.path;
    EXPECT_EQ(back.storage, dataset.storage) << dataset.path;
    for (std::size_t i = 0; i < dataset.values.size(); ++i)  // to SI and back: one rounding each
      EXPECT_DOUBLE_EQ(back.values[i], dataset.values[i]) << dataset.path;
  }
  EXPECT_EQ(read.attributes, written.attributes);
  EXPECT_EQ(read.numbers, written.numbers);
  EXPECT_EQ(read.provenance.tool, written.provenance.tool);
  EXPECT_EQ(read.provenance.scene, written.provenance.scene);
  EXPECT_EQ(read.provenance.inputs, written.provenance.inputs);
  EXPECT_FALSE(fs::exists(file.string() + ".part"));
}

TEST(ResultFile, StoresSiWithTheUnit) {
  const fs::path file = fresh("si.h5");
  write_result(file, example());
  const h5::InputFile raw(file);
  EXPECT_EQ(raw.doubles("/solids/time"), (std::vector<double>{0, 0.0005, 1}));
  EXPECT_EQ(raw.text_attribute("/solids/time", "unit"), "s");
  EXPECT_DOUBLE_EQ(raw.doubles("/solids/classes/mass").at(0), 1e-21);
  EXPECT_EQ(raw.text_attribute("/solids/classes/mass", "unit"), "kg");
  EXPECT_EQ(raw.text_attribute("/solids/count", "unit"), "1");
}

TEST(ResultFile, EqualContentGivesEqualBytes) {
  const fs::path a = fresh("a.h5"), b = a.parent_path() / "b.h5";
  write_result(a, example());
  write_result(b, example());
  EXPECT_EQ(bytes_of(a), bytes_of(b));
}

TEST(ResultFile, ConvertsOtherUnitsOfTheRightDimension) {
  const fs::path file = fresh("hand.h5");
  {
    h5::OutputFile out(file);
    const double minutes[] = {1, 2}, degrees[] = {25, 80}, length[] = {3, 4};
    out.write("/dewatering/time", {2}, minutes);
    out.attribute("/dewatering/time", "unit", std::string("min"));
    out.write("/dewatering/temperature", {2}, degrees);
    out.attribute("/dewatering/temperature", "unit", std::string("degC"));
    out.write("/dewatering/bare", {2}, length);
    out.commit();
  }
  const auto read = read_result(file, "dewatering", {{"/dewatering/bare", Dimension::Length}});
  EXPECT_DOUBLE_EQ(read.require("/dewatering/time").values[1], 120e3);
  EXPECT_DOUBLE_EQ(read.require("/dewatering/temperature").values[1], 353.15);
  EXPECT_DOUBLE_EQ(read.require("/dewatering/bare").values[0], 3e6);
  const std::string refusal = message_of([&] {
    read_result(file, "dewatering", {{"/dewatering/time", Dimension::Length}});
  });
  expect_contains(refusal, "3 ");
  expect_contains(refusal, "/dewatering/time");
  expect_contains(refusal, "\"min\" is not a unit of length");
}

TEST(ResultFile, RefusesWhatCannotBeUsed) {
  const fs::path file = fresh("a.h5");
  expect_contains(message_of([&] { read_result(file, "solids"); }),
                  "3 " + file.string() + ": there is no such file");
  expect_contains(message_of([&] { read_result(file.parent_path(), "solids"); }), "is a folder");
  put_bytes(file, "");
  expect_contains(message_of([&] { read_result(file, "solids"); }), "3 " + file.string());
  put_bytes(file, "time,flux\n");
  expect_contains(message_of([&] { read_result(file, "solids"); }), "is not a whole HDF5 file");
  write_result(file, example());
  expect_contains(message_of([&] { read_result(file, "cluster"); }),
                  "is a solids file, expected a cluster file");
  expect_contains(message_of([&] { read_result(file, "solids").require("/solids/absent"); }),
                  "/solids/absent is missing");
}

TEST(ResultFile, RefusesNumbersThatAreNotFinite) {
  const fs::path file = fresh("nan.h5");
  {
    h5::OutputFile out(file);
    const double values[] = {1, std::nan("")};
    out.write("/solids/time", {2}, values);
    out.commit();
  }
  expect_contains(message_of([&] { read_result(file, "solids"); }),
                  "3 " + file.string() + ": /solids/time: entry 1");
  ResultFile bad = example();
  bad.datasets[0].values[2] = std::nan("");
  EXPECT_THROW(write_result(file.parent_path() / "bad.h5", bad), std::logic_error);
  EXPECT_FALSE(fs::exists(file.parent_path() / "bad.h5"));
  EXPECT_FALSE(fs::exists(file.parent_path() / "bad.h5.part"));
}

TEST(ResultFile, RefusesANewerMajorVersion) {
  const fs::path file = fresh("newer.h5");
  {
    h5::OutputFile out(file);
    out.group("/pigment");
    out.attribute("/pigment", "format_version", std::vector<std::int64_t>{2, 0});
    out.attribute("/pigment", "kind", std::string("solids"));
    out.group("/solids");
    out.commit();
  }
  expect_contains(message_of([&] { read_result(file, "solids"); }), "format version 2 is newer");
}

// A file cut anywhere, or with any one byte changed, either is refused or gives the numbers that were
// written.
TEST(ResultFile, DamageNeverGivesOtherNumbers) {
  const fs::path whole = fresh("whole.h5"), damaged = whole.parent_path() / "damaged.h5";
  ResultFile result = example();
  Dataset curve{"/solids/curve", {500}, {}, Dimension::Length, Dataset::Storage::Float64};
  for (int i = 0; i < 500; ++i) curve.values.push_back(std::sqrt(i + 2.0));
  result.datasets.push_back(curve);
  write_result(whole, result);
  const ResultFile good = read_result(whole, "solids");
  const std::string bytes = bytes_of(whole);
  for (std::size_t cut = 0; cut < bytes.size(); cut += 997) {
    put_bytes(damaged, bytes.substr(0, cut));
    EXPECT_THROW(read_result(damaged, "solids"), FileError) << "cut at " << cut;
  }
  int refused = 0, tried = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 41) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    put_bytes(damaged, changed);
    ++tried;
    try {
      const ResultFile read = read_result(damaged, "solids");
      const Dataset* back = read.find("/solids/curve");
      if (back != nullptr && back->dimension == Dimension::Length) {
        EXPECT_EQ(back->values, good.find("/solids/curve")->values) << "byte " << at;
      }
    } catch (const FileError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, tried / 5) << "the checksums do not act";
}

TEST(ResultFile, LeavesTheOldFileWhereTheNewOneCannotBeWritten) {
  const fs::path nowhere = fresh("x.h5").parent_path() / "absent_folder" / "x.h5";
  expect_contains(message_of([&] { write_result(nowhere, example()); }),
                  "4 " + nowhere.string() + ": cannot be written");
  const std::string device = message_of([&] { write_result("/dev/null", example()); });
  expect_contains(device, "4 /dev/null");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

// FIPS 180-2, appendix B.
TEST(Sha256, MatchesThePublishedExamples) {
  EXPECT_EQ(sha256_of_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const fs::path file = fresh("million");
  put_bytes(file, std::string(1'000'000, 'a'));
  EXPECT_EQ(sha256_of_file(file), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_THROW(sha256_of_file(file.parent_path() / "absent"), FileError);
}

}  // namespace
}  // namespace pigment::io
