#pragma once
// How long a step may be.
//
// Deterministic scenes: the error of one linearly implicit Euler step in a gap is estimated by dt/2 |dgap/dt - dgap/dt of the
// last step|, in units of gap + Debye length (the lengths over which lubrication and the double layer change); its
// root mean square over the near pairs is held at the tolerance.
// Brownian scenes: the step is fixed by the noise before it is drawn. With k_brown the smallest free particle moves by 4.2 Debye lengths
// (root mean square a component; lubrication makes it far less where particles are near each other): what the step then changes in the mean
// gap of a pair is a tenth of what this noise itself has wrong (docs/brownian.md: 1 % of 11 % at such a step, 250 us there), and less than
// it has wrong in the gaps of a layer (study-accuracy). A step chosen after the noise is known would bias it.
#include "assembly/interactions.h"
#include "model/particles.h"
#include "stepping/parameters.h"

namespace pigment::stepping {

// The scene's Debye length, um; 0.5 nm, a molecule, where it has no electrostatic law.
double gap_scale(const assembly::Interactions&, const Liquid&);
// ms.
double brownian_step(const Particles&, const Liquid&, double gap_scale);
// ms, with noise that obeys fluctuation and dissipation. Near contact a pair's squeeze resistance is c/gap, c = 6 pi mu R^2, and
// gap, force and noise are all made dimensionless by the Debye length l and the time l c/kT: one number, dt kT/(l c), sets
// the error of the gaps, whatever the sizes. It is 0.25 for the smallest pair: a mean gap that is at most 3 % off, which
// tests/physics/boltzmann_separation_test.cpp holds. Without lubrication: a component of the smallest particle moves by half a Debye length.
double thermal_step(const Particles&, const Liquid&, double gap_scale, bool lubrication);
// Relative residual of each solve: the scene's, or a tenth of the step tolerance. One step's noise moves particles by
// nanometres either way: a thousandth of it is far below its own weak error. bonds: of a step by convex splitting.
double solver_tolerance(const SteppingParameters&, bool noisy, bool bonds);
// Next step from the last one's error in units of the tolerance: local error of a first-order method goes with dt^2.
double next_step(double step, double error);

}  // namespace pigment::stepping
