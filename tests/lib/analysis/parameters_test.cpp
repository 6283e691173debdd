#include "analysis/parameters.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace pigment::analysis {
namespace {

Parameters read(const std::string& text) {
  config::Document document = config::Document::from_text(text);
  const Parameters p = read_analysis(document.root().block("analysis"));
  document.check();
  return p;
}

TEST(AnalysisParameters, DefaultsAreTheStructsOwn) {
  const Parameters read_ones = read("{}"), own;
  EXPECT_EQ(read_ones.slices, own.slices);
  EXPECT_EQ(read_ones.size_classes, own.size_classes);
  EXPECT_DOUBLE_EQ(read_ones.cake_solids, own.cake_solids);
  EXPECT_DOUBLE_EQ(read_ones.cluster_threshold, own.cluster_threshold);
  EXPECT_EQ(read_ones.separation_limit, own.separation_limit);
  EXPECT_DOUBLE_EQ(read_ones.near_separation_limit, own.near_separation_limit);
  EXPECT_EQ(read_ones.mobility_interval, own.mobility_interval);
  EXPECT_EQ(read_ones.surface_band, own.surface_band);
}

TEST(AnalysisParameters, ComeInEngineUnits) {
  const Parameters p = read(
      "analysis: {slices: 12, size_classes: [250 nm, 1 um], cluster_threshold: 50 nm, separation_limit: 0.1 "
      "um,\n"
      "  mobility_start: 0.05 s, mobility_end: 0.1 s, mobility_interval: 5 ms}\n");
  EXPECT_EQ(p.slices, 12);
  ASSERT_EQ(p.size_classes.size(), 2u);
  EXPECT_DOUBLE_EQ(p.size_classes[0], 0.25);
  EXPECT_DOUBLE_EQ(p.cluster_threshold, 0.05);
  EXPECT_DOUBLE_EQ(p.separation_limit.value(), 0.1);
  EXPECT_DOUBLE_EQ(p.mobility_start, 50);
  EXPECT_DOUBLE_EQ(p.mobility_end.value(), 100);
  EXPECT_DOUBLE_EQ(p.mobility_interval.value(), 5);
}

TEST(AnalysisParameters, RefuseWhatCannotBe) {
  for (const char* bad :
       {"analysis: {slices: 0}", "analysis: {size_classes: [1 um, 0.5 um]}",
        "analysis: {size_classes: [1 kg]}", "analysis: {cluster_threshold: 20}",
        "analysis: {cluster_threshold: -1 nm}", "analysis: {slizes: 3}",
        "analysis: {mobility_start: 1 s, mobility_end: 0.5 s}", "analysis: {surface_band: [1 um]}",
        "analysis: {separation_limit: none}", "analysis: {cake_solids: 100 vol%}", "analysis: 3"})
    EXPECT_THROW(read(bad), InputError) << bad;
}

TEST(AnalysisParameters, SizeClassOfADiameter) {
  const Parameters p;
  EXPECT_EQ(p.size_class(0.2), 0u);
  EXPECT_EQ(p.size_class(0.3), 0u);
  EXPECT_EQ(p.size_class(0.31), 1u);
  EXPECT_EQ(p.size_class(1.0), 2u);
  EXPECT_EQ(p.size_class(1.7), 3u);
}

}  // namespace
}  // namespace pigment::analysis
