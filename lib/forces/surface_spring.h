#pragma once
// Surface tension on a particle that sticks out of the free surface, (14)-(15) of [sand2010]: F = sigma Delta(h), h the
// height by which it sticks out, downwards on the particle.
#include <vector>

#include "forces/parameters.h"

namespace pigment::forces {

struct SpringForce {
  double force = 0;      // pN, downwards
  double stiffness = 0;  // pN/um, dforce/dh
};

// Arc: Delta = 2 a theta, cos theta = 1 - h/a, as printed; arc minus chord: 2 a (theta - sin theta), what the surface
// really gains in length. h <= 0 and h >= 2a (the particle has left): no force. The arc's slope is infinite at h = 0.
SpringForce surface_spring(const FreeSurfaceParameters&, double radius, double protrusion);

// A protrusion that is nothing (0.01 nm, a tenth of an atom). Up to half the force of the spring there the surface holds the particle
// exactly, as a constraint, and between the two the force rises evenly: the arc's tangent, so that each load has one height and no height
// is without stiffness. At 72 mN/m the arc holds up to 150 pN on the smallest particles.
inline constexpr double rigid_protrusion = 1e-5;  // um
// The load up to which the particle is held exactly, pN; infinite for model `constraint`.
double rigid_load(const FreeSurfaceParameters&, double radius);
// The spring on a particle that a larger load has lifted.
SpringForce lifted_spring(const FreeSurfaceParameters&, double radius, double protrusion);
// The height to which a load lifts it, to a thousandth, um: no more than its radius, and no less than half of rigid_protrusion.
double lifted_height(const FreeSurfaceParameters&, double radius, double load);

// Pressure at which air enters the pores between these spheres and the surface no longer follows the liquid, pN/um^2: the
// scene's, or sigma times the solids' surface over their volume, 6 sigma/d32. Wetting liquid in a bed of solids phi holds against
// phi/(1 - phi) times that [white1982]: this is its value at phi = 1/2.
double entry_pressure(const FreeSurfaceParameters&, const std::vector<double>& radius);

// Slope with which the substrate pushes back a sphere that no other force keeps off it, pN/um.
inline constexpr double contact_stiffness = 1e8;

}  // namespace pigment::forces
