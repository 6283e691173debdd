#include "calibration/calibration_file.h"

#include "base/error.h"

namespace pigment::calibration {

namespace {

struct Column {
  const char* path;
  Dimension dimension;
  std::vector<double> BrownianCalibration::*values;
  bool required;
};
const Column columns[] = {
    {"/kbrown/temperature", Dimension::Temperature, &BrownianCalibration::temperature, true},
    {"/kbrown/time_step", Dimension::Time, &BrownianCalibration::time_step, true},
    {"/kbrown/value", Dimension::BrownianConstant, &BrownianCalibration::value, true},
    {"/kbrown/standard_deviation", Dimension::BrownianConstant, &BrownianCalibration::standard_deviation, false},
    {"/kbrown/closed_form", Dimension::BrownianConstant, &BrownianCalibration::closed_form, false},
};

}  // namespace

io::ResultFile result_of(const BrownianCalibration& calibration) {
  io::ResultFile result;
  result.kind = "kbrown";
  for (const Column& c : columns) {
    const std::vector<double>& values = calibration.*c.values;
    if (!values.empty()) result.datasets.push_back({c.path, {values.size()}, values, c.dimension});
  }
  return result;
}

BrownianCalibration read_calibration(const std::filesystem::path& file) {
  std::map<std::string, Dimension> dimensions;
  for (const Column& c : columns) dimensions[c.path] = c.dimension;
  const io::ResultFile result = io::read_result(file, "kbrown", dimensions);
  BrownianCalibration calibration;
  for (const Column& c : columns) {
    if (c.required) calibration.*c.values = result.require(c.path).values;
    else if (const io::Dataset* d = result.find(c.path)) calibration.*c.values = d->values;
  }
  const std::size_t n = calibration.temperature.size();
  const auto refuse = [&](const std::string& path, const std::string& what) { throw FileError(file.string() + ": " + path + ": " + what); };
  if (n == 0) refuse("/kbrown/temperature", "is empty");
  for (const Column& c : columns)
    if (!(calibration.*c.values).empty() && (calibration.*c.values).size() != n)
      refuse(c.path, "holds " + std::to_string((calibration.*c.values).size()) + " values, /kbrown/temperature " + std::to_string(n));
  for (std::size_t k = 0; k < n; ++k) {
    if (!(calibration.value[k] > 0)) refuse("/kbrown/value", "must be positive");
    if (!(calibration.time_step[k] > 0)) refuse("/kbrown/time_step", "must be positive");
    if (!(calibration.temperature[k] > 0) || (k > 0 && !(calibration.temperature[k] > calibration.temperature[k - 1])))
      refuse("/kbrown/temperature", "must be positive and rise");
  }
  return calibration;
}

}  // namespace pigment::calibration
