#pragma once
// Line plots as inline SVG for a page that stands alone. Colours are CSS variables of the page (light and
// dark); the data stand beside the drawing as JSON, for the page's own script: read-out under the pointer,
// legend that switches series, a slider over frames. Without the script the drawing stands as it is.
#include <optional>
#include <string>
#include <vector>

namespace pigment::report {

struct Axis {
  std::string label, unit;          // unit "": a pure number
  std::optional<double> low, high;  // absent: from the data
  bool logarithmic = false;
  bool from_zero = false;  // widen the range to zero
  double per_millisecond = 0;  // an axis of time: what a millisecond is in its unit; 0: none
};

enum class SeriesStyle { Line, Dashed, Points, LineAndPoints, Steps };

struct Series {
  std::string name;
  std::vector<double> x = {}, y = {};
  std::vector<double> error = {};         // of y, empty: none
  SeriesStyle style = SeriesStyle::Line;  // Steps: x holds one edge more than y
  int colour = -1;                        // 0..7: palette; -1: by position
  std::string fixed_colour = {};          // a CSS colour in place of the palette
  bool legend = true;
};

// A line across the plot with a label, at a value of x (or of y for a plot read by height).
struct MarkerLine {
  double value = 0;
  std::string label;
};

// One instant of a plot with a slider: the curves that replace the ones shown.
struct PlotFrame {
  std::string label;           // "0.125 s"
  std::vector<Series> series;  // same number in every frame
  double time = 0;             // ms; what shows times of the page moves together
};

struct Plot {
  std::string title, note;  // note: one sentence below, may be empty
  Axis x, y;
  std::vector<Series> series;
  std::vector<MarkerLine> markers;
  std::vector<PlotFrame> frames;  // with a slider; the last one is shown first
  bool read_by_height = false;    // the pointer picks values by y (profiles drawn upright)
  int height = 340;               // of 640 wide
};

// The whole figure: title, legend, drawing, slider, note, data. id: unique on the page, letters and digits.
std::string plot_figure(const Plot&, const std::string& id);

// The drawing as a file of its own, for print: 85 mm wide (a column), 7 pt, legend above the axes, colours for light paper.
// The frames of a slider are not there but for the last, where the plot has no other curves.
std::string plot_file(const Plot&);

// "&", "<", ">" and quotes as entities; control characters dropped.
std::string html_escape(const std::string&);
// A JSON string with its quotes, safe inside <script>.
std::string json_string(const std::string&);

}  // namespace pigment::report
