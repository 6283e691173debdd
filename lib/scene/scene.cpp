#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "dewatering/profile.h"
#include "model/size_distribution.h"
#include "packing/pack_layer.h"

namespace pigment::scene {
namespace {

// One line each, for the message that a tool needs a block.
const std::vector<std::pair<std::string, std::string>> block_examples = {
    {"layer", "layer: {thickness: 25 um, solids: 65 wt%, width: 5 um}"},
    {"particles", "particles: [{species: pigment, size: {law: monodisperse, diameter: 1 um}}]"},
    {"brownian", "brownian: {model: k_brown}"},
    {"dewatering", "dewatering: {strategy: HLL, duration: 0.5 s, ...}"},
};

void demand_blocks(config::Node& root, const std::string& stage_name) {
  for (const std::string& block : stage(stage_name).demands) {
    if (root.has(block)) continue;
    const auto example = std::find_if(block_examples.begin(), block_examples.end(),
                                      [&](const auto& entry) { return entry.first == block; });
    root.error(block, fmt::format("missing; pigment-{} needs this block, e.g. \"{}\"", stage_name, example->second));
  }
}

// Largest diameter of a species as far as the scene alone tells it (not from a table).
double largest_diameter(const Scene& scene) {
  double largest = 0;
  for (const Species& s : scene.species) largest = std::max(largest, s.size.max);
  return largest;
}

void check_layer(config::Node& root, const Scene& scene) {
  if (!scene.layer) return;
  config::Node layer = root.block("layer");
  const double diameter = largest_diameter(scene);
  if (!layer.failed("width") && scene.layer->width < 2 * diameter)
    layer.error("width", fmt::format("{:.6g} um is under two largest diameters ({:.6g} um each): a particle would meet "
                                     "its own periodic image; write at least \"{:.6g} um\"",
                                     scene.layer->width, diameter, 2 * diameter));
  if (!layer.failed("thickness") && scene.layer->thickness && *scene.layer->thickness < diameter)
    layer.error("thickness", fmt::format("{:.6g} um is thinner than the largest particle ({:.6g} um)",
                                         *scene.layer->thickness, diameter));
  if (layer.failed("solids") || scene.species.empty()) return;
  const double solids = layer_target(*scene.layer, scene.species, scene.liquid.density).volume_fraction;
  if (const auto why = packing::too_dense(*scene.layer, solids)) layer.error("solids", *why);
}

void check_dewatering(config::Node& root, const Scene& scene) {
  if (!scene.dewatering || !scene.layer || scene.species.empty()) return;
  config::Node layer = root.block("layer");
  for (const char* key : {"solids", "thickness", "coat_weight"})
    if (layer.failed(key)) return;
  dewatering::check_dewatering(root.block("dewatering"), *scene.dewatering, coating_of(scene));
}

// Final solids that no scale of the fluxes reaches. A table is judged where it is read.
void check_final_solids(config::Node& root, const Scene& scene) {
  if (!scene.dewatering || scene.dewatering->strategy == dewatering::Strategy::Table || !scene.layer || scene.species.empty())
    return;
  try {
    dewatering::make_profile(*scene.dewatering, coating_of(scene));
  } catch (const InputError& e) {
    const std::string said = e.what(), own_path = "dewatering.final_solids: ";
    root.block("dewatering").error("final_solids", said.starts_with(own_path) ? said.substr(own_path.size()) : said);
  }
}

// A law whose cut-offs leave nothing of it. A table is judged where it is read.
void check_sizes(config::Node& root, const Scene& scene) {
  auto blocks = root.blocks("particles");
  for (std::size_t i = 0; i < scene.species.size(); ++i) try {
      if (scene.species[i].size.kind != SizeLaw::Kind::Table) SizeDistribution{scene.species[i].size};
    } catch (const InputError& e) {
      blocks[i].error("size", e.what());
    }
}

// Without a surface the top is a reservoir: there is nothing that could evaporate. A scene that only says how a layer
// dewaters is not asked: its curve may serve another one.
void check_surface(config::Node& root, const Scene& scene, const std::string& stage_name) {
  if (!scene.dewatering || scene.free_surface || !scene.dewatering->evaporates()) return;
  if (stage_name == "consolidate" || !scene.colloidal.empty() || scene.brownian || scene.gravity)
    root.block("dewatering")
        .error("evaporation",
               "the scene has no free_surface, so nothing can evaporate; write e.g. \"free_surface: {model: spring}\", or "
               "\"strategy: ABS\" here");
}

// The integrators whose noise obeys fluctuation and dissipation (stepping/integrators.cpp).
void check_integrator(config::Node& root, const Scene& scene) {
  using I = stepping::SteppingParameters::Integrator;
  if (scene.stepping.integrator == I::BackwardDifferentiation) {
    if (scene.brownian) root.block("stepping").error("integrator", "looks back over the noise of the step before; with Brownian motion write auto or newton_implicit");
    if (scene.substrate && scene.substrate->roughness) root.block("stepping").error("integrator", "knows no rough substrate; write auto or extrapolated");
  }
  if (!scene.brownian || scene.brownian->model != forces::BrownianParameters::Model::FluctuationDissipation) return;
  const I i = scene.stepping.integrator;
  if (i == I::Automatic || i == I::LinearlyImplicit || i == I::ExplicitEuler) return;
  root.block("stepping").error("integrator", "does not have the statistics of brownian.model: fluctuation_dissipation; write auto, linearly_implicit or explicit_euler");
}

// Packing puts particles above the crests, liquid below; noise with the whole resistance knows the plane alone.
void check_roughness(config::Node& root, const Scene& scene) {
  if (!scene.substrate || !scene.substrate->roughness) return;
  if (scene.brownian && scene.brownian->model == forces::BrownianParameters::Model::FluctuationDissipation)
    root.block("brownian").error("model", "fluctuation_dissipation needs a plane substrate; write k_brown, or leave out substrate.roughness");
}

}  // namespace

dewatering::Coating coating_of(const Scene& scene) {
  const LayerTarget target = layer_target(*scene.layer, scene.species, scene.liquid.density);
  return {target.volume_fraction, target.thickness, dry_density(scene.species),
          liquid_at(scene.liquid, scene.liquid.temperature)};
}

Scene read_scene(config::Document& document, const std::string& stage_name) {
  config::Node root = document.root();
  Scene scene;
  demand_blocks(root, stage_name);
  scene.seed = static_cast<std::uint64_t>(root.integer("seed", 1, config::between(0, 9e15)));
  if (auto block = root.optional_block("layer")) scene.layer = read_layer(*block);
  scene.species = read_species(root);
  scene.packing = packing::read_packing(root.block("packing"));
  scene.liquid = read_liquid(root.block("liquid"));
  scene.hydrodynamics = resistance::read_hydrodynamics(root.block("hydrodynamics"));
  if (auto block = root.optional_block("colloidal")) scene.colloidal = forces::read_colloidal(*block);
  if (auto block = root.optional_block("brownian")) scene.brownian = forces::read_brownian(*block);
  if (root.is_word("substrate", "none"))
    root.accept_word("substrate", "none");
  else
    scene.substrate = forces::read_substrate(root.block("substrate"));
  if (auto block = root.optional_block("free_surface")) scene.free_surface = forces::read_free_surface(*block);
  if (auto block = root.optional_block("gravity")) scene.gravity = forces::read_gravity(*block);
  if (auto block = root.optional_block("dewatering")) scene.dewatering = dewatering::read_dewatering(*block);
  scene.stepping = stepping::read_stepping(root.block("stepping"));
  scene.output = stepping::read_output(root.block("output"));
  scene.analysis = analysis::read_analysis(root.block("analysis"));
  if (!document.has_errors()) check_sizes(root, scene);  // with stand-ins for bad values it would only add noise
  check_layer(root, scene);
  check_dewatering(root, scene);
  if (!document.has_errors()) check_final_solids(root, scene);
  check_surface(root, scene, stage_name);
  check_integrator(root, scene);
  check_roughness(root, scene);
  document.check();
  return scene;
}

}  // namespace pigment::scene
