#include "config/csv_table.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"

namespace pigment::config {
namespace {

class CsvTableTest : public testing::Test {
 protected:
  std::filesystem::path file = "csv_table_test.csv";
  const std::vector<CsvColumn> columns{{"diameter", Dimension::Length},
                                       {"finer", Dimension::MassFraction},
                                       {"temperature", Dimension::Temperature, false}};

  CsvTable read(const std::string& text) {
    std::ofstream(file) << text;
    return read_csv(file, columns);
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const FileError& e) {
      EXPECT_EQ(e.exit_status(), 3);
      return e.what();
    }
    return "no refusal";
  }
  void TearDown() override { std::filesystem::remove(file); }
};

TEST_F(CsvTableTest, ConvertsUnitsAndSkipsWhatIsNoRow) {
  const CsvTable table = read(
      "\xEF\xBB\xBF# grade 75\r\nfiner [wt%], diameter [nm] ,temperature [degC]\r\n\r\n10,250,25\r\n+95.5, "
      "2e3 ,30\r\n");
  ASSERT_EQ(table.row_count(), 2u);
  // to a few roundings of the unit conversions
  EXPECT_NEAR((*table.find("diameter"))[0], 0.25, 1e-15);
  EXPECT_NEAR((*table.find("diameter"))[1], 2, 1e-14);
  EXPECT_NEAR((*table.find("finer"))[1], 0.955, 1e-15);
  EXPECT_NEAR((*table.find("temperature"))[1], 303.15, 1e-12);
  EXPECT_EQ(table.line, (std::vector<int>{4, 5}));
}

TEST_F(CsvTableTest, LeavesOutAnOptionalColumn) {
  const CsvTable table = read("diameter [um],finer [wt%]\n1,50");
  EXPECT_EQ(table.find("temperature"), nullptr);
  EXPECT_EQ(table.row_count(), 1u);
}

TEST_F(CsvTableTest, NamesLineAndColumnOfWhatItRefuses) {
  EXPECT_NE(refusal("diameter [um],finer [wt%]\n1,50\n2,many\n").find(".csv:3: column \"finer\": \"many\""),
            std::string::npos);
  EXPECT_NE(refusal("diameter [um],finer [wt%]\n1,nan\n").find(":2: column \"finer\""), std::string::npos);
  EXPECT_NE(refusal("diameter [um],finer [wt%]\n1,1e999\n").find(":2: column \"finer\""), std::string::npos);
  EXPECT_NE(refusal("diameter [um],finer [wt%]\n1,\n").find(":2: column \"finer\": \"\""), std::string::npos);
  EXPECT_NE(refusal("diameter [um],finer [wt%]\n1,+-3\n").find(":2: column \"finer\""), std::string::npos);
  EXPECT_NE(refusal("diameter [um],finer [wt%]\n1,2,3\n").find(":2: expected 2 fields"), std::string::npos);
  EXPECT_NE(refusal("diameter [s],finer [wt%]\n1,2\n").find(":1: column \"diameter\": [s]"),
            std::string::npos);
  EXPECT_NE(refusal("diameter [um,finer [wt%]\n1,2\n").find("lacks a closing"), std::string::npos);
  EXPECT_NE(refusal("diameter,finer [wt%]\n1,2\n").find("names no unit"), std::string::npos);
  EXPECT_NE(refusal("size [um],finer [wt%]\n1,2\n").find("unknown column \"size [um]\""), std::string::npos);
  EXPECT_NE(refusal("diameter [um]\n1\n").find("no column \"finer\""), std::string::npos);
  EXPECT_NE(refusal("diameter [um],diameter [um],finer [wt%]\n1,2,3\n").find("stands twice"),
            std::string::npos);
  EXPECT_NE(refusal("").find("is empty"), std::string::npos);
  EXPECT_NE(refusal("diameter [um],finer [wt%]\n").find("no rows"), std::string::npos);
  EXPECT_THROW(read_csv("/nonexistent/file.csv", columns), FileError);
  EXPECT_THROW(read_csv(std::filesystem::current_path(), columns), FileError);
}

}  // namespace
}  // namespace pigment::config
