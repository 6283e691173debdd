// Plots and pages: round ticks, places of points, escapes, nothing fetched from outside.
#include "report/svg_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "report/html_report.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

using Labels = std::vector<std::string>;

TEST(Ticks, AreRoundNumbersInside) {
  EXPECT_EQ(linear_ticks(0, 1, 5).labels, (Labels{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(linear_ticks(0, 10, 5).labels, (Labels{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(linear_ticks(14.2, 25.3, 5).labels, (Labels{"15.0", "17.5", "20.0", "22.5", "25.0"}));
  EXPECT_EQ(linear_ticks(-0.3, 0.31, 3).labels, (Labels{"−0.25", "0", "0.25"}));
  EXPECT_EQ(linear_ticks(0, 3e-10, 3).labels, (Labels{"0", "1e−10", "2e−10", "3e−10"}));
}

TEST(Ticks, AnyRangeGivesAFewOfThem) {
  for (const double low : {-1e9, -3.7, 0.0, 1e-12, 0.1234, 5e7})
    for (const double span : {1e-9, 0.003, 1.0, 47.0, 8e8}) {
      const double scale = std::max(1.0, std::abs(low));
      const Ticks t = linear_ticks(low, low + span * scale, 6);
      EXPECT_GE(t.values.size(), 2u) << low << " " << span;
      EXPECT_LE(t.values.size(), 8u) << low << " " << span;
      for (const double v : t.values) {
        const double slack =
            1e-8 * span * scale + 1e-15 * scale;  // a tick on the edge itself, and its rounding
        EXPECT_TRUE(v >= low - slack && v <= low + span * scale + slack) << v;
      }
      EXPECT_EQ(t.values.size(), t.labels.size());
    }
  EXPECT_EQ(linear_ticks(3, 3, 5).values, std::vector<double>{3});
}

TEST(Ticks, LogarithmicOnesArePowersOfTen) {
  EXPECT_EQ(logarithmic_ticks(1e-4, 10).labels, (Labels{"0.0001", "0.001", "0.01", "0.1", "1", "10"}));
  EXPECT_EQ(logarithmic_ticks(0.25, 2).labels, (Labels{"0.3", "0.5", "1", "2"}));
}

TEST(Ticks, NumbersReadWell) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(4710), "4710");
  EXPECT_EQ(number_text(-0.25), "−0.25");
  EXPECT_EQ(number_text(1.2e-9), "1.2e−9");
  EXPECT_EQ(time_text(125), "0.125 s");
  EXPECT_EQ(time_text(5), "5 ms");
  EXPECT_EQ(time_text(0), "0 s");
  EXPECT_EQ(time_text(300e3), "5 min");
  EXPECT_EQ(round_below(7.3), 5);
  EXPECT_EQ(round_below(0.28), 0.2);
  EXPECT_EQ(round_below(1), 1);
}

TEST(Ticks, FramesSpreadOverTime) {
  EXPECT_EQ(evenly_in_time({0, 1, 2, 3, 4, 5, 6}, 4), (std::vector<std::size_t>{0, 2, 4, 6}));
  EXPECT_EQ(evenly_in_time({0, 1, 2, 90, 100}, 3),
            (std::vector<std::size_t>{0, 3, 4}));  // 90 is nearer to 50 than 2 is
  EXPECT_EQ(evenly_in_time({5}, 4), std::vector<std::size_t>{0});
  EXPECT_TRUE(evenly_in_time({}, 4).empty());
}

Plot line(std::vector<double> x, std::vector<double> y) {
  Plot plot;
  plot.title = "a <b> & c";
  plot.x = {"time", "s", {}, {}, false, false};
  plot.y = {"height", "µm", {}, {}, false, false};
  plot.series.push_back({"s\"1\"", std::move(x), std::move(y)});
  return plot;
}

TEST(SvgPlot, PointsStandWhereTheAxesSay) {
  Plot plot = line({0, 1, 2}, {0, 5, 10});
  plot.y.low = 0, plot.y.high = 10;
  const std::string svg = plot_figure(plot, "p");
  // Drawing area: 54..624 across, 290..14 up (of 640 x 340).
  EXPECT_NE(svg.find("d=\"M54 290L339 152L624 14\""), std::string::npos) << svg;
}

TEST(SvgPlot, StepsFollowTheirEdges) {
  Plot plot = line({0, 1, 2}, {10, 5});
  plot.series[0].style = SeriesStyle::Steps;
  plot.y.low = 0, plot.y.high = 10;
  EXPECT_NE(plot_figure(plot, "p").find("d=\"M54 14H339V152H624\""), std::string::npos);
}

TEST(SvgPlot, GapsStayGapsAndNothingIsNotANumber) {
  const std::string svg = plot_figure(line({0, 1, 2, 3}, {1, NAN, INFINITY, 4}), "p");
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(svg.find("[1,null,null,4]"), std::string::npos);
  for (const Plot& plot : {line({}, {}), line({1}, {1}), line({0, 0}, {0, 0}), line({1, 2}, {NAN, NAN})}) {
    const std::string empty = plot_figure(plot, "p");
    EXPECT_EQ(empty.find("nan"), std::string::npos);
    EXPECT_EQ(empty.find("inf"), std::string::npos);
  }
  // Values that differ by rounding get an axis of ordinary numbers.
  EXPECT_EQ(plot_figure(line({0, 1}, {0.05681818181818, 0.05681818181819}), "p").find("0.0568181818"),
            std::string::npos);
  Plot log = line({0, 1}, {-1, 0});
  log.y.logarithmic = true;
  EXPECT_EQ(plot_figure(log, "p").find("nan"), std::string::npos);
}

TEST(SvgPlot, TextIsEscaped) {
  const std::string svg = plot_figure(line({0, 1}, {0, 1}), "p");
  EXPECT_NE(svg.find("a &lt;b&gt; &amp; c"), std::string::npos);
  EXPECT_NE(svg.find("s&quot;1&quot;"), std::string::npos);
  EXPECT_NE(svg.find("s\\\"1\\\""), std::string::npos);
  EXPECT_EQ(html_escape(std::string("a\0b\x1b<", 5)), "ab&lt;");
  EXPECT_EQ(json_string("</script>\n"), "\"\\u003c/script\\u003e\\u000a\"");
}

TEST(HtmlReport, StandsAlone) {
  HtmlReport report("Layer <1>", "sub");
  report.section("One & only", "text");
  report.headlines({{"label", "1.5", "µm", "note"}});
  report.plots({line({0, 1}, {0, 1}), line({0, 1}, {1, 0})});
  report.images({{"t", "a picture", Image(8, 8)}});
  report.table({"a"}, {{"<td>"}});
  report.folded("scene", "a: </pre><script>alert(1)</script>");
  const std::string page = report.page();
  EXPECT_EQ(page.find("http:"), std::string::npos);
  EXPECT_EQ(page.find("https:"), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(?!data:|#)")));
  EXPECT_FALSE(std::regex_search(page, std::regex("url\\((?!#)")));
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("Layer &lt;1&gt;"), std::string::npos);
  EXPECT_NE(page.find("&lt;td&gt;"), std::string::npos);
  // Every id once, every section in the contents.
  EXPECT_NE(page.find("id=\"plot1\""), std::string::npos);
  EXPECT_NE(page.find("id=\"plot2\""), std::string::npos);
  EXPECT_NE(page.find("href=\"#section1\""), std::string::npos);
  EXPECT_EQ(page, report.page());
  // Sections close: as many ends as beginnings.
  const auto count = [&](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) ++n;
    return n;
  };
  for (const char* tag :
       {"section", "figure", "div", "table", "details", "svg", "dl", "button", "label", "p"})
    EXPECT_EQ(count("<" + std::string(tag) + ">") + count("<" + std::string(tag) + " "),
              count("</" + std::string(tag) + ">"))
        << tag;
}

}  // namespace
}  // namespace pigment::report
