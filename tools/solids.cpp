// solids: where the solids of a layer are, frame by frame: profiles over the thickness, by size class, and
// what follows.
#include <fmt/format.h>

#include "analysis/solids_profile.h"
#include "app/analysis_input.h"
#include "base/log.h"
#include "io/columns.h"

namespace {

using namespace pigment;
using analysis::SizeClassProfile;
using analysis::SolidsProfile;

void add_size_class(io::ResultFile& result, const std::vector<SolidsProfile>& profiles,
                    std::size_t size_class) {
  const auto add = [&](const char* name, std::vector<double> SizeClassProfile::*member) {
    const std::string path = fmt::format("/solids/size_class_{}/{}", size_class, name);
    result.datasets.push_back(io::column(
        path, Dimension::Number,
        profiles, [&](const SolidsProfile& p) -> const auto& { return p.size_classes[size_class].*member; }));
  };
  add("volume_fraction", &SizeClassProfile::volume_fraction);
  add("mass_fraction", &SizeClassProfile::mass_fraction);
  add("solids_fraction", &SizeClassProfile::solids_fraction);
  add("number", &SizeClassProfile::number);
  add("number_fraction", &SizeClassProfile::number_fraction);
  add("share", &SizeClassProfile::share);
}

io::ResultFile to_result(const analysis::SolidsDevelopment& development,
                         const analysis::Parameters& parameters) {
  io::ResultFile result;
  result.kind = "solids";
  const auto add = [&](const char* name, Dimension dimension, auto member) {
    result.datasets.push_back(io::column(
        std::string("/solids/") + name, dimension,
        development.profiles, [member](const SolidsProfile& p) -> const auto& { return p.*member; }));
  };
  add("time", Dimension::Time, &SolidsProfile::time);
  add("z_edges", Dimension::Length, &SolidsProfile::edges);
  add("volume_fraction", Dimension::VolumeFraction, &SolidsProfile::volume_fraction);
  add("mass_fraction", Dimension::MassFraction, &SolidsProfile::mass_fraction);
  add("cumulative_share", Dimension::Number, &SolidsProfile::cumulative_share);
  add("cumulative_mass_fraction", Dimension::MassFraction, &SolidsProfile::cumulative_mass_fraction);
  add("thickness", Dimension::Length, &SolidsProfile::thickness);
  add("mean_volume_fraction", Dimension::VolumeFraction, &SolidsProfile::mean_volume_fraction);
  add("mean_mass_fraction", Dimension::MassFraction, &SolidsProfile::mean_mass_fraction);
  add("mass_centre", Dimension::Length, &SolidsProfile::mass_centre);
  add("z95", Dimension::Length, &SolidsProfile::z95);
  add("z99", Dimension::Length, &SolidsProfile::z99);
  add("top_envelope", Dimension::Length, &SolidsProfile::top_envelope);
  add("protruding_fraction", Dimension::Number, &SolidsProfile::protruding_fraction);
  add("cake_thickness", Dimension::Length, &SolidsProfile::cake_thickness);
  add("skin_thickness", Dimension::Length, &SolidsProfile::skin_thickness);
  result.datasets.push_back(
      io::column("/solids/size_class_borders", Dimension::Length, parameters.size_classes));
  for (std::size_t c = 0; c < parameters.size_class_count(); ++c)
    add_size_class(result, development.profiles, c);

  using analysis::NonAffineInterval;
  const auto add_interval = [&](const char* name, Dimension dimension, auto member) {
    result.datasets.push_back(io::column(std::string("/solids/immobilisation/") + name, dimension,
                                         development.intervals,
                                         [member](const NonAffineInterval& i) { return i.*member; }));
  };
  add_interval("time", Dimension::Time, &NonAffineInterval::time);
  add_interval("non_affine_velocity", Dimension::Velocity, &NonAffineInterval::velocity);
  add_interval("shrinkage_rate", Dimension::Velocity, &NonAffineInterval::shrinkage_rate);
  add_interval("mass_centre_rate", Dimension::Velocity, &NonAffineInterval::mass_centre_rate);
  add_interval("redistribution", Dimension::Number, &NonAffineInterval::redistribution);
  result.datasets.push_back(io::column(
      "/solids/immobilisation/judged", Dimension::Number, development.intervals,
      [](const NonAffineInterval& i) { return i.judged ? 1 : 0; }, io::Dataset::Storage::Int64));
  if (development.immobilisation_time)
    result.numbers["immobilisation_time"] = to_si(Dimension::Time, *development.immobilisation_time);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  app::AnalysisOptions options;
  const auto declare = [&](app::CommandLine& line) {
    line.describe(
        "Solids profiles of a layer, vol-% and wt-%, over equal slices of its thickness in every frame; by "
        "size "
        "class; mass centre, z95, z99, cake and skin thickness, and when the layer became immobile.",
        "pigment-solids trajectory.h5 --scene scene.yaml -o solids.h5");
    line.references(
        "Sand, A.: Microscopic Simulation of Pigment Coating Consolidation, Abo Akademi 2010, 3.5.1 and 4.2");
    app::declare_analysis(line, options);
  };
  return app::run_tool("solids", argc, argv, declare, [&](app::CommandLine& line) {
    const app::AnalysisInput input = app::open_analysis_input(line, options, "solids");
    const auto development =
        analysis::follow_solids(input.frames, app::weigh_solids(input), input.parameters);
    io::ResultFile result = to_result(development, input.parameters);
    result.provenance = input.provenance;
    io::write_result(line.common.output, result);
    const SolidsProfile& last = development.profiles.back();
    note(fmt::format("{} frames; at the end {:.4g} um thick, {:.4g} wt-% solids, z95 {:.4g} um",
                     development.profiles.size(), last.thickness, 100 * last.mean_mass_fraction, last.z95));
  });
}
