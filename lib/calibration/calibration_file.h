#pragma once
// kbrown.h5.
#include <filesystem>

#include "io/result_file.h"
#include "model/brownian_constant.h"

namespace pigment::calibration {

// /kbrown/{temperature, time_step, value, standard_deviation, closed_form}, one entry a temperature.
io::ResultFile result_of(const BrownianCalibration&);
// Temperature, time_step and value are enough. Throws FileError: lengths that differ, temperatures that do not rise, values or
// steps that are not positive.
BrownianCalibration read_calibration(const std::filesystem::path&);

}  // namespace pigment::calibration
