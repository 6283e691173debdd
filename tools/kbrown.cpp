// kbrown: calibrates the constant of the Brownian force.
#include <fmt/format.h>

#include <algorithm>

#include "app/tool.h"
#include "base/log.h"
#include "calibration/brownian_calibration.h"
#include "calibration/calibration_file.h"
#include "config/node.h"
#include "scene/scene.h"

using namespace pigment;

namespace {

app::path scene_path;

void declare(app::CommandLine& line) {
  line.describe("Calibrates K_Brown, the constant of the Brownian force, by moving a lone sphere with the engine's own step, at the\n"
                "temperatures of the scene's brownian.calibration (the liquid's unless told otherwise).",
                "pigment-kbrown scene.yaml -o kbrown.h5");
  line.references("Sand, thesis (2010), section 3.3.3, equations (23)-(25)");
  line.positional("scene", scene_path, "the scene");
  line.output_required();
  line.has_threads();
}

void run(app::CommandLine& line) {
  config::Document document(scene_path, line.common.set);
  const scene::Scene scene = scene::read_scene(document, "kbrown");
  const forces::BrownianParameters& brownian = *scene.brownian;
  calibration::CalibrationSettings settings;
  settings.temperatures = brownian.temperatures.empty() ? std::vector<double>{scene.liquid.temperature} : brownian.temperatures;
  std::sort(settings.temperatures.begin(), settings.temperatures.end());
  settings.temperatures.erase(std::unique(settings.temperatures.begin(), settings.temperatures.end()), settings.temperatures.end());
  settings.simulations = brownian.simulations;
  settings.displacements = brownian.displacements;
  settings.time_step = brownian.time_step.value_or(settings.time_step);
  settings.radius = brownian.diameter / 2;
  settings.seed = scene.seed;

  Progress progress("kbrown");
  const BrownianCalibration result = calibration::calibrate(scene.liquid, settings, [&](double f) { progress.update(f); });
  progress.finish();
  for (std::size_t k = 0; k < result.temperature.size(); ++k) {
    const auto si = [](double v) { return to_si(Dimension::BrownianConstant, v); };
    note(fmt::format("{:.2f} K: K_Brown {:.5g} N m^-1/2, s.d. {:.2g} over {} simulations, at steps of {:.3g} s; closed form {:.5g}",
                     result.temperature[k], si(result.value[k]), si(result.standard_deviation[k]), settings.simulations,
                     to_si(Dimension::Time, result.time_step[k]), si(result.closed_form[k])));
  }
  io::ResultFile file = calibration::result_of(result);
  file.provenance = {"pigment-kbrown", document.resolved(scene::stage("kbrown").reads), {}};
  io::write_result(line.common.output, file);
}

}  // namespace

int main(int argc, char** argv) { return app::run_tool("kbrown", argc, argv, declare, run); }
