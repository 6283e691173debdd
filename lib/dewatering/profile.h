#pragma once
// The dewatering curve that a scene asks for: Darcy absorption, evaporation in sections, tables, and the one factor that
// brings a reference layer to given solids.
#include "dewatering/parameters.h"
#include "model/dewatering_curve.h"

namespace pigment::dewatering {

// Liquid absorbed through a growing filter cake at constant pressure, V/A = sqrt(rate t).
//   rate = 2 k_f (P_cap + P_ext) / mu (phi_f - phi) / phi, um^2/ms:
// Darcy's law dV/dt = k_f P / (mu L) over a cake whose thickness L holds the solids that V left behind,
// phi_f L = phi (L + V) [usher2001].
// Differs from [sand2010] (1): as printed there the pressure stands under a second root, which is a misprint (the
// dimension would not be a length, and the filtration law has the pressure to the first power under the one root).
double darcy_rate(const AbsorptionParameters&, double volume_fraction, double viscosity);

// Liquid that must leave a layer of this thickness to go from one volume fraction of solids to a higher one, um.
double liquid_to_remove(double thickness, double volume_fraction, double final_volume_fraction);

struct Profile {
  DewateringCurve curve;
  double duration = 0;  // ms
  double scale = 1;     // the factor on both fluxes; 1 without final_solids
  double removed = 0;   // um, liquid lost by `duration`
};

// The curve's absorbed and evaporated are exact at its points, and the points are placed so that a straight line between
// them errs by less than 1e-6 of the liquid removed. A section's end stands twice, 1e-9 of the duration apart, so that the
// fluxes are sections too when read as straight lines. The flux at t = 0, singular in Darcy's law, is the mean over the
// first interval. Throws FileError for a table that cannot be used, InputError when final_solids cannot be reached.
// Requires what check_dewatering checks.
Profile make_profile(const DewateringParameters&, const Coating&);

}  // namespace pigment::dewatering
