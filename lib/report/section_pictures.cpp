// The layer itself, at four times, at one scale.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/layer_picture.h"
#include "report/sections.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

// The frame at which the clusters are worth a look: about half of the particles have joined one.
struct ClusterMoment {
  std::size_t frame = 0;
  std::vector<double> sizes;  // of each particle's cluster; empty where the run has no fitting cluster file
};
ClusterMoment moment_of_clustering(const RunView& view, const io::ParticleFile& particles) {
  const auto* file = view.files.result("cluster");
  if (!file) return {};
  const Rows times = rows_of(*file, "/cluster/time", {}, 1), sizes = rows_of(*file, "/cluster/size");
  if (!times || sizes.rows != times.rows || sizes.columns != particles.particle_count()) return {};
  const Rows clustered = rows_of(*file, "/cluster/clustered_fraction", times.rows, 1);
  std::size_t best = times.rows - 1;
  // The packing itself, frame 0, has gaps of the packer's making.
  for (std::size_t k = 1; k < clustered.rows; ++k)
    if (std::abs(clustered.at(k) - 0.5) < std::abs(clustered.at(best) - 0.5)) best = k;
  ClusterMoment moment;
  const auto& frames = particles.times();
  for (std::size_t k = 0; k < frames.size(); ++k)
    if (std::abs(frames[k] - times.at(best)) < std::abs(frames[moment.frame] - times.at(best)))
      moment.frame = k;
  moment.sizes = sizes.row(best);
  return moment;
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
  settings.repeat = std::clamp(static_cast<int>(std::ceil(0.45 * highest / first.cell.width_x - 0.2)), 1, 4);
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
         draw_layer(layer, colours, settings), file->times()[k]});
  }
  std::string text = "Seen from the side at one scale";
  if (settings.repeat > 1)
    text += fmt::format(", {} periodic copies of the cell side by side", settings.repeat);
  page.section("The layer", text + (settings.surface ? ". The blue line is the free surface." : "."));
  page.images(pictures);
  page.colours(legend_of(colours_at(first)));

  // A closer look: the layer at its end, and its clusters on a cut.
  const std::size_t last = file->frame_count() - 1;
  const ClusterMoment moment = moment_of_clustering(view, *file);
  PictureSettings oblique = settings;
  oblique.view = View::Oblique;
  oblique.framed_height.reset();
  oblique.repeat = 1;
  oblique.text_scale = 1.1;
  oblique.width = 640, oblique.height = 760;
  const Layer end = file->layer(last);
  std::vector<CaptionedImage> closer;
  closer.push_back({view.when(file->times()[last]), "Oblique view of the layer at the end",
                    draw_layer(end, colours_at(end), oblique)});
  oblique.cuts = {{1, 0.5 * end.cell.width_y}};
  closer.push_back({view.when(file->times()[last]) + ", cut in the middle",
                    "Oblique view of the layer at the end, cut in the middle",
                    draw_layer(end, colours_at(end), oblique)});
  if (!moment.sizes.empty()) {
    const Layer layer = file->layer(moment.frame);
    oblique.colour_bar = true;
    closer.push_back({view.when(file->times()[moment.frame]) + ", coloured by cluster",
                      "Oblique view of the layer, cut, spheres coloured by the size of their cluster",
                      draw_layer(layer, colours_by_cluster(moment.sizes), oblique)});
  }
  page.images(closer);
}

}  // namespace pigment::report
