#pragma once
// One HTML page that stands alone: style, script, plots and pictures inside, nothing fetched from anywhere.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/png_image.h"
#include "report/study_files.h"
#include "report/svg_plot.h"

namespace pigment::report {

struct Headline {  // one number of the summary
  std::string label, value, unit, note;
};

struct CaptionedImage {
  std::string caption, description;  // description: for readers who cannot see it
  Image image;
  std::optional<double> time = {};  // ms
};

// What the colours of pictures mean: a scale with labels at positions 0..1, or tints by name.
struct ColourLegend {
  std::string label;
  std::vector<std::string> colours;                    // CSS colours: the scale's stops, or one a name
  std::vector<std::pair<double, std::string>> labels;  // of a scale
  std::vector<std::string> names;                      // of tints
};

// VerdictFirst: the first column holds verdicts, shown as coloured marks, and the others run over several lines.
enum class TableStyle { Plain, VerdictFirst };

struct DrawnPlot {
  std::string chapter, section;  // where on the page
  Plot plot;
};

class HtmlReport {
 public:
  explicit HtmlReport(std::string title, std::string subtitle = {});

  void chapter(const std::string& title);  // a run, where there are several
  void section(const std::string& title, const std::string& text = {});
  void headlines(const std::vector<Headline>&);
  void plots(const std::vector<Plot>&);  // side by side where there is room
  void images(const std::vector<CaptionedImage>&, const std::string& note = {});  // in one row
  void colours(const ColourLegend&);
  void figures(const std::vector<StudyFigure>&);  // drawn elsewhere; side by side where there is room
  void table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
             TableStyle = TableStyle::Plain);
  void folded(const std::string& summary, const std::string& preformatted);
  // The interactive 3-D view (lib/report/page/viewer.js): colours and what is known of each run as JSON, the particles as
  // <script> elements. One a page.
  void viewer(const std::string& json, const std::string& packed, const std::string& note);
  void remark(const std::string& text);  // set apart: what a reader must know
  const std::vector<DrawnPlot>& drawn() const { return drawn_; }  // every plot so far
  bool empty() const { return sections_.empty(); }

  std::string page() const;  // the same bytes for the same calls

 private:
  std::string title_, subtitle_, body_, footer_;
  std::vector<std::pair<std::string, std::string>> sections_, chapters_;  // anchor, title
  std::vector<DrawnPlot> drawn_;
  int plots_ = 0;
  bool open_ = false, has_viewer_ = false;
  void close_section();
};

// One SVG file a plot, named after chapter, section and title; the folder is made where it is missing. Throws OutputError.
void write_plots(const std::filesystem::path& folder, const std::vector<DrawnPlot>&);

extern const char* const page_style;  // CSS

}  // namespace pigment::report
