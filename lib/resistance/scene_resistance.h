#pragma once
// The terms of the scene's hydrodynamic model: exact, the source's, or (drag) none. Gaps below a millionth of the smaller radius
// count as that.
#include "resistance/boundary_resistance.h"
#include "resistance/parameters.h"

namespace pigment::resistance {

PairScalars pair_term(const HydrodynamicsParameters&, double radius_i, double radius_j, double gap);  // tapered
BoundaryScalars wall_term(const HydrodynamicsParameters&, double radius, double gap);
BoundaryScalars free_surface_term(const HydrodynamicsParameters&, double radius, double gap);

}  // namespace pigment::resistance
