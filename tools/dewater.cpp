// dewater: the dewatering curve of a scene.
#include <fmt/format.h>

#include "app/tool.h"
#include "base/log.h"
#include "config/node.h"
#include "dewatering/dewatering_file.h"
#include "io/result_file.h"
#include "scene/scene.h"

using namespace pigment;

namespace {

app::path scene_path;

void declare(app::CommandLine& line) {
  line.describe("The liquid that leaves a layer by absorption and evaporation, against time, as its scene's blocks layer,\n"
                "particles, liquid and dewatering say: strategies HLL, LLH, ABS, EVA, or a table.",
                "pigment-dewater scene.yaml --set dewatering.strategy=LLH -o dewatering.h5");
  line.references("Sand, thesis (2010), equation (1) and section 4.2; Usher et al., AIChE Journal 47 (2001) 1561");
  line.positional("scene", scene_path, "the scene");
  line.output_required();
}

void report(const dewatering::Profile& profile, const dewatering::Coating& coating) {
  note(fmt::format("{:.4g} um of liquid leave within {:.4g} s: {:.4g} um absorbed, {:.4g} um evaporated; scale {:.6g}",
                   profile.removed, to_si(Dimension::Time, profile.duration), profile.curve.absorbed_at(profile.duration),
                   profile.curve.evaporated_at(profile.duration), profile.scale));
  const double liquid = (1 - coating.volume_fraction) * coating.thickness;
  if (profile.removed > liquid)
    warning(fmt::format("the layer holds {:.4g} um of liquid only: it is dry before {:.4g} s", liquid,
                        to_si(Dimension::Time, profile.duration)));
}

void run(app::CommandLine& line) {
  config::Document document(scene_path, line.common.set);
  const scene::Scene scene = scene::read_scene(document, "dewater");
  const dewatering::Coating coating = scene::coating_of(scene);
  const dewatering::Profile profile = dewatering::make_profile(*scene.dewatering, coating);
  report(profile, coating);
  io::ResultFile result = dewatering::result_of(profile);
  result.provenance = {"pigment-dewater", document.resolved(scene::stage("dewater").reads), {}};
  if (!scene.dewatering->file.empty()) result.provenance.inputs["dewatering"] = io::sha256_of_file(scene.dewatering->file);
  io::write_result(line.common.output, result);
}

}  // namespace

int main(int argc, char** argv) { return app::run_tool("dewater", argc, argv, declare, run); }
