#include "analysis/parameters.h"

#include <algorithm>
#include <cmath>

namespace pigment::analysis {

namespace {

std::optional<double> automatic_or(config::Node& node, const std::string& key, Dimension dimension,
                                   config::Range range) {
  if (node.has(key) && !node.is_word(key, "auto")) return node.quantity(key, dimension, range);
  node.accept_word(key, "auto");
  return std::nullopt;
}

int count(config::Node& node, const std::string& key, int default_value, int most = 10000) {
  return static_cast<int>(node.integer(key, default_value, config::between(1, most)));
}

// A list of ids, or `auto`.
std::optional<std::vector<std::int64_t>> ids(config::Node& node, const std::string& key) {
  if (!node.has(key) || node.is_word(key, "auto")) {
    node.accept_word(key, "auto");
    return std::nullopt;
  }
  std::vector<std::int64_t> result;
  for (const double id : node.quantities(key, Dimension::Number, {})) {
    if (id != std::floor(id) || std::abs(id) > 9e15) node.error(key, "must be auto or ids of particles, whole numbers");
    result.push_back(static_cast<std::int64_t>(id));
  }
  return result;
}

bool rises(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), [](double a, double b) { return !(a < b); }) ==
         values.end();
}

}  // namespace

std::size_t Parameters::size_class(double diameter) const {
  return static_cast<std::size_t>(std::lower_bound(size_classes.begin(), size_classes.end(), diameter) -
                                  size_classes.begin());
}

Parameters read_analysis(config::Node node) {
  Parameters p;
  p.slices = count(node, "slices", p.slices);
  p.size_classes =
      node.quantities("size_classes", Dimension::Length, {"0.3 um", "0.5 um", "1 um"}, config::positive());
  if (!rises(p.size_classes)) node.error("size_classes", "the diameters must rise");
  p.cake_solids =
      node.quantity("cake_solids", Dimension::VolumeFraction, "55 vol%", config::strictly_between(0, 1));
  p.wall_layer = node.quantity("wall_layer", Dimension::Length, "1 um", config::non_negative());
  p.envelope_column = node.quantity("envelope_column", Dimension::Length, "0.25 um", config::positive());
  p.immobilisation_shrinkage = node.number("immobilisation_shrinkage", p.immobilisation_shrinkage, config::strictly_between(0, 1));
  p.immobilisation_ratio = node.number("immobilisation_ratio", p.immobilisation_ratio, config::positive());
  p.structure = node.choice<Parameters::Structure>("structure",
                                                   {{"none", Parameters::Structure::None},
                                                    {"last", Parameters::Structure::Last},
                                                    {"all", Parameters::Structure::All}},
                                                   "last");
  p.pore_points = count(node, "pore_points", p.pore_points, 10'000'000);
  p.pore_bins = count(node, "pore_bins", p.pore_bins);
  p.cluster_threshold = node.quantity("cluster_threshold", Dimension::Length, "20 nm", config::positive());
  p.separation_limit = automatic_or(node, "separation_limit", Dimension::Length, config::positive());
  p.separation_bins = count(node, "separation_bins", p.separation_bins);
  p.near_separation_limit =
      node.quantity("near_separation_limit", Dimension::Length, "50 nm", config::positive());
  p.near_separation_bins = count(node, "near_separation_bins", p.near_separation_bins);
  p.radial_limit = automatic_or(node, "radial_limit", Dimension::Length, config::positive());
  p.radial_bins = count(node, "radial_bins", p.radial_bins);
  p.mobility_start = node.quantity("mobility_start", Dimension::Time, "0 s", config::non_negative());
  p.mobility_end = automatic_or(node, "mobility_end", Dimension::Time, config::positive());
  if (p.mobility_end && *p.mobility_end <= p.mobility_start)
    node.error("mobility_end", "must lie after mobility_start");
  p.mobility_interval = automatic_or(node, "mobility_interval", Dimension::Time, config::positive());
  p.displacement_limit = automatic_or(node, "displacement_limit", Dimension::Length, config::positive());
  p.displacement_bins = count(node, "displacement_bins", p.displacement_bins);
  p.height_bands = count(node, "height_bands", p.height_bands, 100);
  p.surface_band =
      node.quantities("surface_band", Dimension::Length, {"0.5 um", "2 um"}, config::non_negative());
  if (p.surface_band.size() != 2 || !rises(p.surface_band)) {
    node.error("surface_band",
               "must be two depths below the surface, the smaller first; write e.g. [0.5 um, 2 um]");
    p.surface_band = {0.5, 2.0};
  }
  p.trajectories = ids(node, "trajectories");
  return p;
}

}  // namespace pigment::analysis
