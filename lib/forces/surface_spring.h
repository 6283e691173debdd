#pragma once
// Surface tension on a particle that sticks out of the free surface, (14)-(15) of [sand2010]: F = sigma Delta(h), h the
// height by which it sticks out, downwards on the particle.
#include "forces/parameters.h"

namespace pigment::forces {

struct SpringForce {
  double force = 0;      // pN, downwards
  double stiffness = 0;  // pN/um, dforce/dh
};

// Arc: Delta = 2 a theta, cos theta = 1 - h/a, as printed; arc minus chord: 2 a (theta - sin theta), what the surface
// really gains in length. h <= 0 and h >= 2a (the particle has left): no force.
// The arc's slope is infinite at h = 0; up to where the law itself is softer it is replaced by a stiff straight line, whose
// protrusion under the loads of a drying layer (below 100 pN) is less than 1e-5 nm. Model `constraint` is that line alone.
SpringForce surface_spring(const FreeSurfaceParameters&, double radius, double protrusion);

// pN/um.
inline constexpr double constraint_stiffness = 1e10;

}  // namespace pigment::forces
