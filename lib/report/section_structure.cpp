// What the analyses say: profiles over the thickness, clusters, separations, mobility.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "report/sections.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}
std::vector<double> middles(const std::vector<double>& edges) {
  std::vector<double> out;
  for (std::size_t i = 1; i < edges.size(); ++i) out.push_back(0.5 * (edges[i - 1] + edges[i]));
  return out;
}

// Times as shades of one scale, early to late, readable on light and dark paper.
std::string shade_of(std::size_t k, std::size_t count) {
  const double t = count < 2 ? 0.5 : static_cast<double>(k) / static_cast<double>(count - 1);
  return to_hex(sequential(0.28 + 0.54 * t));
}

// A plot with one curve a chosen time, and a slider over (at most 120 of) all times.
template <typename Curve>
void add_times(Plot& plot, const RunView& view, const std::vector<double>& time, std::size_t shown,
               const Curve& curve) {
  const auto chosen = evenly_in_time(time, shown);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    Series s = curve(chosen[k]);
    s.name = view.when(time[chosen[k]]);
    s.fixed_colour = shade_of(k, chosen.size());
    plot.series.push_back(std::move(s));
  }
  if (time.size() < 2) return;
  for (const std::size_t k : evenly_in_time(time, 120)) {
    Series s = curve(k);
    s.name = "slider";
    s.fixed_colour = "var(--mark)";
    plot.frames.push_back({view.when(time[k]), {std::move(s)}, time[k]});
  }
}

std::string class_name(const std::vector<double>& borders, std::size_t c) {
  if (borders.empty()) return "all sizes";
  if (c == 0) return "up to " + number_text(borders.front()) + " µm";
  if (c >= borders.size()) return "above " + number_text(borders.back()) + " µm";
  return number_text(borders[c - 1]) + " to " + number_text(borders[c]) + " µm";
}

// A dataset of three dimensions [intervals, bands, bins].
struct Cube {
  const io::Dataset* dataset = nullptr;
  std::vector<double> line(std::size_t i, std::size_t j) const {
    const std::size_t n = dataset->shape[2], first = (i * dataset->shape[1] + j) * n;
    return {dataset->values.begin() + static_cast<std::ptrdiff_t>(first),
            dataset->values.begin() + static_cast<std::ptrdiff_t>(first + n)};
  }
};
// Where 99 % of the particles lie in nine of ten of the distributions: the few long first steps would squeeze
// the rest.
double usual_reach(const Cube& cube, const std::vector<double>& edges) {
  std::vector<double> reach;
  for (std::size_t i = 0; i < cube.dataset->shape[0]; ++i)
    for (std::size_t j = 0; j < cube.dataset->shape[1]; ++j) {
      const std::vector<double> density = cube.line(i, j);
      double total = 0, below = 0;
      for (std::size_t k = 0; k < density.size(); ++k) total += density[k] * (edges[k + 1] - edges[k]);
      std::size_t k = 0;
      while (k < density.size() && below < 0.99 * total) below += density[k] * (edges[k + 1] - edges[k]), ++k;
      reach.push_back(edges[k]);
    }
  if (reach.empty()) return edges.back();
  std::sort(reach.begin(), reach.end());
  const double usual = reach[reach.size() * 9 / 10];
  return usual > 0 ? usual : edges.back();
}
Cube cube_of(const io::ResultFile& file, const std::string& path, std::size_t intervals, std::size_t bins) {
  const io::Dataset* d = file.find(path);
  if (d && (d->shape.size() != 3 || d->shape[0] != intervals || d->shape[2] != bins))
    throw FileError(fmt::format("{}: {}: has not the shape [{}, bands, {}] that time and edges ask for",
                                file.file.string(), path, intervals, bins));
  return {d};
}

}  // namespace

void add_profiles(HtmlReport& page, const RunView& view) {
  const auto* file = view.files.result("solids");
  if (!file) return;
  const Rows time = rows_of(*file, "/solids/time", {}, 1);
  if (!time) return;
  const Rows edges = rows_of(*file, "/solids/z_edges", time.rows);
  if (edges.columns < 2) return;
  const std::size_t slices = edges.columns - 1;
  const auto heights = [&](std::size_t k) { return middles(edges.row(k)); };
  std::vector<Plot> plots;
  const auto profile = [&](const char* name, const char* title, const char* unit) {
    const Rows values = rows_of(*file, std::string("/solids/") + name, time.rows, slices);
    if (!values) return;
    Plot plot;
    plot.title = title;
    plot.x = {"solids", unit, {}, {}, false, false};
    plot.y = {"height", "µm", 0, {}, false, true};
    plot.read_by_height = true;
    plot.height = 420;
    add_times(plot, view, time.all(), 6, [&](std::size_t k) {
      return Series{"", scaled(values.row(k), 100), heights(k)};
    });
    plots.push_back(std::move(plot));
  };
  profile("mass_fraction", "Solids over the height, by weight", "wt%");
  profile("volume_fraction", "Solids over the height, by volume", "vol%");

  // Size classes over the relative height, so that layers of any thickness compare.
  const auto borders = rows_of(*file, "/solids/size_class_borders", {}, 1).all();
  const auto classes = [&](const char* name, const char* title, const char* label, double factor,
                           const char* unit) {
    Plot plot;
    plot.title = title;
    plot.x = {label, unit, {}, {}, false, true};
    plot.y = {"height", "µm", 0, {}, false, true};
    plot.read_by_height = true;
    plot.height = 420;
    std::vector<Rows> values;
    for (std::size_t c = 0; c <= borders.size(); ++c)
      values.push_back(rows_of(*file, fmt::format("/solids/size_class_{}/{}", c, name), time.rows, slices));
    if (std::none_of(values.begin(), values.end(), [](const Rows& r) { return bool(r); })) return;
    for (const std::size_t k : evenly_in_time(time.all(), time.rows > 1 ? 120 : 1)) {
      PlotFrame frame{view.when(time.at(k)), {}, time.at(k)};
      for (std::size_t c = 0; c < values.size(); ++c)
        if (values[c])
          frame.series.push_back({class_name(borders, c),
                                  scaled(values[c].row(k), factor),
                                  heights(k),
                                  {},
                                  SeriesStyle::Line,
                                  static_cast<int>(c)});
      plot.frames.push_back(std::move(frame));
    }
    plots.push_back(std::move(plot));
  };
  if (!borders.empty()) {
    classes("number_fraction", "Size classes over the height, by number",
            "share of the particles at that height", 100, "%");
    classes("volume_fraction", "Size classes over the height, by volume", "solids of the class", 100, "vol%");
  }
  if (plots.empty()) return;
  page.section("Solids profiles",
               "Profiles from the substrate (height 0) to the surface. The slider goes through the frames; "
               "the thin lines stay.");
  page.plots(plots);
}

void add_clusters(HtmlReport& page, const RunView& view) {
  const auto* file = view.files.result("cluster");
  if (!file) return;
  const Rows time = rows_of(*file, "/cluster/time", {}, 1);
  if (!time) return;
  std::vector<Plot> plots;
  const auto times = view.shown_times(time.all());
  const auto add = [&](Plot& plot, const char* name, const char* label, double factor, int colour) {
    if (const Rows v = rows_of(*file, std::string("/cluster/") + name, time.rows, 1))
      plot.series.push_back({label,
                             times,
                             scaled(v.all(), factor),
                             {},
                             time.rows > 1 ? SeriesStyle::Line : SeriesStyle::Points,
                             colour});
  };
  Plot share{"Particles in clusters",
             "",
             view.time_axis(),
             {"share of the particles", "%", {}, {}, false, true},
             {},
             view.immobilisation_marker(),
             {}};
  add(share, "clustered_fraction", "in any cluster", 100, 0);
  add(share, "largest_fraction", "in the largest cluster", 100, 1);
  add(share, "clustered_volume_fraction", "in any cluster, by volume", 100, 2);
  if (!share.series.empty()) plots.push_back(share);
  Plot number{"Number of clusters",         "", view.time_axis(), {"clusters", "", {}, {}, false, true}, {},
              view.immobilisation_marker(), {}};
  add(number, "count", "", 1, 0);
  if (!number.series.empty()) plots.push_back(number);
  Plot tall{"Tallest cluster",
            "",
            view.time_axis(),
            {"vertical extent", "µm", {}, {}, false, true},
            {},
            view.immobilisation_marker(),
            {}};
  add(tall, "largest_extent", "", 1, 0);
  if (!tall.series.empty()) plots.push_back(tall);
  if (plots.empty()) return;
  std::string text;
  if (const auto found = file->numbers.find("threshold"); found != file->numbers.end())
    text = fmt::format("Particles whose surfaces are closer than {} nm are connected.",
                       number_text(1e9 * found->second));
  page.section("Clusters", text);
  page.plots(plots);
}

void add_separations(HtmlReport& page, const RunView& view) {
  const auto* file = view.files.result("separation");
  if (!file) return;
  const Rows edges = rows_of(*file, "/separation/edges", {}, 1),
             time = rows_of(*file, "/separation/time", {}, 1);
  if (edges.rows < 2 || !time) return;
  std::vector<Plot> plots;
  if (const Rows density = rows_of(*file, "/separation/density", time.rows, edges.rows - 1)) {
    Plot plot;
    plot.title = "Separations of near neighbours";
    plot.x = {"surface separation", "nm", {}, {}, false, true};
    plot.y = {"probability density", "1/nm", {}, {}, false, true};
    add_times(plot, view, time.all(), 5, [&](std::size_t k) {
      return Series{"", scaled(edges.all(), 1000), scaled(density.row(k), 1e-3), {}, SeriesStyle::Steps};
    });
    plots.push_back(std::move(plot));
  }
  const Rows near = rows_of(*file, "/separation/near_edges", {}, 1);
  if (near)
    if (const Rows cumulative = rows_of(*file, "/separation/near_cumulative", time.rows, near.rows)) {
      Plot plot;
      plot.title = "Near contact";
      plot.x = {"surface separation", "nm", {}, {}, false, true};
      plot.y = {"share of the near pairs that are closer", "%", {}, {}, false, true};
      add_times(plot, view, time.all(), 5, [&](std::size_t k) {
        return Series{"", scaled(near.all(), 1000), scaled(cumulative.row(k), 100)};
      });
      plots.push_back(std::move(plot));
    }
  const auto in_time = [&](const char* name, const char* title, const char* label, const char* unit,
                           double factor) {
    const Rows v = rows_of(*file, std::string("/separation/") + name, time.rows, 1);
    if (v.rows < 2) return;
    Plot plot{
        title, "", view.time_axis(), {label, unit, {}, {}, false, true}, {}, view.immobilisation_marker(),
        {}};
    plot.series.push_back({"", view.shown_times(time.all()), scaled(v.all(), factor)});
    plots.push_back(std::move(plot));
  };
  in_time("mean", "Mean separation", "mean separation", "nm", 1000);
  in_time("neighbours_per_particle", "Near neighbours", "near neighbours a particle", "", 1);
  if (plots.empty()) return;
  std::string text;
  if (const auto found = file->numbers.find("limit"); found != file->numbers.end())
    text = fmt::format("Pairs whose surfaces are closer than {} nm.", number_text(1e9 * found->second));
  page.section("Separations", text);
  page.plots(plots);
}

void add_mobility(HtmlReport& page, const RunView& view) {
  const auto* file = view.files.result("mobility");
  if (!file) return;
  const Rows edges = rows_of(*file, "/mobility/edges", {}, 1), time = rows_of(*file, "/mobility/time", {}, 1);
  if (edges.rows < 2 || !time) return;
  const Rows start = rows_of(*file, "/mobility/start_time", time.rows, 1);
  const auto band_name = [](std::size_t b, std::size_t bands) {
    if (b + 1 == bands) return std::string("below the surface");
    if (b == 0) return std::string("at the substrate");
    return b + 2 == bands ? std::string("top band") : fmt::format("band {}", b + 1);
  };
  std::vector<Plot> plots;
  const auto distribution = [&](const char* name, const char* title) {
    const Cube cube = cube_of(*file, std::string("/mobility/all_sizes/") + name, time.rows, edges.rows - 1);
    if (!cube.dataset) return;
    const std::size_t bands = cube.dataset->shape[1];
    Plot plot;
    plot.title = title;
    plot.x = {"displacement", "nm", {}, {}, false, true};
    plot.y = {"probability density", "1/nm", {}, {}, false, true};
    plot.x.high = 1000 * usual_reach(cube, edges.all());
    for (const std::size_t k : evenly_in_time(time.all(), 120)) {
      PlotFrame frame{(start ? number_text(view.shown_time(start.at(k)), 4) + " to " : std::string("to ")) +
                          view.when(time.at(k)),
                      {},
                      time.at(k)};
      for (std::size_t b = 0; b < bands; ++b)
        frame.series.push_back({band_name(b, bands),
                                scaled(edges.all(), 1000),
                                scaled(cube.line(k, b), 1e-3),
                                {},
                                SeriesStyle::Steps,
                                static_cast<int>(b)});
      plot.frames.push_back(std::move(frame));
    }
    plots.push_back(std::move(plot));
  };
  distribution("vertical", "Vertical displacements by starting height");
  distribution("lateral", "Lateral displacements by starting height");
  const auto in_time = [&](const char* name, const char* title) {
    const Rows v = rows_of(*file, std::string("/mobility/all_sizes/") + name, time.rows);
    if (v.rows < 2) return;
    Plot plot{title,
              "",
              view.time_axis(),
              {"rms displacement a frame", "nm", {}, {}, false, true},
              {},
              view.immobilisation_marker(),
              {}};
    for (std::size_t b = 0; b < v.columns; ++b) {
      Series s{band_name(b, v.columns), view.shown_times(time.all()), {}, {},
               SeriesStyle::Line,       static_cast<int>(b)};
      for (std::size_t k = 0; k < v.rows; ++k) s.y.push_back(1000 * v.at(k, b));
      plot.series.push_back(std::move(s));
    }
    plots.push_back(std::move(plot));
  };
  in_time("rms_vertical", "Vertical mobility in time");
  in_time("rms_lateral", "Lateral mobility in time");
  if (plots.empty()) return;
  page.section("Mobility", "How far particles move between two frames, by the height at which they start.");
  page.plots(plots);
}

}  // namespace pigment::report
