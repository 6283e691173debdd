#include "dewatering/dewatering_file.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace pigment::dewatering {
namespace {

Profile profile() {
  Profile p;
  p.curve.time = {0, 100, 600};
  p.curve.absorption_flux = {0.02, 0.01, 0.005};
  p.curve.evaporation_flux = {0.04, 0.04, 0.008};
  p.curve.absorbed = {0, 1.5, 5};
  p.curve.evaporated = {0, 4, 16};
  p.duration = 600;
  p.scale = 0.9;
  return p;
}

DewateringCurve through_a_file(io::ResultFile file) {
  // Tests run side by side in one folder.
  const std::string name = std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".h5";
  io::write_result(name, file);
  return read_curve(name);
}

// The file with one dataset changed.
io::ResultFile changed(const std::string& path, std::vector<double> values) {
  io::ResultFile file = result_of(profile());
  for (io::Dataset& dataset : file.datasets)
    if (dataset.path == path) {
      dataset.shape = {values.size()};
      dataset.values = values;
    }
  return file;
}

TEST(DewateringFile, KeepsTheCurve) {
  const DewateringCurve read = through_a_file(result_of(profile())), written = profile().curve;
  auto expect_same = [](const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_DOUBLE_EQ(a[i], b[i]);  // to SI and back: a rounding or two
  };
  expect_same(read.time, written.time);
  expect_same(read.absorption_flux, written.absorption_flux);
  expect_same(read.evaporation_flux, written.evaporation_flux);
  expect_same(read.absorbed, written.absorbed);
  expect_same(read.evaporated, written.evaporated);
  EXPECT_TRUE(read.temperature.empty());
}

TEST(DewateringFile, NeedsTimeAndFluxesOnly) {
  io::ResultFile file = result_of(profile());
  std::erase_if(file.datasets, [](const io::Dataset& d) { return d.path.ends_with("ed"); });
  ASSERT_EQ(file.datasets.size(), 3u);
  EXPECT_TRUE(through_a_file(file).absorbed.empty());
}

TEST(DewateringFile, RefusesWhatCannotBe) {
  EXPECT_THROW(through_a_file(changed("/dewatering/time", {0, 100, 100})), FileError);
  EXPECT_THROW(through_a_file(changed("/dewatering/time", {1, 100, 600})), FileError);
  EXPECT_THROW(through_a_file(changed("/dewatering/time", {0, 100})), FileError);
  EXPECT_THROW(through_a_file(changed("/dewatering/absorption_flux", {0, -1, 0})), FileError);
  EXPECT_THROW(through_a_file(changed("/dewatering/evaporated", {0, 2, 1})), FileError);
  EXPECT_THROW(through_a_file(changed("/dewatering/absorbed", {1, 2, 3})), FileError);
  io::ResultFile without = result_of(profile());
  std::erase_if(without.datasets, [](const io::Dataset& d) { return d.path == "/dewatering/evaporation_flux"; });
  EXPECT_THROW(through_a_file(without), FileError);
  EXPECT_THROW(read_curve("absent.h5"), FileError);
}

}  // namespace
}  // namespace pigment::dewatering
