// The layer itself, at four times, at one scale.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/layer_picture.h"
#include "report/sections.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

// Each particle's cluster at the time nearest to the frame's, where the run's cluster file fits it.
std::vector<double> cluster_sizes(const RunView& view, double time, std::size_t particles) {
  const auto* file = view.files.result("cluster");
  if (!file) return {};
  const Rows times = rows_of(*file, "/cluster/time"), sizes = rows_of(*file, "/cluster/size");
  if (!times || sizes.rows != times.rows || sizes.columns != particles) return {};
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < times.rows; ++i)
    if (std::abs(times.at(i) - time) < std::abs(times.at(nearest) - time)) nearest = i;
  return sizes.row(nearest);
}

ColourLegend legend_of(const ParticleColours& colours) {
  ColourLegend legend;
  legend.label = colours.unit.empty() ? colours.label : colours.label + " (" + colours.unit + ")";
  for (std::size_t i = 0; i < colours.categories.size(); ++i)
    legend.colours.push_back(to_hex(categorical(i)));
  legend.names = colours.categories;
  if (!legend.names.empty()) return legend;
  for (int i = 0; i <= 12; ++i) legend.colours.push_back(to_hex(sequential(i / 12.0)));
  const Ticks ticks = scale_ticks(colours, 5);
  for (std::size_t i = 0; i < ticks.values.size(); ++i)
    legend.labels.emplace_back(colours.position(ticks.values[i]), ticks.labels[i]);
  return legend;
}

}  // namespace

void add_pictures(HtmlReport& page, const RunView& view, const PictureWishes& wishes) {
  const io::ParticleFile* file = view.files.particles();
  if (!file || file->particle_count() == 0) return;
  const auto frames = evenly_in_time(file->times(), 4);
  const Layer first = file->layer(0);
  double highest = first.cell.height;
  for (std::size_t i = 0; i < first.position.size(); ++i)
    highest = std::max(highest, first.position[i].z() + first.particles.radius[i]);

  const int most = first.particles.species.empty()
                       ? 0
                       : *std::max_element(first.particles.species.begin(), first.particles.species.end());
  const bool by_species = wishes.colour == "species" || (wishes.colour == "auto" && most > 0);
  PictureSettings settings;
  settings.framed_height = highest;
  settings.width = wishes.width, settings.height = wishes.height;
  const Surroundings around = surroundings_of(file->provenance());
  settings.surface = around.free_surface, settings.substrate = around.substrate;
  // A narrow tall cell is shown with its periodic neighbours, so that the picture reads as a layer.
  settings.repeat = std::clamp(static_cast<int>(0.45 * highest / first.cell.width_x), 1, 4);
  settings.width = std::clamp(
      static_cast<int>(settings.height * (settings.repeat * first.cell.width_x + 1.2) / (1.12 * highest)),
      240, 1200);
  settings.colour_bar = false;
  settings.text_scale = 1.5;

  std::vector<CaptionedImage> pictures;
  const auto colours_at = [&](const Layer& layer) {
    return by_species ? colours_by_species(layer.particles, file->species_names())
                      : colours_by_size(layer.particles);
  };
  for (const std::size_t k : frames) {
    const Layer layer = file->layer(k);
    const ParticleColours colours = colours_at(layer);
    const std::string when = file->times().size() > 1 ? view.when(file->times()[k]) : "packing";
    pictures.push_back(
        {when, fmt::format("Side view of the layer, {}: spheres coloured by {}", when, colours.label),
         draw_layer(layer, colours, settings)});
  }
  std::string text = "Seen from the side at one scale";
  if (settings.repeat > 1)
    text += fmt::format(", {} periodic copies of the cell side by side", settings.repeat);
  page.section("The layer", text + (settings.surface ? ". The blue line is the free surface." : "."));
  page.images(pictures);
  page.colours(legend_of(colours_at(first)));

  const std::size_t last = file->frame_count() - 1;
  if (const auto sizes = cluster_sizes(view, file->times().back(), file->particle_count()); !sizes.empty()) {
    const Layer layer = file->layer(last);
    std::vector<CaptionedImage> second;
    PictureSettings oblique = settings;
    oblique.view = View::Oblique;
    oblique.framed_height.reset();
    oblique.repeat = 1;
    oblique.text_scale = 1.1;
    oblique.width = 640, oblique.height = 760;
    second.push_back({"the end, whole", "Oblique view of the layer at the end",
                      draw_layer(layer, colours_at(layer), oblique)});
    oblique.cuts = {{1, 0.5 * layer.cell.width_y}};
    oblique.colour_bar = true;
    second.push_back(
        {"the end, cut in the middle, coloured by cluster",
         "Oblique view of the layer at the end, cut, spheres coloured by the size of their cluster",
         draw_layer(layer, colours_by_cluster(sizes), oblique)});
    page.images(second);
  }
}

}  // namespace pigment::report
