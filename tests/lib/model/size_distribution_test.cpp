#include "model/size_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "base/error.h"

namespace pigment {
namespace {

SizeLaw lognormal(double median, double geometric_standard_deviation, double min, double max) {
  SizeLaw law;
  law.kind = SizeLaw::Kind::Lognormal;
  law.median = median, law.geometric_standard_deviation = geometric_standard_deviation;
  law.min = min, law.max = max;
  return law;
}

// Log-normal by weight with mean 1.5 um and standard deviation 10 um, cut to 0.25..2 um: the drying study's
// law.
SizeLaw fine_carbonate() {
  const double growth = 1 + (10 / 1.5) * (10 / 1.5);
  return lognormal(1.5 / std::sqrt(growth), std::exp(std::sqrt(std::log(growth))), 0.25, 2);
}

double normal(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

TEST(SizeDistribution, FollowsTheClosedFormOfTheLognormalLaw) {
  // By number a log-normal law of weight is log-normal again, its log-median lower by 3 (ln sigma_g)^2
  // [hatch1929]; both cut at the same diameters.
  const double median = 0.8, gsd = 1.9, min = 0.2, max = 3;
  const SizeDistribution sizes(lognormal(median, gsd, min, max));
  const double s = std::log(gsd), m = std::log(median), n = m - 3 * s * s;
  const auto cut = [&](double centre, double d) {
    const auto f = [&](double x) { return normal((std::log(x) - centre) / s); };
    return (f(d) - f(min)) / (f(max) - f(min));
  };
  for (const double d : {0.21, 0.3, 0.5, 0.9, 1.7, 2.9}) {
    // Weight is even over ln d within each of 2000 cells of ln(15)/2000 = 0.0014: an error of about 0.0014^2.
    EXPECT_NEAR(sizes.weight_below(d), cut(m, d), 1e-6) << d;
    EXPECT_NEAR(sizes.number_below(d), cut(n, d), 3e-6) << d;
  }
}

TEST(SizeDistribution, GivesTheDryingStudysShares) {
  const SizeDistribution sizes(fine_carbonate());
  // Known to three digits: 43.6 % by number below 300 nm, 73.9 % by weight below 1 um.
  EXPECT_NEAR(sizes.number_below(0.3), 0.436, 5e-4);
  EXPECT_NEAR(sizes.weight_below(1), 0.739, 5e-4);
  // 65 wt% of 2700 kg/m3 in water in 5 x 5 um x 10, 20, 30 um: 2,360, 4,710 and 7,070 particles, to three
  // digits.
  const double solids = 0.65 / 2.7 / (0.65 / 2.7 + 0.35);
  for (const auto& [height, count] : {std::pair{10.0, 2360.0}, {20.0, 4710.0}, {30.0, 7070.0}})
    EXPECT_NEAR(25 * height * solids / sizes.mean_volume(), count, 5);
}

TEST(SizeDistribution, OtherReadingsOfTheStudysLawGiveTheirShares) {
  const SizeDistribution median(lognormal(1.5, 10, 0.25, 2));
  EXPECT_NEAR(median.number_below(0.3), 0.395, 5e-4);
  EXPECT_NEAR(median.weight_below(1), 0.639, 5e-4);
  SizeLaw law = fine_carbonate();
  law.kind = SizeLaw::Kind::Normal;
  law.mean = 1.5, law.standard_deviation = 10;
  const SizeDistribution gaussian(law);
  EXPECT_NEAR(gaussian.number_below(0.3), 0.31, 5e-3);
  EXPECT_NEAR(gaussian.weight_below(1), 0.43, 5e-3);
}

TEST(SizeDistribution, InvertsItsNumberCurve) {
  for (const double gsd : {1.01, 1.5, 7.0, 90.0}) {
    const SizeDistribution sizes(lognormal(0.7, gsd, 0.1, 10));
    double last = 0;
    for (const double u : {1e-12, 1e-3, 0.2, 0.5, 0.77, 0.999, 1 - 1e-9}) {
      const double d = sizes.diameter_at_number(u);
      EXPECT_GT(d, last);
      last = d;
      EXPECT_NEAR(sizes.number_below(d), u, 1e-12);  // rounding of the cumulative sums
    }
    EXPECT_DOUBLE_EQ(sizes.diameter_at_number(0), sizes.smallest());
    EXPECT_DOUBLE_EQ(sizes.diameter_at_number(1), sizes.largest());
  }
}

TEST(SizeDistribution, MeanVolumeIsTheIntegralOverTheNumberCurve) {
  const SizeDistribution sizes(fine_carbonate());
  // Midpoint rule over the quantiles; its error is about the top quantile's spread, 1e-5 of the number.
  double sum = 0;
  const int count = 100000;
  for (int k = 0; k < count; ++k) sum += std::pow(sizes.diameter_at_number((k + 0.5) / count), 3);
  EXPECT_NEAR(std::numbers::pi / 6 * sum / count / sizes.mean_volume(), 1, 1e-6);
}

TEST(SizeDistribution, MonodisperseIsAStep) {
  SizeLaw law;
  law.diameter = 0.5;
  const SizeDistribution sizes(law);
  EXPECT_TRUE(sizes.monodisperse());
  EXPECT_EQ(sizes.diameter_at_number(0.3), 0.5);
  EXPECT_EQ(sizes.weight_below(0.499), 0);
  EXPECT_EQ(sizes.number_below(0.5), 1);
  EXPECT_DOUBLE_EQ(sizes.mean_volume(), std::numbers::pi / 6 * 0.125);
}

TEST(SizeDistribution, RefusesCutOffsThatLeaveNothing) {
  EXPECT_THROW(SizeDistribution{lognormal(1, 1.1, 5, 6)}, InputError);
  EXPECT_THROW(SizeDistribution{lognormal(1, 1.1, 2, 1)}, InputError);
  EXPECT_THROW(SizeDistribution{lognormal(1, 1.1, 0, 1)}, InputError);
}

class TabulatedSizes : public testing::Test {
 protected:
  SizeLaw law;
  void SetUp() override {
    law.kind = SizeLaw::Kind::Table;
    law.file = "size_distribution_test.csv";
  }
  void write(const std::string& text) { std::ofstream(law.file) << text; }
  std::string refusal(const std::string& text) {
    write(text);
    try {
      SizeDistribution{law};
    } catch (const FileError& e) {
      return e.what();
    }
    return "no refusal";
  }
  void TearDown() override { std::filesystem::remove(law.file); }
};

TEST_F(TabulatedSizes, AreStraightOverTheLogarithmOfTheDiameter) {
  write("diameter [um],finer [wt%]\n0.25,0\n0.5,30\n1,30\n2,100\n");
  const SizeDistribution sizes(law);
  EXPECT_NEAR(sizes.weight_below(0.25 * std::numbers::sqrt2), 0.15, 1e-15);
  EXPECT_NEAR(sizes.weight_below(0.8), 0.3, 1e-15);
  EXPECT_NEAR(sizes.weight_below(std::numbers::sqrt2), 0.65, 1e-15);
  // Number by hand: w (d0^-3 - d1^-3) / (3 ln 2) in each step of a factor of two.
  const double fine = 0.3 * (64 - 8), coarse = 0.7 * (1 - 0.125);
  EXPECT_NEAR(sizes.number_below(0.7), fine / (fine + coarse), 1e-14);
  // Nothing lies between 0.5 and 1 um, so nothing is sampled there.
  const double edge = fine / (fine + coarse);
  EXPECT_LE(sizes.diameter_at_number(edge - 1e-12), 0.5);
  EXPECT_GE(sizes.diameter_at_number(edge + 1e-12), 1.0);
}

TEST_F(TabulatedSizes, AreCutAndCountedFromTheirFirstRow) {
  // A curve that begins at 20 wt%: what is finer than its first row is not in the law.
  write("diameter [um],finer [wt%]\n0.25,20\n0.5,60\n1,90\n");
  EXPECT_NEAR(SizeDistribution{law}.weight_below(0.5), 40.0 / 70, 1e-14);
  law.max = 0.5, law.min = 0.1;
  const SizeDistribution cut(law);
  EXPECT_DOUBLE_EQ(cut.smallest(), 0.25);
  EXPECT_DOUBLE_EQ(cut.largest(), 0.5);
  law.min = 2, law.max = 3;
  EXPECT_THROW(SizeDistribution{law}, InputError);
}

TEST_F(TabulatedSizes, NameTheLineThatCannotBe) {
  const std::string header = "diameter [um],finer [wt%]\n";
  EXPECT_NE(refusal(header + "0.2,0\n0.2,10\n").find(".csv:3: diameter does not rise"), std::string::npos);
  EXPECT_NE(refusal(header + "0.2,10\n0.4,5\n").find(".csv:3: finer falls"), std::string::npos);
  EXPECT_NE(refusal(header + "0,0\n0.4,5\n").find(".csv:2: diameter is not above zero"), std::string::npos);
  EXPECT_NE(refusal(header + "1e-200,0\n0.4,5\n").find(".csv:2: diameter 1e-200 um is not within"),
            std::string::npos);
  EXPECT_NE(refusal(header + "0.2,0\n0.4,105\n").find(".csv:3: finer is not within"), std::string::npos);
  EXPECT_NE(refusal(header + "0.2,50\n0.4,50\n").find("does not rise"), std::string::npos);
  EXPECT_NE(refusal(header + "0.2,50\n").find("does not rise"), std::string::npos);
}

}  // namespace
}  // namespace pigment
