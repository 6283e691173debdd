// report: one page that shows what the files of a run say.
#include <fmt/format.h>

#include "app/tool.h"
#include "base/error.h"
#include "base/log.h"
#include "report/picture_options.h"
#include "report/sections.h"
#include "report/whole_file.h"

namespace {

using namespace pigment;

struct Options {
  std::vector<app::path> files, claims, figures;
  app::path plots;
  std::string title, colour = "auto";
  int viewer_frames = 100;
};

void declare(app::CommandLine& line, Options& o) {
  line.describe(
      "Writes one HTML page, complete in itself, from any of pigment's files: what is given is shown, what "
      "is missing is left "
      "out. Files of one folder are one run. A study's claims and figures come before its runs.",
      "pigment-report packing.h5 dewatering.h5 trajectory.h5 solids.h5 cluster.h5 separation.h5 -o "
      "report.html");
  line.positional(
      "files", o.files,
      "packing, dewatering, kbrown, trajectory, solids, cluster, separation, mobility (HDF5), in any order",
      false);
  line.option("--claims", o.claims,
              "claims.csv of a study: study,section,claim,source,ours,decided_by,verdict; repeatable");
  line.option("--figure", o.figures, "a figure of a study (SVG, PNG), captioned with its <title>; repeatable");
  line.option("--title", o.title, "heading of the page");
  line.option("--colour,--color", o.colour,
              "colours of the pictures: auto (species where there are several, else size), size, species");
  line.option("--plots", o.plots, "also write every plot as a file fit for print (SVG, 85 mm wide) into this folder");
  line.option("--viewer-frames", o.viewer_frames,
              "most frames of a run in the interactive 3-D view, evenly in time; 0: no such view");
  line.output_required(true, "the page (HTML)");
  line.has_threads();
}

void run(const app::CommandLine& line, const Options& o) {
  if (!line.common.set.empty()) throw InputError("--set: pigment-report reads no scene");
  if (o.colour != "auto" && o.colour != "size" && o.colour != "species")
    throw InputError(fmt::format("--colour: \"{}\" is none of auto, size, species", o.colour));
  if (o.files.empty() && o.claims.empty() && o.figures.empty())
    throw InputError("files: nothing to report; name files of a run, or --claims or --figure of a study");
  const std::vector<report::RunFiles> runs = report::gather_runs(o.files);
  const std::vector<report::StudyFiles> studies = report::gather_studies(o.claims, o.figures);
  const std::string title = !o.title.empty() ? o.title
                            : runs.empty() && studies.size() == 1 ? "Study: " + studies.front().name
                            : runs.empty()                        ? "Studies"
                            : runs.size() == 1 && !runs.front().name.empty()
                                ? "Coating layer: " + runs.front().name
                                : "Coating layers";
  report::PictureWishes wishes;
  wishes.colour = o.colour;
  wishes.viewer_frames = report::whole_option("--viewer-frames", o.viewer_frames, 0, 10000);
  const report::HtmlReport composed = report::compose_report(runs, studies, title, wishes);
  const std::string page = composed.page();
  report::write_whole_file(line.common.output, page);
  if (!o.plots.empty()) report::write_plots(o.plots, composed.drawn());
  note(fmt::format("{}: {:.1f} MB", line.common.output.string(), 1e-6 * static_cast<double>(page.size())));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return app::run_tool(
      "report", argc, argv, [&](auto& line) { declare(line, options); },
      [&](auto& line) { run(line, options); });
}
