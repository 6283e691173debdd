// What the run came to, in a row of numbers; how the page is put together.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/file_header.h"
#include "io/h5.h"
#include "report/sections.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

std::string outcome_text(const std::string& outcome) {
  if (outcome == "immobile") return "immobile";
  if (outcome == "until") return "end time reached";
  if (outcome == "first_critical_concentration") return "first critical concentration";
  return outcome;
}

std::vector<double> observable_or_result(const RunView& view, const std::string& observable,
                                         const std::string& solids_path) {
  std::vector<double> values;
  if (view.files.trajectory) values = view.files.trajectory->observable(observable);
  if (values.empty())
    if (const auto* solids = view.files.result("solids")) values = rows_of(*solids, solids_path).all();
  return values;
}

double solid_volume(const Particles& particles) {
  double volume = 0;
  for (const double a : particles.radius) volume += Particles::sphere_volume(a);
  return volume;
}

std::string from_to(double first, double last, int digits) {
  return fmt::format("from {}", number_text(first, digits)) +
         (first == last ? "" : fmt::format(" to {}", number_text(last, digits)));
}

}  // namespace

RunView::RunView(const RunFiles& f) : files(f) {
  if (files.trajectory && !files.trajectory->times().empty()) longest_time = files.trajectory->times().back();
  if (longest_time == 0)
    for (const auto& [kind, result] : files.results)
      if (const auto* time = result.find("/" + kind + "/time"))
        for (const double t : time->values) longest_time = std::max(longest_time, t);
  in_seconds = longest_time >= 100;
  if (const auto* solids = files.result("solids"))
    if (const auto found = solids->numbers.find("immobilisation_time"); found != solids->numbers.end())
      immobilisation_time = to_engine(Dimension::Time, found->second);
  if (!immobilisation_time && files.trajectory && files.trajectory->outcome() == "immobile")
    immobilisation_time = longest_time;
}

std::vector<double> RunView::shown_times(std::vector<double> times) const {
  for (double& t : times) t = shown_time(t);
  return times;
}

std::string RunView::when(double milliseconds) const {
  return number_text(shown_time(milliseconds), 4) + (in_seconds ? " s" : " ms");
}

std::vector<MarkerLine> RunView::immobilisation_marker() const {
  if (!immobilisation_time) return {};
  return {{shown_time(*immobilisation_time), "immobile"}};
}

namespace {

std::vector<Headline> headlines_of(const RunView& view) {
  std::vector<Headline> numbers;
  const auto* trajectory = view.files.trajectory.get();
  if (trajectory && !trajectory->outcome().empty()) {
    numbers.push_back({"Outcome", outcome_text(trajectory->outcome()), "", ""});
    if (view.longest_time > 0) numbers.back().note = "after " + view.when(view.longest_time);
  }
  if (view.immobilisation_time)
    numbers.push_back(
        {"Immobile from", view.when(*view.immobilisation_time), "", "particles move with the layer only"});
  if (const auto solids = observable_or_result(view, "solids_mass_fraction", "/solids/mean_mass_fraction");
      !solids.empty()) {
    numbers.push_back(
        {solids.size() > 1 ? "Final solids" : "Solids", number_text(100 * solids.back(), 3), "wt%", ""});
    if (solids.size() > 1) numbers.back().note = "from " + number_text(100 * solids.front(), 3) + " wt%";
  }
  if (const auto* file = view.files.particles()) {
    const Layer first = file->layer(0);
    const std::size_t last = file->frame_count() - 1;
    const Cell cell = last == 0 ? first.cell : file->frame(last).cell;
    numbers.push_back({last == 0 ? "Thickness" : "Final thickness", number_text(cell.height, 4), "µm", ""});
    if (last > 0) numbers.back().note = from_to(first.cell.height, first.cell.height, 4) + " µm";
    const double volume = solid_volume(first.particles);
    numbers.push_back(
        {"Solids by volume", number_text(100 * volume / (cell.area() * cell.height), 3), "vol%", ""});
    if (last > 0)
      numbers.back().note =
          "from " + number_text(100 * volume / (first.cell.area() * first.cell.height), 3) + " vol%";
    numbers.push_back({"Particles", std::to_string(file->particle_count()), "", ""});
    const auto [small, large] =
        std::minmax_element(first.particles.radius.begin(), first.particles.radius.end());
    if (small != first.particles.radius.end())
      numbers.back().note = "diameters " + number_text(2 * *small, 3) +
                            (*small == *large ? "" : " to " + number_text(2 * *large, 3)) + " µm";
    numbers.push_back(
        {"Cell", number_text(cell.width_x, 3) + " × " + number_text(cell.width_y, 3), "µm", "periodic"});
  }
  if (const auto* dewatering = view.files.result("dewatering")) {
    const Rows absorbed = rows_of(*dewatering, "/dewatering/absorbed"),
               evaporated = rows_of(*dewatering, "/dewatering/evaporated");
    if (absorbed && evaporated)
      numbers.push_back({"Liquid removed", number_text(absorbed.all().back() + evaporated.all().back(), 3),
                         "µm",
                         number_text(absorbed.all().back(), 3) + " absorbed, " +
                             number_text(evaporated.all().back(), 3) + " evaporated"});
  }
  if (trajectory)
    if (const auto pressure = trajectory->observable("surface_pressure"); !pressure.empty()) {
      const bool small = std::abs(pressure.back()) < 1000;
      numbers.push_back({"Surface pressure", number_text(pressure.back() / (small ? 1 : 1000), 3),
                         small ? "Pa" : "kPa", "at the end"});
    }
  if (const auto* cluster = view.files.result("cluster"))
    if (const Rows clustered = rows_of(*cluster, "/cluster/clustered_fraction"))
      numbers.push_back(
          {"Clustered", number_text(100 * clustered.all().back(), 3), "%", "of the particles, at the end"});
  return numbers;
}

// Every run's headline numbers, one run a row.
void add_comparison(HtmlReport& page, const std::vector<RunView>& views) {
  std::vector<std::string> head{"run"};
  std::vector<std::vector<std::string>> rows;
  for (const RunView& view : views) {
    std::vector<std::string> row{view.files.name};
    for (const Headline& h : headlines_of(view)) {
      const auto column = std::find(head.begin(), head.end(), h.label);
      const auto at = static_cast<std::size_t>(column - head.begin());
      if (column == head.end()) head.push_back(h.label);
      row.resize(std::max(row.size(), at + 1), "–");
      row[at] = h.unit.empty() ? h.value : h.value + " " + h.unit;
    }
    rows.push_back(std::move(row));
  }
  for (auto& row : rows) row.resize(head.size(), "–");
  page.section("Runs");
  page.table(head, rows);
}

}  // namespace

void add_overview(HtmlReport& page, const RunView& view) {
  if (const auto numbers = headlines_of(view); !numbers.empty()) page.headlines(numbers);
  if (const auto* trajectory = view.files.trajectory.get(); trajectory && trajectory->outcome() == "failed") {
    const auto attributes = io::read_header(io::h5::InputFile(trajectory->path())).attributes;
    const auto reason = attributes.find("reason");
    page.remark("The run failed" + (reason == attributes.end() ? "." : ": " + reason->second));
  }
}

HtmlReport compose_report(const std::vector<RunFiles>& runs, const std::vector<StudyFiles>& studies,
                          const std::string& title, const PictureWishes& wishes) {
  std::string subtitle;
  if (runs.size() == 1)
    if (const auto* file = runs.front().particles())
      subtitle = fmt::format("{} particles{}", file->particle_count(),
                             file->frame_count() > 1 ? fmt::format(", {} frames", file->frame_count()) : "");
  if (runs.size() > 1) subtitle = fmt::format("{} runs", runs.size());
  HtmlReport page(title, subtitle);
  const bool chapters = runs.size() + studies.size() > 1;
  for (const StudyFiles& study : studies) {
    if (chapters) page.chapter(studies.size() > 1 ? study.name : "Findings");
    add_study(page, study);
  }
  std::vector<RunView> views(runs.begin(), runs.end());
  const bool seconds = std::any_of(views.begin(), views.end(), [](const RunView& v) { return v.in_seconds; });
  for (RunView& v : views) v.in_seconds = seconds;  // runs that stand side by side are read in one unit
  if (runs.size() > 1) {
    page.chapter("Runs side by side");
    add_comparison(page, views);
    add_viewer(page, views, wishes);
    add_overlays(page, views);
  }
  for (const RunView& view : views) {
    if (chapters) page.chapter(view.files.name);
    page.section("Summary");
    add_overview(page, view);
    add_pictures(page, view, wishes);
    if (runs.size() == 1) add_viewer(page, views, wishes);
    add_dewatering(page, view);
    add_development(page, view);
    add_profiles(page, view);
    add_clusters(page, view);
    add_separations(page, view);
    add_mobility(page, view);
    add_packing(page, view);
    add_brownian_calibration(page, view);
    add_numerics(page, view);
    add_provenance(page, view);
  }
  return page;
}

}  // namespace pigment::report
