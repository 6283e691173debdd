// Several runs in one plot each: what every run's own chapter shows, laid over one another.
#include <algorithm>

#include "report/colour.h"
#include "report/sections.h"

namespace pigment::report {
namespace {

struct RunPlot {
  std::size_t run;
  const Plot* plot;
};

void colour_by_run(Series& s, std::size_t run, std::size_t runs, const std::string& name) {
  s.name = name;
  s.legend = true;
  s.colour = static_cast<int>(run);
  s.fixed_colour.clear();
  s.error.clear();
  // More runs than the palette has colours: shades along one scale, in the order given.
  if (runs > 8) s.fixed_colour = to_hex(sequential(0.1 + 0.75 * static_cast<double>(run) / static_cast<double>(runs - 1)));
}

// All in the unit of the first: pressures come in Pa or kPa.
void convert(Series& s, const std::string& from, const std::string& to) {
  const double factor = from == to ? 1 : from == "kPa" ? 1000 : 1e-3;
  for (double& v : s.y) v *= factor;
}
bool comparable(const Plot& a, const Plot& b) {
  const auto pressure = [](const Plot& p) { return p.y.unit == "Pa" || p.y.unit == "kPa"; };
  return a.x.unit == b.x.unit && (a.y.unit == b.y.unit || (pressure(a) && pressure(b)));
}

Plot empty_copy(const Plot& like, const std::string& series) {
  Plot plot = like;
  plot.series.clear(), plot.frames.clear(), plot.markers.clear(), plot.note.clear();
  if (!series.empty()) plot.title += ": " + series;
  return plot;
}

// One plot a curve's name ("free surface", "99 % below"), a curve a run.
void overlay_curves(std::vector<Plot>& out, const std::vector<RunPlot>& all, const std::vector<std::string>& names) {
  const auto& first = all.front().plot->series;
  for (const Series& wanted : first) {
    Plot plot = empty_copy(*all.front().plot, first.size() > 1 ? wanted.name : "");
    for (const RunPlot& p : all)
      for (const Series& s : p.plot->series)
        if (s.name == wanted.name) {
          plot.series.push_back(s);
          convert(plot.series.back(), p.plot->y.unit, plot.y.unit);
          colour_by_run(plot.series.back(), p.run, names.size(), names[p.run]);
          break;
        }
    if (plot.series.size() > 1) out.push_back(std::move(plot));
  }
}

// With a slider over the times of the longest run; a run that has ended stays as it was at its end.
void overlay_frames(std::vector<Plot>& out, const std::vector<RunPlot>& all, const std::vector<std::string>& names) {
  const Plot& longest = *std::max_element(all.begin(), all.end(), [](const RunPlot& a, const RunPlot& b) {
                           return a.plot->frames.back().time < b.plot->frames.back().time;
                         })->plot;
  const std::size_t slots = longest.frames.back().series.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    Plot plot = empty_copy(longest, slots > 1 ? longest.frames.back().series[slot].name : "");
    plot.x.high.reset();
    for (const PlotFrame& at : longest.frames) {
      PlotFrame frame{at.label, {}, at.time};
      for (const RunPlot& p : all) {
        const auto& frames = p.plot->frames;
        const auto nearest = std::min_element(frames.begin(), frames.end(), [&](const PlotFrame& a, const PlotFrame& b) {
          return std::abs(a.time - at.time) < std::abs(b.time - at.time);
        });
        if (slot >= nearest->series.size()) continue;
        frame.series.push_back(nearest->series[slot]);
        colour_by_run(frame.series.back(), p.run, names.size(), names[p.run]);
      }
      plot.frames.push_back(std::move(frame));
    }
    if (plot.frames.back().series.size() > 1) out.push_back(std::move(plot));
  }
}

}  // namespace

void add_overlays(HtmlReport& page, const std::vector<RunView>& views) {
  std::vector<HtmlReport> drafts;
  std::vector<std::string> names;
  for (const RunView& view : views) {
    HtmlReport draft("");
    add_dewatering(draft, view);
    add_development(draft, view);
    add_profiles(draft, view);
    add_clusters(draft, view);
    add_separations(draft, view);
    add_mobility(draft, view);
    add_packing(draft, view);
    add_numerics(draft, view);
    drafts.push_back(std::move(draft));
    names.push_back(view.files.name);
  }
  // In the order of the first run that has the plot.
  std::vector<std::pair<std::string, std::string>> seen;
  std::vector<std::pair<std::string, std::vector<Plot>>> sections;
  for (const HtmlReport& draft : drafts)
    for (const DrawnPlot& drawn : draft.drawn()) {
      const std::pair key{drawn.section, drawn.plot.title};
      if (std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
      seen.push_back(key);
      std::vector<RunPlot> all;
      for (std::size_t r = 0; r < drafts.size(); ++r)
        for (const DrawnPlot& other : drafts[r].drawn())
          if (other.section == drawn.section && other.plot.title == drawn.plot.title &&
              comparable(drawn.plot, other.plot) && other.plot.frames.empty() == drawn.plot.frames.empty())
            all.push_back({r, &other.plot});
      if (all.size() < 2) continue;
      auto section = std::find_if(sections.begin(), sections.end(), [&](const auto& s) { return s.first == drawn.section; });
      if (section == sections.end()) section = sections.insert(sections.end(), {drawn.section, {}});
      (drawn.plot.frames.empty() ? overlay_curves : overlay_frames)(section->second, all, names);
    }
  for (const auto& [title, plots] : sections) {
    if (plots.empty()) continue;
    page.section(title);
    page.plots(plots);
  }
}

}  // namespace pigment::report
