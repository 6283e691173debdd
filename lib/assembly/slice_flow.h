#pragma once
// The liquid between the particles as a flow in one dimension (hydrodynamics.drag: hindered).
//
// Horizontal slices hold solids phi and their mean velocity <U>; volume is conserved, so the liquid between them moves with
//   u = (-q - phi <U>)/(1 - phi),
// q the absorbed flux. Each particle feels in each slice, by the share of its volume there, the drag b (u - U) of
// resistance/hindered_drag.h and the pressure gradient that all drags of the slice make, V (-dp/dz). Both are the derivative of
// one dissipation, sum b (U - u)^2, u as above: so the matrix is symmetric and positive definite (solve/mean_flow.h), and a
// bed that moves as one feels exactly the source's force.
// phi and b are those at the beginning of a step; U is the velocity that the step solves for, in phi <U> too.
#include <vector>

#include "base/vec.h"
#include "model/height_field.h"
#include "solve/mean_flow.h"

namespace pigment::assembly {

// What a slice's liquid does, for one set of particle velocities.
struct SliceState {
  double solids_fraction = 0, solids_flux = 0;  // phi; phi <U>, um/ms
  double liquid_velocity = 0;                   // u, um/ms
  double pressure_drop = 0;                     // from the slice's bottom to its top, pN/um^2
};

class SliceFlow {
 public:
  // radius: engine order. Slices about as thick as the surface-mean diameter sum d^3/sum d^2, a whole number in `height`.
  // Over a substrate that is not flat (null: flat) a slice is what lies above the surface, and q what each part of that area takes.
  SliceFlow(const std::vector<double>& radius, double area, double height, const HeightField* substrate = nullptr);

  // Slices of the layer at the beginning of a step. With a surface they are equal parts of 0..surface and shrink with it; what
  // stands out of it takes no part. Without (surface 0) they keep their thickness and go on above and below as far as
  // particles do.
  void place(const std::vector<Vec3>& position, double surface, double viscosity, double absorption);

  const solve::MeanFlow& term() const { return term_; }
  double drag(std::size_t k) const { return drag_[k]; }    // sum of b over the particle's slices, pN ms/um
  double force(std::size_t k) const { return force_[k]; }  // of the absorbed flux on particles at rest, pN

  // From the lowest slice up. velocity: D entries a particle, engine order.
  std::vector<SliceState> states(const std::vector<double>& velocity, std::size_t D) const;

 private:
  const std::vector<double>& radius_;
  double area_, thickness_, absorption_ = 0;
  const HeightField* substrate_;
  double thickness_now_ = 0;  // of the slices placed last, um
  int slices_;
  double sauter_radius_;
  std::vector<double> space_;            // volume of each slice, um^3
  std::vector<double> solids_, liquid_;  // phi and 1 - phi of each slice
  std::vector<double> drag_, force_;
  solve::MeanFlow term_;
};

}  // namespace pigment::assembly
