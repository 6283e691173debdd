// Curves in time: dewatering, the layer's development, numerics.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/sections.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

// Long curves carry no more points than a plot can show.
void add_thinned(Plot& plot, Series series) {
  constexpr std::size_t most = 1500;
  const std::size_t points = std::min(series.x.size(), series.y.size());
  if (series.style != SeriesStyle::Steps) series.x.resize(points), series.y.resize(points);
  if (series.x.size() > most && series.style != SeriesStyle::Steps) {
    const std::size_t every = (series.x.size() + most - 1) / most;
    Series thin = series;
    thin.x.clear(), thin.y.clear();
    for (std::size_t i = 0; i < series.x.size(); ++i)
      if (i % every == 0 || i + 1 == series.x.size())
        thin.x.push_back(series.x[i]), thin.y.push_back(series.y[i]);
    series = thin;
  }
  plot.series.push_back(std::move(series));
}

// Adds an observable of the trajectory where it has one; factor: to the plot's unit.
bool add_observable(Plot& plot, const RunView& view, const std::string& name, const std::string& label,
                    double factor, SeriesStyle style = SeriesStyle::Line) {
  if (!view.files.trajectory) return false;
  const auto values = view.files.trajectory->observable(name);
  if (values.size() < 2) return false;
  Series s;
  s.name = label;
  s.x = view.shown_times(view.files.trajectory->observable_time(name));
  s.y = scaled(values, factor);
  s.style = style;
  add_thinned(plot, s);
  return true;
}

Plot in_time(const RunView& view, const std::string& title, const std::string& label,
             const std::string& unit) {
  Plot plot;
  plot.title = title;
  plot.x = view.time_axis();
  plot.y = {label, unit, {}, {}, false, false};
  return plot;
}

void keep(std::vector<Plot>& plots, Plot plot) {
  if (plot.series.empty()) return;
  if (plot.series.size() == 1) plot.series.front().legend = false;
  plots.push_back(std::move(plot));
}

double largest(const Plot& plot) {
  double most = 0;
  for (const Series& s : plot.series)
    for (const double v : s.y) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

void add_dewatering(HtmlReport& page, const RunView& view) {
  const auto* file = view.files.result("dewatering");
  if (!file) return;
  const Rows time = rows_of(*file, "/dewatering/time", {}, 1);
  if (time.rows < 2) return;
  RunView own = view;  // the plan may be longer than the run
  own.longest_time = time.at(time.rows - 1);
  own.in_seconds = own.longest_time >= 100;
  const auto times = own.shown_times(time.all());
  const auto column = [&](const char* name) {
    return rows_of(*file, std::string("/dewatering/") + name, time.rows, 1);
  };

  Plot flux = in_time(own, "Liquid flux", "flux", "µm/s");
  flux.y.from_zero = true;
  if (const Rows q = column("absorption_flux"))
    add_thinned(flux, {"absorption", times, scaled(q.all(), 1000), {}, SeriesStyle::Line, 0});
  if (const Rows e = column("evaporation_flux"))
    add_thinned(flux, {"evaporation", times, scaled(e.all(), 1000), {}, SeriesStyle::Line, 1});
  // Darcy absorption is singular at t = 0: the axis ends where all but the first hundredth of the time fits.
  double later = 0;
  for (const Series& s : flux.series)
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (s.x[i] >= 0.01 * s.x.back()) later = std::max(later, s.y[i]);
  if (later > 0 && largest(flux) > 1.5 * later) {
    flux.y.high = 1.15 * later;
    flux.note = "Absorption begins above the plot's upper edge.";
  }
  Plot removed = in_time(own, "Liquid removed", "liquid removed", "µm");
  removed.y.from_zero = true;
  const Rows absorbed = column("absorbed"), evaporated = column("evaporated");
  if (absorbed) add_thinned(removed, {"absorbed", times, absorbed.all(), {}, SeriesStyle::Line, 0});
  if (evaporated) add_thinned(removed, {"evaporated", times, evaporated.all(), {}, SeriesStyle::Line, 1});
  if (absorbed && evaporated) {
    std::vector<double> both = absorbed.all();
    for (std::size_t i = 0; i < both.size(); ++i) both[i] += evaporated.at(i);
    add_thinned(removed, {"both", times, both, {}, SeriesStyle::Line, 2});
  }
  if (view.immobilisation_time && *view.immobilisation_time <= own.longest_time)
    flux.markers = removed.markers = own.immobilisation_marker();
  std::vector<Plot> plots;
  keep(plots, flux);
  keep(plots, removed);
  Plot temperature = in_time(own, "Temperature", "temperature", "°C");
  if (const Rows t = column("temperature")) {
    std::vector<double> celsius = t.all();
    for (double& v : celsius) v -= 273.15;
    add_thinned(temperature, {"temperature", times, celsius});
  }
  keep(plots, temperature);
  if (plots.empty()) return;
  page.section("Dewatering",
               "What the run is told to remove: absorption into the substrate below, evaporation from the "
               "surface above. "
               "One micrometre is one litre of liquid a thousand square metres.");
  page.plots(plots);
}

void add_development(HtmlReport& page, const RunView& view) {
  std::vector<Plot> plots;
  const auto markers = view.immobilisation_marker();
  const auto* solids = view.files.result("solids");
  const Rows time = solids ? rows_of(*solids, "/solids/time", {}, 1) : Rows{};
  const auto from_solids = [&](Plot& plot, const char* name, const char* label, double factor) {
    if (time.rows < 2) return;
    if (const Rows v = rows_of(*solids, std::string("/solids/") + name, time.rows, 1))
      add_thinned(plot, {label, view.shown_times(time.all()), scaled(v.all(), factor)});
  };

  Plot thickness = in_time(view, "Thickness", "height above the substrate", "µm");
  if (!add_observable(thickness, view, "thickness", "free surface", 1))
    from_solids(thickness, "thickness", "thickness", 1);
  if (!add_observable(thickness, view, "z99", "99 % of the solids below", 1))
    from_solids(thickness, "z99", "99 % of the solids below", 1);
  if (!add_observable(thickness, view, "z95", "95 % of the solids below", 1))
    from_solids(thickness, "z95", "95 % of the solids below", 1);
  thickness.markers = markers;
  keep(plots, thickness);

  Plot mass = in_time(view, "Solids", "solids", "wt%");
  if (!add_observable(mass, view, "solids_mass_fraction", "solids", 100))
    from_solids(mass, "mean_mass_fraction", "solids", 100);
  mass.markers = markers;
  keep(plots, mass);

  Plot centre = in_time(view, "Mass centre of the solids", "height of the mass centre", "µm");
  if (!add_observable(centre, view, "mass_centre", "mass centre", 1))
    from_solids(centre, "mass_centre", "mass centre", 1);
  centre.markers = markers;
  if (!markers.empty())
    centre.note = "From the marked time on the particles move with the shrinking layer only.";
  keep(plots, centre);

  Plot pressure = in_time(view, "Pressure", "force per area", "Pa");
  add_observable(pressure, view, "surface_pressure", "free surface", 1);
  add_observable(pressure, view, "substrate_pressure", "substrate", 1);
  add_observable(pressure, view, "liquid_pressure", "liquid at the substrate", 1);
  if (largest(pressure) >= 2000) {
    pressure.y.unit = "kPa";
    for (Series& s : pressure.series) s.y = scaled(s.y, 1e-3);
  }
  pressure.y.from_zero = true;
  pressure.markers = markers;
  keep(plots, pressure);

  Plot dense = in_time(view, "Filter cake and skin", "thickness", "µm");
  if (solids)
    from_solids(dense, "cake_thickness", "cake", 1), from_solids(dense, "skin_thickness", "skin", 1);
  dense.y.from_zero = true;
  dense.markers = markers;
  if (largest(dense) > 0) keep(plots, dense);

  if (solids) {
    const Rows when = rows_of(*solids, "/solids/immobilisation/time", {}, 1);
    Plot motion = in_time(view, "Motion within the layer", "velocity", "µm/s");
    const auto add = [&](const char* name, const char* label, SeriesStyle style) {
      const Rows v = rows_of(*solids, std::string("/solids/immobilisation/") + name, when.rows, 1);
      if (!v || when.rows < 2) return;
      Series s{label, view.shown_times(when.all()), scaled(v.all(), 1000), {}, style};
      for (double& y : s.y) y = y > 0 ? y : NAN;  // the axis is logarithmic
      if (std::any_of(s.y.begin(), s.y.end(), [](double y) { return std::isfinite(y); }))
        add_thinned(motion, s);
    };
    if (when) {
      add("non_affine_velocity", "particles against the shrinking layer (rms)", SeriesStyle::Line);
      add("shrinkage_rate", "free surface", SeriesStyle::Dashed);
    }
    motion.y.logarithmic = true;
    motion.markers = markers;
    keep(plots, motion);
  }
  if (plots.empty()) return;
  page.section("Consolidation");
  page.plots(plots);
}

void add_numerics(HtmlReport& page, const RunView& view) {
  std::vector<Plot> plots;
  Plot step = in_time(view, "Time step", "step", "ms");
  add_observable(step, view, "step_size", "step", 1);
  step.y.logarithmic = true;
  for (Series& s : step.series)
    for (double& y : s.y) y = y > 0 ? y : NAN;
  keep(plots, step);
  Plot iterations = in_time(view, "Solver iterations", "iterations a step", "");
  add_observable(iterations, view, "solver_iterations", "iterations", 1);
  iterations.y.from_zero = true;
  keep(plots, iterations);
  Plot gap = in_time(view, "Smallest gap between two surfaces", "gap", "nm");
  add_observable(gap, view, "minimum_gap", "gap", 1000);
  keep(plots, gap);
  Plot contacts = in_time(view, "Contacts", "pairs in contact", "");
  add_observable(contacts, view, "contacts", "contacts", 1);
  contacts.y.from_zero = true;
  keep(plots, contacts);
  Plot protruding = in_time(view, "Solids above the free surface", "share of the solid volume", "%");
  add_observable(protruding, view, "protruding_fraction", "protruding", 100);
  if (largest(protruding) > 0) keep(plots, protruding);
  if (plots.empty()) return;
  page.section("Numerics");
  page.plots(plots);
}

}  // namespace pigment::report
