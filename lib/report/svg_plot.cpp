#include "report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/colour.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

constexpr double page_width = 640, right = 16, bottom = 50;

struct Scale {
  double low = 0, high = 1, begin = 0, end = 1;  // data range and the pixels it maps to
  bool logarithmic = false;
  double operator()(double v) const {
    const double t = logarithmic ? std::log(std::max(v, low * 1e-3) / low) / std::log(high / low)
                                 : (v - low) / (high - low);
    return begin + t * (end - begin);
  }
};

// Coordinates with two decimals: a hundredth of a pixel.
std::string px(double v) {
  std::string text = fmt::format("{:.2f}", v);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

template <typename Visit>
void for_each_series(const Plot& plot, Visit visit) {
  for (const Series& s : plot.series) visit(s);
  for (const PlotFrame& f : plot.frames)
    for (const Series& s : f.series) visit(s);
}

Scale scale_for(const Plot& plot, const Axis& axis, bool is_x, double begin, double end) {
  double low = INFINITY, high = -INFINITY;
  const auto take = [&](double v) {
    if (!std::isfinite(v) || (axis.logarithmic && v <= 0)) return;
    low = std::min(low, v), high = std::max(high, v);
  };
  for_each_series(plot, [&](const Series& s) {
    for (std::size_t i = 0; i < (is_x ? s.x : s.y).size(); ++i) {
      const double v = (is_x ? s.x : s.y)[i];
      const double e = !is_x && i < s.error.size() ? s.error[i] : 0;
      take(v - e), take(v + e);
    }
  });
  const bool marked = is_x != plot.read_by_height;
  if (marked)
    for (const MarkerLine& m : plot.markers) take(m.value);
  if (!(low <= high)) low = axis.logarithmic ? 1 : 0, high = axis.logarithmic ? 10 : 1;
  if (axis.from_zero && !axis.logarithmic) low = std::min(low, 0.0), high = std::max(high, 0.0);
  if (axis.from_zero && low == 0 && high == 0) high = 1;
  // What differs by rounding only is one value.
  if (high - low <= 1e-6 * std::max(std::abs(low), std::abs(high))) {
    const double pad = low == 0 ? 1 : 0.1 * std::abs(low);
    if (axis.logarithmic)
      low /= 2, high *= 2;
    else
      low -= pad, high += pad;
  }
  // Air above and below the curves, none beside them; zero stays at the axis.
  if (!is_x || plot.read_by_height) {
    if (axis.logarithmic) {
      const double f = std::pow(high / low, 0.04);
      low /= f, high *= f;
    } else {
      const double pad = 0.05 * (high - low);
      if (low != 0 || !axis.from_zero) low -= low > 0 && low < pad ? low : pad;
      if (high != 0) high += pad;
    }
  }
  const bool points_at_edge =
      is_x && std::any_of(plot.series.begin(), plot.series.end(),
                          [](const Series& s) { return s.style == SeriesStyle::Points; });
  if (points_at_edge && !axis.logarithmic) {
    const double pad = 0.04 * (high - low);
    low -= pad, high += pad;
  }
  low = axis.low.value_or(low), high = axis.high.value_or(high);
  if (!(high > low)) high = low + 1;
  return {low, high, begin, end, axis.logarithmic};
}

// Ticks, and the power of ten taken out of their labels into the axis' title where the numbers are very small
// or large.
struct AxisTicks {
  Ticks ticks;
  int exponent = 0;
};

AxisTicks ticks_for(const Scale& s, int wanted) {
  if (s.logarithmic) {
    Ticks ticks = logarithmic_ticks(s.low, s.high);
    if (ticks.values.size() >= 2) return {ticks, 0};
  }
  const double most = std::max(std::abs(s.low), std::abs(s.high));
  const int exponent = most >= 1e5 || most < 1e-2 ? static_cast<int>(std::floor(std::log10(most))) : 0;
  const double factor = std::pow(10.0, -exponent);
  Ticks ticks = linear_ticks(s.low * factor, s.high * factor, wanted);
  for (double& v : ticks.values) v /= factor;
  return {ticks, exponent};
}

std::string power_of_ten(int exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) out += digits[c - '0'];
  return out;
}

std::string colour_of(const Series& s, std::size_t index) {
  if (!s.fixed_colour.empty()) return s.fixed_colour;
  const std::size_t slot = s.colour >= 0 ? static_cast<std::size_t>(s.colour) : index;
  return fmt::format("var(--s{})", slot % 8 + 1);
}

std::string axis_title(const Axis& a, int exponent) {
  std::string unit = a.unit;
  if (exponent != 0) unit = power_of_ten(exponent) + (unit.empty() ? "" : " " + unit);
  return html_escape(unit.empty() ? a.label : a.label + " (" + unit + ")");
}

std::size_t letters_in(const std::string& utf8) {
  return static_cast<std::size_t>(std::count_if(
      utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string path_of(const Series& s, const Scale& x, const Scale& y) {
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < s.y.size(); ++i) {
    if (!std::isfinite(s.y[i]) || i >= s.x.size()) {
      pen_down = false;
      continue;
    }
    if (s.style == SeriesStyle::Steps) {
      if (i + 1 >= s.x.size()) break;
      path += pen_down ? "V" + px(y(s.y[i])) : fmt::format("M{} {}", px(x(s.x[i])), px(y(s.y[i])));
      path += "H" + px(x(s.x[i + 1]));
    } else {
      path += fmt::format("{}{} {}", pen_down ? "L" : "M", px(x(s.x[i])), px(y(s.y[i])));
    }
    pen_down = true;
  }
  return path;
}

std::string series_group(const Series& s, std::size_t index, const Scale& x, const Scale& y,
                         bool emphasised) {
  std::string out = fmt::format(R"(<g class="series{}" data-series="{}" style="color:{}">)",
                                emphasised ? " current" : "", index, html_escape(colour_of(s, index)));
  const bool points = s.style == SeriesStyle::Points || s.style == SeriesStyle::LineAndPoints;
  if (s.style != SeriesStyle::Points)
    out += fmt::format(R"(<path class="line{}" d="{}"/>)", s.style == SeriesStyle::Dashed ? " dashed" : "",
                       path_of(s, x, y));
  for (std::size_t i = 0; i < s.error.size() && i < s.y.size(); ++i)
    if (s.error[i] > 0)
      out += fmt::format(R"(<path class="bar" d="M{0} {1}V{2}M{3} {1}h8M{3} {2}h8"/>)", px(x(s.x[i])),
                         px(y(s.y[i] - s.error[i])), px(y(s.y[i] + s.error[i])), px(x(s.x[i]) - 4));
  if (points)
    for (std::size_t i = 0; i < s.y.size(); ++i)
      if (std::isfinite(s.y[i]))
        out += fmt::format(R"(<path class="dot" d="M{} {}h0"/>)", px(x(s.x[i])), px(y(s.y[i])));
  return out + "</g>";
}

std::string axes(const Plot& plot, const Scale& x, const Scale& y, const AxisTicks& along_x,
                 const AxisTicks& along_y) {
  const Ticks &x_ticks = along_x.ticks, &y_ticks = along_y.ticks;
  std::string out = R"(<g class="ticks">)";
  const double floor = y.begin, ceiling = y.end;
  for (std::size_t i = 0; i < x_ticks.values.size(); ++i) {
    const double v = x_ticks.values[i];
    out += fmt::format(
        R"(<path class="grid" d="M{0} {1}V{2}"/><text class="tick" x="{0}" y="{3}" text-anchor="middle">{4}</text>)",
        px(x(v)), px(floor), px(ceiling), px(floor + 18), x_ticks.labels[i]);
  }
  for (std::size_t i = 0; i < y_ticks.values.size(); ++i) {
    const double v = y_ticks.values[i];
    out += fmt::format(
        R"(<path class="grid" d="M{0} {1}H{2}"/><text class="tick" x="{3}" y="{4}" text-anchor="end">{5}</text>)",
        px(x.begin), px(y(v)), px(x.end), px(x.begin - 8), px(y(v) + 4), y_ticks.labels[i]);
  }
  out += "</g>";
  out += fmt::format(R"(<path class="axis" d="M{0} {1}V{2}H{3}"/>)", px(x.begin), px(ceiling), px(floor),
                     px(x.end));
  out += fmt::format(R"(<text class="label" x="{}" y="{}" text-anchor="middle">{}</text>)",
                     px(0.5 * (x.begin + x.end)), px(floor + 40), axis_title(plot.x, along_x.exponent));
  out += fmt::format(
      R"svg(<text class="label" transform="translate(16 {}) rotate(-90)" text-anchor="middle">{}</text>)svg",
      px(0.5 * (floor + ceiling)), axis_title(plot.y, along_y.exponent));
  return out;
}

std::string marker_lines(const Plot& plot, const Scale& x, const Scale& y) {
  std::string out;
  for (std::size_t i = 0; i < plot.markers.size(); ++i) {
    const MarkerLine& m = plot.markers[i];
    if (plot.read_by_height) {
      out += fmt::format(
          R"(<g class="marker-group" data-at="{1}"><path class="marker" d="M{0} {1}H{2}"/><text class="marker-label" x="{3}" y="{4}" text-anchor="end">{5}</text></g>)",
          px(x.begin), px(y(m.value)), px(x.end), px(x.end - 4), px(y(m.value) - 5), html_escape(m.label));
      continue;
    }
    const double at = x(m.value);
    const bool flip = at > 0.62 * (x.begin + x.end);  // keep the label inside the plot
    out += fmt::format(
        R"(<g class="marker-group" data-at="{0}"><path class="marker" d="M{0} {1}V{2}"/><text class="marker-label" x="{3}" y="{4}" text-anchor="{5}">{6}</text></g>)",
        px(at), px(y.begin), px(y.end), px(at + (flip ? -6 : 6)),
        px(y.end + 13 + 15 * static_cast<double>(i % 3)), flip ? "end" : "start", html_escape(m.label));
  }
  return out;
}

std::string json_numbers(const std::vector<double>& values) {
  std::string out = "[";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i) out += ',';
    out += std::isfinite(values[i]) ? fmt::format("{:.5g}", values[i]) : "null";
  }
  return out + "]";
}

std::string json_series(const std::vector<Series>& all) {
  std::string out = "[";
  for (const Series& s : all) {
    if (out.size() > 1) out += ',';
    out += fmt::format(R"({{"name":{},"steps":{},"x":{},"y":{}}})", json_string(s.name),
                       s.style == SeriesStyle::Steps ? 1 : 0, json_numbers(s.x), json_numbers(s.y));
  }
  return out + "]";
}

std::string json_scale(const Axis& a, const Scale& s, int exponent) {
  return fmt::format(R"({{"label":{},"unit":{},"low":{:.9g},"high":{:.9g},"begin":{},"end":{},"log":{},"exponent":{},"perMillisecond":{:.9g}}})",
                     json_string(a.label), json_string(a.unit), s.low, s.high, px(s.begin), px(s.end),
                     s.logarithmic ? 1 : 0, exponent, a.per_millisecond);
}

std::string data_script(const Plot& plot, const Scale& x, const Scale& y, int x_exponent, int y_exponent) {
  std::string frames = "[";
  for (const PlotFrame& f : plot.frames) {
    if (frames.size() > 1) frames += ',';
    frames += fmt::format(R"({{"label":{},"time":{:.9g},"series":{}}})", json_string(f.label), f.time, json_series(f.series));
  }
  return fmt::format(
      R"(<script type="application/json">{{"x":{},"y":{},"byHeight":{},"series":{},"frames":{}]}}</script>)",
      json_scale(plot.x, x, x_exponent), json_scale(plot.y, y, y_exponent), plot.read_by_height ? 1 : 0, json_series(plot.series),
      frames);
}

std::string legend(const Plot& plot) {
  std::string keys;
  const auto add = [&](const Series& s, std::size_t i) {
    if (s.legend && !s.name.empty())
      keys += fmt::format(
          R"(<button type="button" class="key{}" data-series="{}" aria-pressed="true"><i style="background:{}"></i>{}</button>)",
          s.style == SeriesStyle::Dashed ? " dashed" : "", i, html_escape(colour_of(s, i)),
          html_escape(s.name));
  };
  for (std::size_t i = 0; i < plot.series.size(); ++i) add(plot.series[i], i);
  if (!plot.frames.empty())
    for (std::size_t i = 0; i < plot.frames.back().series.size(); ++i)
      add(plot.frames.back().series[i], plot.series.size() + i);
  return keys.empty() ? "" : R"(<div class="legend">)" + keys + "</div>";
}

}  // namespace

std::string html_escape(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
      out += c;
  }
  return out;
}

std::string json_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (c == '<' || c == '>' || c == '&' || static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

namespace {

// Scales, ticks and the SVG below its root, `width` wide with the curves' field beginning `top` from above.
struct Drawing {
  Scale x, y;
  int x_exponent = 0, y_exponent = 0;
  std::string content;
};

Drawing draw(const Plot& plot, const std::string& id, double width, double top, double height, bool last_frame) {
  Drawing d;
  d.y = scale_for(plot, plot.y, false, height - bottom, top);
  const AxisTicks y_ticks = ticks_for(d.y, 5);
  // Room for the axis' title and the longest of its numbers, at 7.2 pixels a digit.
  std::size_t longest = 0;
  for (const std::string& label : y_ticks.ticks.labels) longest = std::max(longest, letters_in(label));
  const double left = std::max(54.0, 34 + 7.2 * static_cast<double>(longest));
  d.x = scale_for(plot, plot.x, true, left, width - right);
  const AxisTicks x_ticks = ticks_for(d.x, static_cast<int>(width / 100));
  d.x_exponent = x_ticks.exponent, d.y_exponent = y_ticks.exponent;
  d.content = fmt::format(R"(<clipPath id="{}-clip"><rect x="{}" y="{}" width="{}" height="{}"/></clipPath>)", id,
                          px(d.x.begin), px(d.y.end - 4), px(d.x.end - d.x.begin + 4), px(d.y.begin - d.y.end + 8));
  d.content += axes(plot, d.x, d.y, x_ticks, y_ticks) +
               fmt::format(R"svg(<g clip-path="url(#{}-clip)"><g class="curves">)svg", id);
  for (std::size_t i = 0; i < plot.series.size(); ++i) d.content += series_group(plot.series[i], i, d.x, d.y, false);
  if (last_frame && !plot.frames.empty())
    for (std::size_t i = 0; i < plot.frames.back().series.size(); ++i)
      d.content += series_group(plot.frames.back().series[i], plot.series.size() + i, d.x, d.y, true);
  d.content += "</g></g>" + marker_lines(plot, d.x, d.y);
  return d;
}

}  // namespace

std::string plot_figure(const Plot& plot, const std::string& id) {
  const Drawing d = draw(plot, id, page_width, 14, plot.height, true);
  std::string out =
      fmt::format(R"(<figure class="plot" id="{}"><figcaption>{}</figcaption>)", id, html_escape(plot.title));
  out += legend(plot);
  out +=
      fmt::format(R"(<div class="canvas"><svg viewBox="0 0 {} {}" role="img" tabindex="0" aria-label="{}">)",
                  page_width, plot.height, html_escape(plot.title));
  out += d.content + R"(<g class="hover"></g></svg><div class="tip" hidden></div></div>)";
  if (plot.frames.size() > 1)
    out += fmt::format(
        R"(<label class="slider"><input type="range" min="0" max="{0}" value="{0}" step="1" aria-label="time"><output>{1}</output></label>)",
        plot.frames.size() - 1, html_escape(plot.frames.back().label));
  if (!plot.note.empty()) out += "<p class=\"note\">" + html_escape(plot.note) + "</p>";
  return out + data_script(plot, d.x, d.y, d.x_exponent, d.y_exponent) + "</figure>\n";
}

std::string plot_file(const Plot& plot) {
  constexpr double width = 440, millimetres = 85, row_height = 17;
  // The legend in rows, at 6.8 pixels a letter.
  const bool framed = plot.series.empty() && !plot.frames.empty();
  const std::vector<Series>& shown = framed ? plot.frames.back().series : plot.series;
  std::string keys;
  double at = 0, row = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i].legend || shown[i].name.empty()) continue;
    const double room = 44 + 6.8 * static_cast<double>(letters_in(shown[i].name));
    if (at > 0 && at + room > width - right) at = 0, ++row;
    const double y = 14 + row_height * row;
    keys += fmt::format(R"(<path class="line{}" style="color:{}" d="M{} {}h20"/><text x="{}" y="{}">{}</text>)",
                        shown[i].style == SeriesStyle::Dashed ? " dashed" : "", html_escape(colour_of(shown[i], i)), px(at + 6),
                        px(y - 4), px(at + 31), px(y), html_escape(shown[i].name));
    at += room;
  }
  const double top = keys.empty() ? 14 : 14 + row_height * (row + 1);
  const double height = top - 14 + 0.88 * plot.height;
  std::string out = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{}mm" height="{}mm" viewBox="0 0 {} {}"><title>{}</title><style>)",
      millimetres, px(millimetres * height / width), width, px(height), html_escape(plot.title));
  out +=
      "text{font-family:Helvetica,Arial,'Liberation Sans','DejaVu Sans',sans-serif;font-size:12.5px;fill:#222}.label{font-size:13px;fill:#000}"
      ".grid{stroke:#e3e5e9;stroke-width:.8;fill:none}.axis{stroke:#222;stroke-width:1;fill:none}"
      ".line{fill:none;stroke:currentColor;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}.dashed{stroke-dasharray:6 5}"
      ".bar{fill:none;stroke:currentColor;stroke-width:1.2}.dot{fill:none;stroke:currentColor;stroke-width:6.4;stroke-linecap:round}"
      ".marker{stroke:#b3541e;stroke-width:1.1;stroke-dasharray:4 3;fill:none}.marker-label{fill:#b3541e}</style>";
  out += R"(<rect width="100%" height="100%" fill="#fff"/>)" + keys +
         draw(plot, "plot", width, top, height, framed).content + "</svg>\n";
  // The page's variables, as colours.
  for (std::size_t i = 0; i < 8; ++i) {
    const std::string variable = fmt::format("var(--s{})", i + 1), hex = to_hex(series_colour(i, false));
    for (std::size_t found; (found = out.find(variable)) != std::string::npos;) out.replace(found, variable.size(), hex);
  }
  return out;
}

}  // namespace pigment::report
