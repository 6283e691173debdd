#pragma once
// Recipes and problems of small layers, as the tests of whole runs use them.
#include <string>

#include "packing/pack_layer.h"
#include "stepping/consolidate.h"

namespace pigment::test {

// One species under a log-normal law with cut-offs; a layer 2.5 um wide; gaps of 2 nm at least. um, solids by mass.
inline packing::Recipe lognormal_recipe(double thickness, double solids, const SizeLaw& law) {
  packing::Recipe recipe;
  recipe.layer.thickness = thickness;
  recipe.layer.solids = solids;
  recipe.layer.width = 2.5;
  recipe.packing.minimum_gap = 0.002;
  Species species;
  species.name = "pigment";
  species.size = law;
  species.size.kind = SizeLaw::Kind::Lognormal;
  recipe.species = {species};
  return recipe;
}

// The packed layer between a substrate and a free surface, charged (-25 mV, 5 nm), without dewatering.
inline stepping::Problem charged_layer(const packing::Packing& packed) {
  stepping::Problem problem;
  problem.particles = packed.layer.particles;
  problem.cell = packed.layer.cell;
  auto document = config::Document::from_text("colloidal: {electrostatic: {debye_length: 5 nm}, van_der_waals: {}, born: {}}");
  assembly::Interactions& in = problem.interactions;
  in.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  in.surface_potential = {-25};
  in.substrate.emplace();
  in.free_surface.emplace();
  return problem;
}

}  // namespace pigment::test
