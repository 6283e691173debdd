#pragma once
// Drag on spheres among others, for flow through a fixed random bed [vanderhoef2005].
//
// Which force is meant. The liquid acts on a sphere with its drag F_d (relative to the liquid between the spheres) and with
// the pressure gradient of the flow over the sphere's volume, V (-dp/dz). With u the interstitial velocity relative to the bed,
// superficial (1 - phi) u, the source gives F_d = 6 pi mu a (1 - phi) u F(phi) for equal spheres; the balance of the liquid,
// (1 - phi)(-dp/dz) = n F_d, then makes the whole force F_d/(1 - phi) = 6 pi mu a F(phi) u. Carman and Kozeny's equation is
// F = 10 phi/(1 - phi)^2.
// Several sizes: F_d goes with the surface, a factor y = a/<a> more for each, <a> = sum a^3/sum a^2. With the pressure term this
// is the source's (1 - phi) y + phi y^2 for the whole force.
// Differs from [vanderhoef2005]: its further term 0.064 (1 - phi) y^3, a fit, is left out: it would spoil equal spheres by up to
// 6 %, and adds at most 10 % to the largest of a layer's.
// Differs from [vanderhoef2005]: below phi = 0.1, where it was not fitted, y goes over to 1, so that single spheres of any size
// have Stokes drag.

namespace pigment::resistance {

// F(phi) for equal spheres, 0 <= phi < 1: 10 phi/(1 - phi)^2 + (1 - phi)^2 (1 + 1.5 sqrt(phi)); 1 at phi = 0. Fitted to
// lattice-Boltzmann simulations of random arrays, phi = 0.1 to 0.6.
double bed_drag_factor(double solids_fraction);

// F_d over 6 pi mu a u: drag without the pressure term, relative to the interstitial velocity. ratio: y = a/<a>.
double hindered_drag_factor(double solids_fraction, double ratio);

}  // namespace pigment::resistance
