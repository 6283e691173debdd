#pragma once
// Rows of radii and gaps in a CSV file, evaluated.
#include <filesystem>
#include <string>

#include "assembly/interaction_curves.h"

namespace pigment::assembly {

// Reads the columns a1,a2,h (m; a2 also inf, the wall, or surface, the free surface) and returns the text of
// a1,a2,h,kn,kt,ks,kp,ksp,f_electrostatic,f_vdw,f_born,f_steric,f_total in SI, each number with 17 digits, so that it reads
// back as it was. Both spheres have the potential (mV). Throws FileError with file, line and column for what cannot be used.
std::string evaluate_table(const std::filesystem::path& csv, const InteractionEvaluator&, double potential);

}  // namespace pigment::assembly
