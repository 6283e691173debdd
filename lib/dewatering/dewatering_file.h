#pragma once
// dewatering.h5: a curve as a file, ours or made by hand.
#include <filesystem>

#include "dewatering/profile.h"
#include "io/result_file.h"
#include "model/dewatering_curve.h"

namespace pigment::dewatering {

// /dewatering/{time, absorption_flux, evaporation_flux, absorbed, evaporated} and, where the curve has one, temperature;
// attributes scale and duration.
io::ResultFile result_of(const Profile&);

// Reads such a file. Made by hand, time and the two fluxes are enough. Throws FileError: lengths that differ, times that
// do not rise from 0, negative fluxes, cumulative curves that fall or do not start at 0, temperatures below 0 K.
DewateringCurve read_curve(const std::filesystem::path&);

}  // namespace pigment::dewatering
