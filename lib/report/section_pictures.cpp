// The layer itself, at four times, at one scale.
#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
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

}  // namespace

void add_pictures(HtmlReport& page, const RunView& view, const PictureWishes& wishes) {
  const io::ParticleFile* file = view.files.particles();
  if (!file || file->particle_count() == 0) return;
  const auto frames = evenly_in_time(file->times(), 4);
  const Layer first = file->layer(0);
  double highest = first.cell.height;
  for (std::size_t i = 0; i < first.position.size(); ++i) highest = std::max(highest, first.position[i].z() + first.particles.radius[i]);

  const int most = first.particles.species.empty() ? 0 : *std::max_element(first.particles.species.begin(), first.particles.species.end());
  const bool by_species = wishes.colour == "species" || (wishes.colour == "auto" && most > 0);
  PictureSettings settings;
  settings.framed_height = highest;
  settings.width = wishes.width, settings.height = wishes.height;
  settings.surface = settings.substrate = true;
  // A narrow tall cell is shown with its periodic neighbours, so that the picture reads as a layer.
  settings.repeat = std::clamp(static_cast<int>(0.45 * highest / first.cell.width_x), 1, 4);
  settings.width = std::clamp(static_cast<int>(settings.height * (settings.repeat * first.cell.width_x + 1.2) / (1.12 * highest)), 240, 1200);
  settings.colour_bar = true;

  std::vector<CaptionedImage> pictures;
  for (const std::size_t k : frames) {
    const Layer layer = file->layer(k);
    const ParticleColours colours = by_species ? colours_by_species(layer.particles, file->species_names()) : colours_by_size(layer.particles);
    const std::string when = file->times().size() > 1 ? time_text(file->times()[k]) : "packing";
    pictures.push_back({when, fmt::format("Side view of the layer, {}: spheres coloured by {}", when, colours.label), draw_layer(layer, colours, settings)});
  }
  page.section("The layer", settings.repeat > 1
                                ? fmt::format("Seen from the side at one scale, with {} periodic copies of the cell side by side. The blue line is the free surface.", settings.repeat)
                                : "Seen from the side at one scale. The blue line is the free surface.");
  page.images(pictures);

  const std::size_t last = file->frame_count() - 1;
  if (const auto sizes = cluster_sizes(view, file->times().back(), file->particle_count()); !sizes.empty()) {
    const Layer layer = file->layer(last);
    std::vector<CaptionedImage> second;
    PictureSettings oblique = settings;
    oblique.view = View::Oblique;
    oblique.framed_height.reset();
    oblique.repeat = 1;
    oblique.width = oblique.height = 760;
    second.push_back({"the end, whole", "Oblique view of the layer at the end", draw_layer(layer, by_species ? colours_by_species(layer.particles, file->species_names()) : colours_by_size(layer.particles), oblique)});
    oblique.cuts = {{1, 0.5 * layer.cell.width_y}};
    second.push_back({"the end, cut in the middle, coloured by cluster", "Oblique view of the layer at the end, cut, spheres coloured by the size of their cluster", draw_layer(layer, colours_by_cluster(sizes), oblique)});
    page.images(second);
  }
}

}  // namespace pigment::report
