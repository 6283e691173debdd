#include "app/analysis_input.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "scene/scene.h"

namespace pigment::app {

namespace {

// Density of the liquid in the scene that a file keeps as its provenance; 1000 kg/m3 where it keeps none.
double density_in_provenance(const std::string& scene_text) {
  const double water = 1e-3;
  if (scene_text.empty()) return water;
  try {
    config::Document document = config::Document::from_text(scene_text, "provenance");
    if (!document.root().has("liquid")) return water;
    const double density = read_liquid(document.root().block("liquid")).density;
    return document.has_errors() ? water : density;
  } catch (const Error&) {
    return water;
  }
}

}  // namespace

void declare_analysis(CommandLine& line, AnalysisOptions& options) {
  line.positional("file", options.input, "trajectory.h5 or packing.h5, or a particle file made by hand");
  line.option("--scene", options.scene,
              "scene whose `analysis` block says how to measure; without it, defaults");
  line.output_required();
  line.has_threads();
}

AnalysisInput open_analysis_input(const CommandLine& line, const AnalysisOptions& options,
                                  const std::string& tool) {
  AnalysisInput input;
  config::Document document = options.scene.empty()
                                  ? config::Document::from_text("{}", "--set", line.common.set)
                                  : config::Document(options.scene, line.common.set);
  const scene::Scene scene = scene::read_scene(document, tool);
  input.parameters = scene.analysis;
  for (const Species& species : scene.species) input.species_density.push_back(species.density);

  input.file = std::make_shared<const io::ParticleFile>(options.input);
  input.liquid_density = document.root().has("liquid")
                             ? scene.liquid.density
                             : density_in_provenance(input.file->provenance().scene);
  input.provenance.tool = "pigment-" + tool;
  input.provenance.scene = document.resolved(scene::stage(tool).reads);
  input.provenance.inputs["particles"] = io::sha256_of_file(options.input);

  input.frames.count = input.file->frame_count();
  const std::string what = "measuring " + options.input.filename().string();
  input.frames.read = [file = input.file, what, progress = std::shared_ptr<Progress>(),
                       last = std::size_t{0}](std::size_t k) mutable {
    if (!progress || k <= last) progress = std::make_shared<Progress>(what);  // a second pass starts anew
    last = k;
    Layer layer = file->layer(k);
    progress->update(static_cast<double>(k + 1) / static_cast<double>(file->frame_count()));
    return analysis::Snapshot{file->times()[k], layer.cell, std::move(layer.position), layer.substrate};
  };
  return input;
}

analysis::Solids weigh_solids(const AnalysisInput& input) {
  const Particles& particles = input.particles();
  analysis::Solids solids{particles.radius, particles.mass, input.liquid_density, particles.species};
  constexpr int most_species = 100;  // a file made by hand may number its particles so
  if (!solids.species.empty() && *std::max_element(solids.species.begin(), solids.species.end()) >= most_species) {
    note(fmt::format("{}: more than {} species; no profiles by species", input.file->path().string(), most_species));
    solids.species.clear();
  }
  if (input.file->has_mass()) return solids;
  const double usual = 2.7e-3;  // 2700 kg/m3
  bool usual_taken = false;
  solids.mass.clear();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const std::size_t species =
        particles.species.empty() ? 0 : static_cast<std::size_t>(particles.species[i]);
    const bool known = species < input.species_density.size();
    usual_taken = usual_taken || !known;
    solids.mass.push_back((known ? input.species_density[species] : usual) *
                          Particles::sphere_volume(particles.radius[i]));
  }
  const std::string density = usual_taken ? "2700 kg/m3" : "the densities of the scene's species";
  note(input.file->path().string() + ": has no mass of particles; took " + density);
  return solids;
}

void require_within_half_period(const AnalysisInput& input, const std::string& key, double distance) {
  if (input.frames.count == 0) return;
  const Cell cell = input.file->layer(0).cell;
  const double half = 0.5 * std::min(cell.width_x, cell.width_y);
  if (distance > half)
    throw InputError(
        fmt::format("analysis.{}: {:g} um is more than half the layer's periodic width ({:g} um), beyond "
                    "which a pair is near by several images; expected less",
                    key, distance, half));
}

}  // namespace pigment::app
