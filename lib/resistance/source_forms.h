#pragma once
// The hydrodynamic forms of [sand2010], kept runnable so that the effect of the exact ones on a layer can be shown
// (hydrodynamics.model: thesis). Their errors against exact theory: wall -0.26, -1.9, -11, -43 % of the whole resistance at gaps
// of 1e-4, 1e-3, 0.01, 0.1 radii; free surface -0.41, -2.9, -17, -48 %.
#include "resistance/boundary_resistance.h"
#include "resistance/pair_lubrication.h"

namespace pigment::resistance {

// Section 3.2.2: near-field terms alone, 1/x and ln(1 + 1/x), no constants, no coupling of shear and pump, no twist. The
// finite-element fits that the source adds for unequal spheres are not printed in it.
PairScalars source_pair_scalars(double radius_i, double radius_j, double gap, const LubricationTaper&);

// (12) for the approach; sliding and rolling against a virtual sphere of 100 radii that touches the plane below the particle
// (section 3.2.3). Differs from [sand2010] (12): the bracket is negative, the force printed would propel; taken as resistance.
BoundaryScalars source_wall_increment(double radius, double gap, const LubricationTaper&);

// A corner: a virtual sphere of a tenth of the particle's radius that touches the boundary (section 3.2.3).
inline constexpr double corner_share = 0.1;
BoundaryScalars source_corner_increment(double radius, double gap, const LubricationTaper&);

// (13), a quarter of (12); nothing lateral.
BoundaryScalars source_free_surface_increment(double radius, double gap);

}  // namespace pigment::resistance
