#include "resistance/parameters.h"

namespace pigment::resistance {

HydrodynamicsParameters read_hydrodynamics(config::Node node) {
  HydrodynamicsParameters p;
  using Model = HydrodynamicsParameters::Model;
  p.model = node.choice<Model>("model", {{"exact", Model::Exact}, {"thesis", Model::Thesis}, {"drag", Model::Drag}}, "exact");
  using Drag = HydrodynamicsParameters::Drag;
  p.drag = node.choice<Drag>("drag", {{"stokes", Drag::Stokes}, {"hindered", Drag::Hindered}}, "stokes");
  p.rotation = node.boolean("rotation", true);
  // A number: where squeeze lubrication ends, in smaller radii; the shear block keeps its share of it.
  if (node.is_word("cutoff", "auto") || !node.has("cutoff")) {
    node.accept_word("cutoff", "auto");
  } else {
    const double scale = node.number("cutoff", config::between(0.05, 3)) / p.taper.squeeze_end;
    p.taper.squeeze_begin *= scale;
    p.taper.squeeze_end *= scale;
    // Beyond 0.4 the exact shear block is soon indefinite: it may shrink, not grow.
    if (scale < 1) {
      p.taper.shear_begin *= scale;
      p.taper.shear_end *= scale;
    }
  }
  return p;
}

}  // namespace pigment::resistance
