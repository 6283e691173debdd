#pragma once
// Resistance of one sphere to a plane boundary below or above it: a solid wall (the substrate) or a flat stress-free
// surface. Increments over isolated Stokes drag, at every gap, by fits to exact solutions (data/resistance; made by
// fit_boundary_functions.py, which prints their errors: at most 0.02 % of the resistance for either boundary).
//
// In units of viscosity, with z the upward normal, on a sphere with velocity U and rotation W:
//   force_z = perpendicular U_z;          force_xy = parallel U_xy + coupling (W x z)_xy
//   torque_z = twist W_z;                 torque_xy = rolling W_xy + coupling (z x U)_xy
// The coupling changes sign with the side on which the boundary lies.

namespace pigment::resistance {

struct BoundaryScalars {
  double perpendicular = 0, parallel = 0;  // um
  double coupling = 0;                     // um^2
  double twist = 0, rolling = 0;           // um^3
};

// gap > 0: distance from the sphere to the plane. The wall lies below the sphere.
BoundaryScalars wall_increment(double radius, double gap);
// The free surface lies above the sphere. Parallel and twist are negative (lateral drag falls by 27.5 % at contact):
// added to isolated drag the sum is positive definite.
BoundaryScalars free_surface_increment(double radius, double gap);

// Isolated sphere, (10) and (11) of [sand2010]: 6 pi a and 8 pi a^3.
double stokes_drag(double radius);
double stokes_torque(double radius);

}  // namespace pigment::resistance
