#pragma once
// A scene: the rooms' parameters side by side. Each room reads its own block; here they meet and are checked against each
// other. A block that is absent is a model that is not in the scene; the substrate is there unless `substrate: none`.
#include <optional>
#include <string>
#include <vector>

#include "analysis/parameters.h"
#include "config/node.h"
#include "dewatering/parameters.h"
#include "forces/parameters.h"
#include "model/layer_parameters.h"
#include "model/liquid.h"
#include "model/species.h"
#include "packing/parameters.h"
#include "resistance/parameters.h"
#include "scene/stages.h"
#include "stepping/parameters.h"

namespace pigment::scene {

struct Scene {
  std::uint64_t seed = 1;
  std::optional<LayerParameters> layer;
  std::vector<Species> species;  // the block `particles`; empty where it is absent
  packing::PackingParameters packing;
  LiquidParameters liquid;
  resistance::HydrodynamicsParameters hydrodynamics;
  std::vector<forces::ColloidalLaw> colloidal;
  std::optional<forces::BrownianParameters> brownian;
  std::optional<forces::SubstrateParameters> substrate;  // nothing: `substrate: none`
  std::optional<forces::FreeSurfaceParameters> free_surface;
  std::optional<forces::GravityParameters> gravity;
  std::optional<dewatering::DewateringParameters> dewatering;
  stepping::SteppingParameters stepping;
  stepping::OutputParameters output;
  analysis::Parameters analysis;
};

// Reads every block that is there, so that a slip anywhere in the scene is found whichever tool reads it, and throws one
// InputError with all that is wrong. `stage` names the tool: the blocks it demands must be there.
// Afterwards document.resolved(stage(name).reads) is what that tool's provenance keeps.
Scene read_scene(config::Document&, const std::string& stage = "scene");

// The wet coating that layer, particles and liquid describe; all three must be there.
dewatering::Coating coating_of(const Scene&);

}  // namespace pigment::scene
