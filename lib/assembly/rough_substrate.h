#pragma once
// What a substrate that is not flat does to the particles of a step (section 3.2.3 of [sand2010]; model/height_field.h).
//
// A particle touches it at every point whose distance is least among its neighbours. There it feels the plane tangent to that
// point: the plane's resistance, forces and contact in the frame of the normal n, the squeeze near contact and the forces with the
// curvature that the gap has there, tapered to nothing between half a radius and one
// and a half as a pair's squeeze is. What the nearest contact has lost by then the horizontal plane at the mean height takes over,
// so that a layer far above, and one on a substrate of vanishing amplitude, see the plane. Under hydrodynamics.model: thesis the
// contact is a corner, a virtual sphere of a tenth of the radius, where the surface is convex with a curvature above 1/a.
//   F = -(perpendicular n n + parallel (1 - n n)) U - coupling (W x n),   T = -(twist n n + rolling (1 - n n)) W - coupling (n x U)
#include <memory>
#include <vector>

#include "assembly/interactions.h"
#include "model/height_field.h"
#include "resistance/boundary_resistance.h"
#include "solve/pair_system.h"

namespace pigment::assembly {

class RoughSubstrate {
 public:
  using Laws = std::vector<std::unique_ptr<forces::PreparedPairLaw>>;
  // radius, potential: um and mV, engine order, as all arrays and indices here. interactions, with its height_field, must outlive this.
  RoughSubstrate(const Interactions&, std::vector<double> radius, std::vector<double> potential);

  // Finds the contacts at the beginning of a step.
  void begin(const std::vector<Vec3>& position, const Laws&);
  // The horizontal plane's share of particle k: viscosity mPa s, absorption um/ms; force: on particle k.
  void add_far(int k, double viscosity, double absorption, solve::ParticleTerm&, double* force) const;
  // The contacts' share: appended to blocks where there is any. D: unknowns a particle.
  void add_near(int k, const Laws&, double viscosity, double dt, bool implicit, double absorption, int D, double* force,
                std::vector<solve::OwnBlock>& blocks) const;
  // What the substrate presses particle k with, along z, pN, for its velocities u (D numbers).
  double force_along_z(int k, const Laws&, double viscosity, double dt, bool implicit, double absorption, int D, const double* u) const;
  // Judges where particle k ends and moves the guesses there.
  void refine(int k, const Laws&, double viscosity, double dt, const Vec3& end, bool newton, bool& again, bool& crossed);
  // Smallest distance of a sphere from the surface, um; infinite beyond one and a half radii.
  double gap(const Vec3& position, double radius) const;

 private:
  struct Contact {
    HeightField::Foot foot;
    forces::PairGeometry geometry;  // gap holds the guess
    double gap_begin;
    resistance::BoundaryScalars scalars;       // tapered, at gap_begin
    double squeeze_weight, squeeze_radius;     // of the singular part, for its impulse over the step
    double derjaguin;                          // the curved surface's forces over the plane's
  };
  struct Sum {
    double force[6];
    double block[21];
  };
  Contact contact_at(int k, const HeightField::Foot&) const;
  Sum sum_of(int k, const Laws&, double viscosity, double dt, bool implicit, double absorption) const;
  double reach(double radius) const { return radius * interactions_.hydrodynamics.taper.squeeze_end; }

  const Interactions& interactions_;
  const HeightField& field_;
  std::vector<double> radius_, potential_;
  std::vector<std::vector<Contact>> contacts_;
  std::vector<resistance::BoundaryScalars> far_;
};

}  // namespace pigment::assembly
