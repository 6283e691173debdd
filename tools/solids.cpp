// solids: where the solids of a layer are, frame by frame: profiles over the thickness, by size class, and
// what follows.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/histogram.h"
#include "analysis/local_solids.h"
#include "analysis/pores.h"
#include "analysis/solids_profile.h"
#include "app/analysis_input.h"
#include "base/log.h"
#include "io/columns.h"

namespace {

using namespace pigment;
using analysis::GroupProfile;
using analysis::SolidsProfile;
using Storage = io::Dataset::Storage;

// prefix: "/solids/size_class_", groups: which of the profile's lists.
void add_group(io::ResultFile& result, const std::vector<SolidsProfile>& profiles, const char* prefix,
               std::vector<GroupProfile> SolidsProfile::*groups, std::size_t group) {
  const auto add = [&](const char* name, std::vector<double> GroupProfile::*member) {
    const std::string path = fmt::format("{}{}/{}", prefix, group, name);
    result.datasets.push_back(io::column(
        path, Dimension::Number,
        profiles, [&](const SolidsProfile& p) -> const auto& { return (p.*groups)[group].*member; }));
  };
  add("volume_fraction", &GroupProfile::volume_fraction);
  add("mass_fraction", &GroupProfile::mass_fraction);
  add("solids_fraction", &GroupProfile::solids_fraction);
  add("number", &GroupProfile::number);
  add("number_fraction", &GroupProfile::number_fraction);
  add("share", &GroupProfile::share);
}

io::ResultFile to_result(const analysis::SolidsDevelopment& development,
                         const analysis::Parameters& parameters, const Cell& cell) {
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
  add("shrinkage", Dimension::Number, &SolidsProfile::shrinkage);
  add("porosity", Dimension::Number, &SolidsProfile::porosity);
  add("mass_centre", Dimension::Length, &SolidsProfile::mass_centre);
  add("z95", Dimension::Length, &SolidsProfile::z95);
  add("z99", Dimension::Length, &SolidsProfile::z99);
  add("top_envelope", Dimension::Length, &SolidsProfile::top_envelope);
  const ColumnGrid columns = columns_of(cell, parameters.envelope_column);
  io::Dataset top = io::column(
      "/solids/top_height", Dimension::Length, development.profiles,
      [](const SolidsProfile& p) -> const auto& { return p.top_height; }, Storage::Float32);
  top.shape = {development.profiles.size(), columns.x, columns.y};
  result.datasets.push_back(std::move(top));
  add("protruding_fraction", Dimension::Number, &SolidsProfile::protruding_fraction);
  add("cake_thickness", Dimension::Length, &SolidsProfile::cake_thickness);
  add("skin_thickness", Dimension::Length, &SolidsProfile::skin_thickness);
  result.datasets.push_back(
      io::column("/solids/size_class_borders", Dimension::Length, parameters.size_classes));
  for (std::size_t c = 0; c < parameters.size_class_count(); ++c)
    add_group(result, development.profiles, "/solids/size_class_", &SolidsProfile::size_classes, c);
  for (std::size_t k = 0; k < development.profiles.front().species.size(); ++k)
    add_group(result, development.profiles, "/solids/species_", &SolidsProfile::species, k);

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
      [](const NonAffineInterval& i) { return i.judged ? 1 : 0; }, Storage::Int64));
  if (development.immobilisation_time)
    result.numbers["immobilisation_time"] = to_si(Dimension::Time, *development.immobilisation_time);
  return result;
}

// Local solids and pores of the frames that the parameters choose: datasets [frames looked at, ...].
void add_structure(io::ResultFile& result, const app::AnalysisInput& input) {
  const analysis::Parameters& parameters = input.parameters;
  using Structure = analysis::Parameters::Structure;
  if (parameters.structure == Structure::None) return;
  const std::size_t first = parameters.structure == Structure::Last ? input.frames.count - 1 : 0;
  const analysis::Frames frames{input.frames.count - first,
                                [&](std::size_t k) { return input.frames.read(first + k); }};
  const std::vector<double> time(input.file->times().begin() + static_cast<std::ptrdiff_t>(first),
                                 input.file->times().end());
  const std::vector<double>& radius = input.particles().radius;

  using analysis::LocalSolids;
  const auto local = analysis::measure_frames(
      frames, [&](const analysis::Snapshot& frame) { return analysis::local_solids(frame, radius); });
  const auto add_local = [&](const char* name, Dimension dimension, auto member, Storage storage) {
    result.datasets.push_back(io::column(
        std::string("/solids/local/") + name, dimension,
        local, [member](const LocalSolids& l) -> const auto& { return l.*member; }, storage));
  };
  result.datasets.push_back(io::column("/solids/local/time", Dimension::Time, time));
  result.datasets.push_back(
      io::column("/solids/local/particle_id", Dimension::Number, input.particles().id, Storage::Int64));
  add_local("cell_volume", Dimension::Volume, &LocalSolids::cell_volume, Storage::Float64);
  add_local("solids_fraction", Dimension::VolumeFraction, &LocalSolids::solids_fraction, Storage::Float32);
  add_local("surrounding_fraction", Dimension::VolumeFraction, &LocalSolids::surrounding_fraction,
            Storage::Float32);
  const ColumnGrid columns = columns_of(input.file->layer(0).cell, parameters.envelope_column);
  std::vector<analysis::LocalCake> cakes;
  for (std::size_t k = 0; k < frames.count; ++k)
    cakes.push_back(analysis::local_cake(frames.read(k), radius, local[k], parameters.cake_solids,
                                         parameters.wall_layer, columns));
  io::Dataset height = io::column(
      "/solids/local/cake_height", Dimension::Length, cakes,
      [](const analysis::LocalCake& c) -> const auto& { return c.height; }, Storage::Float32);
  height.shape = {cakes.size(), columns.x, columns.y};
  result.datasets.push_back(std::move(height));
  result.datasets.push_back(io::column("/solids/local/mean_cake_height", Dimension::Length, cakes,
                                       [](const analysis::LocalCake& c) { return c.mean_height; }));
  result.datasets.push_back(io::column("/solids/local/cake_roughness", Dimension::Length, cakes,
                                       [](const analysis::LocalCake& c) { return c.roughness; }));
  add_local("cell_neighbours", Dimension::Number, &LocalSolids::cell_neighbours, Storage::Int64);

  using analysis::Pores;
  std::vector<Pores> pores;
  double widest = 0;
  for (std::size_t k = 0; k < frames.count; ++k) {
    pores.push_back(
        analysis::measure_pores(frames.read(k), radius, static_cast<std::size_t>(parameters.pore_points)));
    if (!pores.back().distance.empty()) widest = std::max(widest, pores.back().distance.back());
  }
  if (!(widest > 0)) widest = 1e-3;  // no pores: any edges will do
  const auto bins = static_cast<std::size_t>(parameters.pore_bins);
  const auto add_pores = [&](const char* name, Dimension dimension, const auto& value) {
    result.datasets.push_back(io::column(std::string("/solids/pores/") + name, dimension, pores, value));
  };
  result.datasets.push_back(io::column("/solids/pores/time", Dimension::Time, time));
  result.datasets.push_back(
      io::column("/solids/pores/edges", Dimension::Length, analysis::equal_bins(widest, bins)));
  add_pores("density", Dimension::InverseLength, [&](const Pores& p) {
    analysis::Histogram histogram(widest, bins);
    for (const double d : p.distance) histogram.add(d);
    return histogram.density(static_cast<double>(p.distance.size()));
  });
  add_pores("mean_distance", Dimension::Length, [](const Pores& p) { return p.mean_distance(); });
  add_pores("largest_distance", Dimension::Length,
            [](const Pores& p) { return p.distance.empty() ? 0.0 : p.distance.back(); });
  add_pores("specific_surface", Dimension::InverseLength, [](const Pores& p) { return p.specific_surface; });
  add_pores("hydraulic_diameter", Dimension::Length, [](const Pores& p) { return p.hydraulic_diameter; });
  add_pores("porosity", Dimension::Number, [](const Pores& p) { return p.porosity; });
}

}  // namespace

int main(int argc, char** argv) {
  app::AnalysisOptions options;
  const auto declare = [&](app::CommandLine& line) {
    line.describe(
        "Solids profiles of a layer, vol-% and wt-%, over equal slices of its thickness in every frame; by "
        "size class and species; mass centre, z95, z99, cake and skin thickness, and when the layer became immobile; of the last "
        "frame the solids in each particle's own space, and the pores.",
        "pigment-solids trajectory.h5 --scene scene.yaml -o solids.h5");
    line.references(
        "Sand, A.: Microscopic Simulation of Pigment Coating Consolidation, Abo Akademi 2010, 3.5.1 and 4.2");
    app::declare_analysis(line, options);
  };
  return app::run_tool("solids", argc, argv, declare, [&](app::CommandLine& line) {
    const app::AnalysisInput input = app::open_analysis_input(line, options, "solids");
    const auto development =
        analysis::follow_solids(input.frames, app::weigh_solids(input), input.parameters);
    io::ResultFile result = to_result(development, input.parameters, input.file->layer(0).cell);
    add_structure(result, input);
    result.provenance = input.provenance;
    io::write_result(line.common.output, result);
    const SolidsProfile& last = development.profiles.back();
    note(fmt::format("{} frames; at the end {:.4g} um thick, {:.4g} wt-% solids, z95 {:.4g} um",
                     development.profiles.size(), last.thickness, 100 * last.mean_mass_fraction, last.z95));
  });
}
