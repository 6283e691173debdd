#include "resistance/scene_resistance.h"

#include <algorithm>

#include "resistance/source_forms.h"

namespace pigment::resistance {

using Model = HydrodynamicsParameters::Model;

PairScalars pair_term(const HydrodynamicsParameters& p, double radius_i, double radius_j, double gap) {
  const double h = hydrodynamic_gap(gap, std::min(radius_i, radius_j));
  switch (p.model) {
    case Model::Exact: return tapered_pair_scalars(radius_i, radius_j, h, p.taper);
    case Model::Thesis: return source_pair_scalars(radius_i, radius_j, h, p.taper);
    case Model::Drag: break;
  }
  return {};
}

BoundaryScalars wall_term(const HydrodynamicsParameters& p, double radius, double gap) {
  const double h = hydrodynamic_gap(gap, radius);
  switch (p.model) {
    case Model::Exact: return wall_increment(radius, h);
    case Model::Thesis: return source_wall_increment(radius, h, p.taper);
    case Model::Drag: break;
  }
  return {};
}

BoundaryScalars free_surface_term(const HydrodynamicsParameters& p, double radius, double gap) {
  const double h = hydrodynamic_gap(gap, radius);
  switch (p.model) {
    case Model::Exact: return free_surface_increment(radius, h);
    case Model::Thesis: return source_free_surface_increment(radius, h);
    case Model::Drag: break;
  }
  return {};
}

}  // namespace pigment::resistance
