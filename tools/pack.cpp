// pack: a layer of particles that do not touch, at the solids asked for.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/tool.h"
#include "base/log.h"
#include "io/columns.h"
#include "io/particle_file.h"
#include "packing/pack_layer.h"
#include "packing/statistics.h"
#include "scene/scene.h"

namespace {

using namespace pigment;

struct Options {
  app::path scene;
};

void declare(app::CommandLine& line, Options& options) {
  line.describe(
      "Packs the particles of a scene at random into its wet layer: no two touch, the solids are met "
      "exactly.",
      "pigment-pack scene.yaml -o packing.h5");
  line.references(
      "Sand, A.: Microscopic Simulation of Pigment Coating Consolidation, Abo Akademi 2010, 4.2 (the size "
      "law)\n"
      "Bitzek, E. et al.: Physical Review Letters 97 (2006) 170201 (removal of overlaps)\n"
      "Metropolis, N. et al.: The Journal of Chemical Physics 21 (1953) 1087 (equilibration)\n"
      "Stephens, M. A.: Journal of the Royal Statistical Society B 32 (1970) 115 (Kolmogorov-Smirnov)");
  line.positional("scene", options.scene,
                  "the scene (YAML): blocks layer, particles; packing, liquid, seed where there");
  line.output_required();
  line.has_threads();
}

packing::Recipe recipe_of(const scene::Scene& scene) {
  return {*scene.layer, scene.packing, scene.species, scene.liquid.density, scene.seed,
          scene.substrate && scene.substrate->roughness ? std::optional(height_map(*scene.substrate->roughness)) : std::nullopt};
}

// One bar a stage.
packing::OnProgress progress_by_stage() {
  struct Bar {
    std::string stage;
    std::unique_ptr<Progress> progress;
  };
  auto bar = std::make_shared<Bar>();
  return [bar](const std::string& stage, double fraction) {
    if (stage != bar->stage) {
      bar->progress.reset();
      bar->progress = std::make_unique<Progress>(stage);
      bar->stage = stage;
    }
    bar->progress->update(fraction);
  };
}

// What cannot be packed is reported with its line in the scene.
packing::Packing pack(const scene::Scene& scene, config::Document& document) {
  try {
    return packing::pack_layer(recipe_of(scene), progress_by_stage());
  } catch (const packing::Impossible& impossible) {
    document.root().block(impossible.block).error(impossible.key, impossible.reason);
    document.check();
    throw;
  }
}

struct Report {
  packing::Solids solids;
  packing::SmallestGaps gaps;
  packing::ProfileFlatness profile;
  std::vector<packing::SizeAgreement> sizes;  // one a species
};

void tell(const packing::Packing& packing, const Report& report, const std::vector<std::string>& species) {
  const Cell& cell = packing.layer.cell;
  note(fmt::format("{} particles in {:.6g} x {:.6g} x {:.6g} um (the width asked for, times {:.5f})",
                   packing.layer.particles.size(), cell.width_x, cell.width_y, cell.height,
                   packing.width_scale));
  note(fmt::format("solids {:.6g} wt% ({:.6g} vol%), dry coat weight {:.4g} g/m2",
                   100 * report.solids.mass_fraction, 100 * report.solids.volume_fraction,
                   1e3 * to_si(Dimension::AreaDensity, report.solids.coat_weight)));
  if (packing.inserted_overlapping > 0)
    note(fmt::format("{} particles found no free place; their overlaps went in {} steps",
                     packing.inserted_overlapping, packing.relaxation_steps));
  note(fmt::format(
      "smallest gap {}to the substrate {:.4g} nm, to the surface {:.4g} nm",
      std::isfinite(report.gaps.particles) ? fmt::format("{:.4g} nm, ", 1e3 * report.gaps.particles) : "",
      1e3 * report.gaps.substrate, 1e3 * report.gaps.surface));
  for (std::size_t s = 0; s < species.size(); ++s) {
    const packing::SizeAgreement& sizes = report.sizes[s];
    note(
        fmt::format("{}: {} particles; distance from the size law by number {:.2g} (p = {:.2g}), by weight "
                    "{:.2g} (p = {:.2g})",
                    species[s], sizes.count, sizes.by_number.distance, sizes.by_number.p_value,
                    sizes.by_weight.distance, sizes.by_weight.p_value));
  }
  note(
      fmt::format("volume fraction {:.3f} in the outer 1 um below, {:.3f} between (slices differ by {:.1f} "
                  "%), {:.3f} above",
                  report.profile.outer_bottom, report.profile.inner, 100 * report.profile.inner_deviation,
                  report.profile.outer_top));
  if (std::abs(packing.width_scale - 1) > 0.05)
    warning(fmt::format(
        "the layer holds so few particles that its width had to change by {:.1f} % to meet the solids",
        100 * (packing.width_scale - 1)));
}

// The same below /packing in the file.
std::vector<io::Dataset> datasets_of(const packing::Packing& packing, const Report& report) {
  std::vector<io::Dataset> datasets;
  const auto scalar = [&](const char* name, double value, Dimension dimension = Dimension::Number) {
    datasets.push_back(
        {std::string("/packing/") + name, {}, {value}, dimension, io::Dataset::Storage::Float64});
  };
  scalar("solids_mass_fraction", report.solids.mass_fraction, Dimension::MassFraction);
  scalar("solids_volume_fraction", report.solids.volume_fraction, Dimension::VolumeFraction);
  scalar("coat_weight", report.solids.coat_weight, Dimension::AreaDensity);
  scalar("width_scale", packing.width_scale);
  if (std::isfinite(report.gaps.particles)) scalar("smallest_gap", report.gaps.particles, Dimension::Length);
  scalar("smallest_gap_to_substrate", report.gaps.substrate, Dimension::Length);
  scalar("smallest_gap_to_surface", report.gaps.surface, Dimension::Length);
  scalar("inserted_overlapping", static_cast<double>(packing.inserted_overlapping));
  scalar("relaxation_steps", packing.relaxation_steps);
  scalar("equilibration_acceptance", packing.acceptance);

  using packing::SizeAgreement;
  const auto by_species = [&](const char* name, auto value) {
    datasets.push_back(
        io::column(std::string("/packing/sizes/") + name, Dimension::Number, report.sizes, value));
  };
  datasets.push_back(io::column(
      "/packing/sizes/count", Dimension::Number, report.sizes, [](const SizeAgreement& s) { return s.count; },
      io::Dataset::Storage::Int64));
  by_species("number_distance", [](const SizeAgreement& s) { return s.by_number.distance; });
  by_species("number_p_value", [](const SizeAgreement& s) { return s.by_number.p_value; });
  by_species("weight_distance", [](const SizeAgreement& s) { return s.by_weight.distance; });
  by_species("weight_p_value", [](const SizeAgreement& s) { return s.by_weight.p_value; });

  const packing::ProfileFlatness& profile = report.profile;
  datasets.push_back(io::column("/packing/profile/z_edges", Dimension::Length, profile.edges));
  datasets.push_back(
      io::column("/packing/profile/volume_fraction", Dimension::VolumeFraction, profile.volume_fraction));
  scalar("profile/outer_bottom", profile.outer_bottom, Dimension::VolumeFraction);
  scalar("profile/inner", profile.inner, Dimension::VolumeFraction);
  scalar("profile/outer_top", profile.outer_top, Dimension::VolumeFraction);
  scalar("profile/inner_deviation", profile.inner_deviation);
  return datasets;
}

void run(const app::CommandLine& line, const Options& options) {
  config::Document document(options.scene, line.common.set);
  const scene::Scene scene = scene::read_scene(document, "pack");
  io::Provenance provenance{"pigment-pack", document.resolved(scene::stage("pack").reads), {}};
  std::vector<std::string> names;
  for (const Species& s : scene.species) {
    names.push_back(s.name);
    if (!s.size.file.empty()) provenance.inputs["size of " + s.name] = io::sha256_of_file(s.size.file);
  }

  if (scene.substrate && scene.substrate->roughness && !scene.substrate->roughness->file.empty())
    provenance.inputs["heights"] = io::sha256_of_file(scene.substrate->roughness->file);
  const packing::Packing packing = pack(scene, document);
  const Report report{packing::solids_of(packing.layer, scene.liquid.density),
                      packing::smallest_gaps(packing.layer), packing::measure_flatness(packing.layer, 30),
                      packing::compare_sizes(packing.layer, packing.sizes)};
  tell(packing, report, names);
  io::write_packing(line.common.output, packing.layer, names, datasets_of(packing, report), provenance);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return pigment::app::run_tool(
      "pack", argc, argv, [&](auto& line) { declare(line, options); },
      [&](auto& line) { run(line, options); });
}
