// What went into a run: the packing, the calibration of Brownian motion, and where every file comes from.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "io/h5.h"
#include "report/sections.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

// Share of the particles (by number or by volume) that are finer than each diameter, in per cent.
Series finer(const std::vector<double>& radius, bool by_volume, const char* name) {
  std::vector<double> sorted = radius;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> sum;
  double total = 0;
  for (const double a : sorted) sum.push_back(total += by_volume ? Particles::sphere_volume(a) : 1);
  Series s{name, {}, {}};
  const std::size_t every = std::max<std::size_t>(1, sorted.size() / 400);
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (i % every == 0 || i + 1 == sorted.size())
      s.x.push_back(2 * sorted[i]), s.y.push_back(100 * sum[i] / total);
  return s;
}

}  // namespace

void add_packing(HtmlReport& page, const RunView& view) {
  const io::ParticleFile* file = view.files.particles();
  if (!file || file->particle_count() < 2) return;
  std::vector<Plot> plots;
  Plot sizes;
  sizes.title = "Particle sizes";
  sizes.x = {"diameter", "µm", {}, {}, true, false};
  sizes.y = {"finer", "%", 0, 100, false, false};
  const auto& radius = file->particles().radius;
  const auto [small, large] = std::minmax_element(radius.begin(), radius.end());
  if (*large > 1.001 * *small) {
    sizes.series = {finer(radius, true, "by volume"), finer(radius, false, "by number")};
    plots.push_back(sizes);
  }
  std::string text;
  if (view.files.packing && io::h5::InputFile(view.files.packing->path()).is_group("/packing")) {
    const io::ResultFile report = io::read_result(view.files.packing->path(), "packing");
    const auto number = [&](const char* name, double factor) -> std::optional<double> {
      const auto* d = report.find(std::string("/packing/") + name);
      if (!d || d->values.size() != 1) return {};
      return factor * d->values.front();
    };
    if (const auto gap = number("smallest_gap", 1000))
      text += fmt::format("Smallest gap between particles {} nm. ", number_text(*gap));
    if (const auto p = number("sizes/weight_p_value", 1))
      text +=
          fmt::format("Sizes against the law they were drawn from, by weight: Kolmogorov-Smirnov p = {}. ",
                      number_text(*p, 2));
    const Rows edges = rows_of(report, "/packing/profile/z_edges", {}, 1);
    if (const Rows profile = rows_of(report, "/packing/profile/volume_fraction", {}, 1);
        profile && edges.rows == profile.rows + 1) {
      Plot plot;
      plot.title = "Solids of the packing over the height";
      plot.x = {"height", "µm", {}, {}, false, true};
      plot.y = {"solids", "vol%", {}, {}, false, true};
      Series s{"", edges.all(), scaled(profile.all(), 100)};
      s.style = SeriesStyle::Steps;
      plot.series.push_back(std::move(s));
      plots.push_back(std::move(plot));
    }
  }
  if (plots.empty()) return;
  page.section("Packing", text);
  page.plots(plots);
}

void add_brownian_calibration(HtmlReport& page, const RunView& view) {
  const auto* file = view.files.result("kbrown");
  if (!file) return;
  const Rows temperature = rows_of(*file, "/kbrown/temperature", {}, 1);
  if (!temperature) return;
  const Rows value = rows_of(*file, "/kbrown/value", temperature.rows, 1),
             deviation = rows_of(*file, "/kbrown/standard_deviation", temperature.rows, 1);
  const Rows closed = rows_of(*file, "/kbrown/closed_form", temperature.rows, 1),
             step = rows_of(*file, "/kbrown/time_step", temperature.rows, 1);
  const auto si = [](const Rows& rows) {
    return scaled(rows.all(), 1 / to_engine(Dimension::BrownianConstant, 1));
  };
  std::vector<double> celsius = temperature.all();
  for (double& t : celsius) t -= 273.15;
  page.section("Brownian motion",
               "K_Brown as calibrated by simulations of a single particle (bars: standard deviation over the "
               "simulations), "
               "beside its closed form for the same time step.");
  if (temperature.rows > 1 && value) {
    Plot plot;
    plot.title = "K_Brown against temperature";
    plot.x = {"temperature", "°C", {}, {}, false, false};
    plot.y = {"K_Brown", "N/√m", {}, {}, false, false};
    plot.series.push_back({"calibrated", celsius, si(value),
                           deviation ? si(deviation) : std::vector<double>{}, SeriesStyle::Points, 0});
    if (closed) plot.series.push_back({"closed form", celsius, si(closed), {}, SeriesStyle::Dashed, 1});
    page.plots({plot});
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < temperature.rows; ++i) {
    const auto cell = [&](const std::vector<double>& v, int digits) {
      return i < v.size() ? number_text(v[i], digits) : std::string("–");
    };
    std::string against = "–";
    if (value && closed && closed.at(i) != 0)
      against = number_text(100 * (value.at(i) / closed.at(i) - 1), 2) + " %";
    rows.push_back({cell(celsius, 4), step ? time_text(step.at(i)) : "–", value ? cell(si(value), 5) : "–",
                    deviation ? cell(si(deviation), 2) : "–", closed ? cell(si(closed), 5) : "–", against});
  }
  page.table(
      {"temperature (°C)", "time step", "K_Brown (N/√m)", "standard deviation", "closed form", "difference"},
      rows);
}

void add_provenance(HtmlReport& page, const RunView& view) {
  if (view.files.sources.empty()) return;
  page.section("Provenance",
               "Every file names the tool that wrote it, the inputs by their SHA-256, and the parts of the "
               "scene that the tool read.");
  std::vector<std::vector<std::string>> rows;
  for (const SourceFile& s : view.files.sources) {
    std::string inputs;
    for (const auto& [role, hash] : s.provenance.inputs)
      inputs += (inputs.empty() ? "" : "; ") + role + " " + hash.substr(0, 16);
    rows.push_back({s.path.filename().string(), s.kind,
                    s.provenance.tool.empty() ? "made by hand" : s.provenance.tool + " " + s.version,
                    inputs.empty() ? "–" : inputs, io::sha256_of_file(s.path).substr(0, 16)});
  }
  page.table({"file", "kind", "made by", "from (SHA-256)", "its own SHA-256"}, rows);
  // The scene, once for each set of blocks that differs; the run's own first.
  std::vector<SourceFile> sources = view.files.sources;
  std::stable_sort(sources.begin(), sources.end(), [](const SourceFile& a, const SourceFile& b) {
    return (a.kind == "trajectory") > (b.kind == "trajectory");
  });
  std::vector<std::string> shown;
  for (const SourceFile& s : sources) {
    if (s.provenance.scene.empty() ||
        std::find(shown.begin(), shown.end(), s.provenance.scene) != shown.end())
      continue;
    shown.push_back(s.provenance.scene);
    page.folded("scene as read by " + s.provenance.tool, s.provenance.scene);
  }
}

}  // namespace pigment::report
