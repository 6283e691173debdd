#include "report/study_files.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "report/base64.h"

namespace pigment::report {
namespace {

std::filesystem::path file_with(const std::filesystem::path& path, const std::string& text) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

const std::string header = "study,section,claim,source,ours,decided_by,verdict\n";

TEST(StudyFiles, QuotedFieldsMayHoldCommasQuotesAndLines) {
  const auto claims = read_claims(
      file_with("quoted.csv", header + "s,4.2,\"a, \"\"b\"\"\nc\",x,,\"t\",reproduced\r\n\ns,4,d,x,y,t,not decidable"));
  ASSERT_EQ(claims.size(), 2u);
  EXPECT_EQ(claims[0].claim, "a, \"b\"\nc");
  EXPECT_EQ(claims[0].ours, "");
  EXPECT_EQ(claims[0].verdict, "reproduced");
  EXPECT_EQ(claims[1].verdict, "not decidable");
}

TEST(StudyFiles, WhatIsNoTableOfClaimsIsRefusedWithItsLine) {
  const auto message_of = [](const std::string& text) {
    try {
      read_claims(file_with("refused.csv", text));
    } catch (const FileError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(message_of("").find("refused.csv:1"), std::string::npos);
  EXPECT_NE(message_of("study,claim\n").find("expected the header"), std::string::npos);
  EXPECT_NE(message_of(header + "a,b\n").find("refused.csv:2: has 2 fields"), std::string::npos);
  EXPECT_NE(message_of(header + "s,4,c,x,y,t,reproduced\ns,4,c,x,y,t,true\n").find("refused.csv:3: verdict \"true\""),
            std::string::npos);
  EXPECT_NE(message_of(header + "s,4,\"c\nd,x,y,t,reproduced\n").find("refused.csv:2: a quote"), std::string::npos);
  EXPECT_THROW(read_claims("missing.csv"), FileError);
}

TEST(StudyFiles, FilesOfOneFolderAreOneStudy) {
  const auto claims = file_with("first/claims.csv", header + "drying,4,c,x,y,t,reproduced\n");
  const auto svg = file_with("first/figures/f.svg", "<svg viewBox=\"0 0 200 100\"><title>a &lt; b &amp;amp; c</title></svg>");
  const auto other = file_with("second/figures/g.svg", "<svg></svg>");
  const auto studies = gather_studies({claims}, {other, svg});
  ASSERT_EQ(studies.size(), 2u);
  EXPECT_EQ(studies[0].name, "drying");
  ASSERT_EQ(studies[0].figures.size(), 1u);
  EXPECT_EQ(studies[0].figures[0].caption, "a < b &amp; c");
  EXPECT_TRUE(studies[0].figures[0].wide);
  EXPECT_EQ(studies[1].name, "second");
  EXPECT_EQ(studies[1].figures[0].caption, "g");
  EXPECT_EQ(studies[1].figures[0].data_uri, "data:image/svg+xml;base64,PHN2Zz48L3N2Zz4=");
  EXPECT_THROW(gather_studies({}, {file_with("half.svg", "<svg>")}), FileError);
}

TEST(Base64, TestVectorsOfItsStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace pigment::report
