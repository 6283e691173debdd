#pragma once
// The parts of a report. Each adds what its files allow to the page, and nothing where they are missing.
#include <optional>

#include "report/html_report.h"
#include "report/run_files.h"
#include "report/study_files.h"

namespace pigment::report {

// What several sections show alike.
struct RunView {
  const RunFiles& files;
  double longest_time = 0;                    // ms, of any file of the run
  bool in_seconds = true;                     // else milliseconds
  std::optional<double> immobilisation_time;  // ms

  explicit RunView(const RunFiles&);
  double shown_time(double milliseconds) const { return in_seconds ? milliseconds / 1000 : milliseconds; }
  std::vector<double> shown_times(std::vector<double> milliseconds) const;
  std::string when(double milliseconds) const;  // "0.125 s", all of one run in one unit
  Axis time_axis() const { return {"time", in_seconds ? "s" : "ms", {}, {}, false, true, in_seconds ? 1e-3 : 1}; }
  std::vector<MarkerLine> immobilisation_marker() const;
};

void add_overview(HtmlReport&, const RunView&);
struct PictureWishes {
  std::string colour = "auto";  // auto: species where there are several, else size
  int width = 420, height = 900;
  int viewer_frames = 100;  // most frames of a run in the 3-D viewer; 0: no viewer
};
void add_pictures(HtmlReport&, const RunView&, const PictureWishes&);
void add_viewer(HtmlReport&, const std::vector<RunView>&, const PictureWishes&);  // interactive, all runs in one
void add_overlays(HtmlReport&, const std::vector<RunView>&);  // curves of all runs, one plot each
void add_packing(HtmlReport&, const RunView&);  // sizes, and how random the packing came out
void add_dewatering(HtmlReport&, const RunView&);
void add_development(HtmlReport&, const RunView&);  // thickness, solids, mass centre, pressures
void add_profiles(HtmlReport&, const RunView&);     // solids and size classes over the thickness
void add_clusters(HtmlReport&, const RunView&);
void add_separations(HtmlReport&, const RunView&);
void add_mobility(HtmlReport&, const RunView&);
void add_brownian_calibration(HtmlReport&, const RunView&);
void add_numerics(HtmlReport&, const RunView&);  // step size, solver, contacts
void add_provenance(HtmlReport&, const RunView&);
void add_study(HtmlReport&, const StudyFiles&);  // claims and figures

// The whole page: what studies say, then the runs.
HtmlReport compose_report(const std::vector<RunFiles>&, const std::vector<StudyFiles>&, const std::string& title,
                          const PictureWishes&);

}  // namespace pigment::report
