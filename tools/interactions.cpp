// interactions: what the forces and resistances of a scene are worth, as curves against gap or at the rows of a table.
#include <fmt/format.h>

#include "app/tool.h"
#include "assembly/interaction_table.h"
#include "base/error.h"
#include "base/log.h"
#include "io/result_file.h"
#include "io/text_file.h"
#include "scene/interaction_file.h"
#include "scene/problem.h"

namespace {

using namespace pigment;

struct Options {
  app::path scene, csv;
  bool untapered = false;
};

void declare(app::CommandLine& line, Options& options) {
  line.describe(
      "Curves of every colloidal law of a scene (energy, force, stiffness) and of its resistances against gap, for the\n"
      "species' spheres of mean volume, the substrate and the free surface; or, with --csv, a table of values.\n\n"
      "--csv reads the columns a1,a2,h in metres: radii and gap. a2 is a radius, inf (the wall) or surface (the free\n"
      "surface). It writes a1,a2,h,kn,kt,ks,kp,ksp,f_electrostatic,f_vdw,f_born,f_steric,f_total in SI units.\n"
      "Two spheres: kn squeeze, ks shear (N s/m), ksp their coupling (N s, with the sign of a1 - a2), kt twist, kp pump\n"
      "(N m s), tapered as in a run. Wall and surface: what they add to isolated drag: kn perpendicular, ks parallel, kt\n"
      "twist, kp rotation about an axis in the plane, ksp the force on the liquid along x at unit rotation about y, with\n"
      "z from the boundary into the liquid. Forces in N, repulsion positive, with the potential of the first species; 0\n"
      "for a law that the scene does not have; f_total is the sum of all its laws, others than these four too.\n"
      "Without a scene: water at 25 degC, model exact, no colloidal laws.",
      "pigment-interactions scene.yaml --csv pairs.csv -o values.csv");
  line.references(
      "Sand, A.: Microscopic Simulation of Pigment Coating Consolidation, Abo Akademi 2010, 3.2 and 3.3\n"
      "Jeffrey, D. J., Onishi, Y.: Journal of Fluid Mechanics 139 (1984) 261 (two spheres)");
  line.positional("scene", options.scene, "the scene (YAML)", false);
  line.option("--csv", options.csv, "a table of a1,a2,h to evaluate instead of curves");
  line.flag("--untapered", options.untapered, "the pair term at every gap, without the taper to its cutoff");
  line.output_required(false, "the file to write; with --csv, standard output where it is left out");
}

// An empty name: to standard output.
void write(const app::path& output, const std::string& text) {
  if (output.empty()) {
    fmt::print("{}", text);
    return;
  }
  io::TextFile file(output);
  file.write(text);
  file.commit();
}

void run(const app::CommandLine& line, const Options& options) {
  if (options.csv.empty() && line.common.output.empty())
    throw InputError("-o: missing; curves are an HDF5 file: write e.g. \"-o interactions.h5\", or --csv for a table");
  config::Document document = options.scene.empty() ? config::Document::from_text("{}", "--set", line.common.set)
                                                    : config::Document(options.scene, line.common.set);
  const scene::Scene scene = scene::read_scene(document, "interactions");
  const assembly::InteractionEvaluator evaluator(
      scene::interactions_of(scene), liquid_at(scene.liquid, scene.liquid.temperature),
      options.untapered ? assembly::Reach::Untapered : assembly::Reach::Tapered);
  if (scene.species.empty() && !scene.colloidal.empty()) note("no particles in the scene: a surface potential of -25 mV taken");
  if (!options.csv.empty()) {
    const double potential = scene.species.empty() ? -25 : scene.species.front().surface_potential;
    write(line.common.output, assembly::evaluate_table(options.csv, evaluator, potential));
    return;
  }
  io::ResultFile result = scene::interaction_file_of(scene, evaluator);
  result.provenance = {"pigment-interactions", document.resolved(scene::stage("interactions").reads), {}};
  for (const Species& s : scene.species)
    if (!s.size.file.empty()) result.provenance.inputs["size of " + s.name] = io::sha256_of_file(s.size.file);
  io::write_result(line.common.output, result);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return app::run_tool(
      "interactions", argc, argv, [&](auto& line) { declare(line, options); }, [&](auto& line) { run(line, options); });
}
