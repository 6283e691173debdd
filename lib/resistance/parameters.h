#pragma once
// The scene's `hydrodynamics` block.
#include "config/node.h"
#include "resistance/pair_lubrication.h"

namespace pigment::resistance {

struct HydrodynamicsParameters {
  enum class Model { Exact, Thesis, Drag };  // thesis: source_forms.h
  Model model = Model::Exact;
  enum class Drag { Stokes, Hindered };  // hindered: hindered_drag.h, among the slices of a layer
  Drag drag = Drag::Stokes;
  bool rotation = true;
  LubricationTaper taper;  // of the pair term
};
HydrodynamicsParameters read_hydrodynamics(config::Node);

}  // namespace pigment::resistance
