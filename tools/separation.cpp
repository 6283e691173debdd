// separation: distribution of surface separations between near neighbours, frame by frame.
#include <fmt/format.h>

#include "analysis/separations.h"
#include "app/analysis_input.h"
#include "base/log.h"
#include "io/columns.h"

namespace {

using namespace pigment;
using analysis::Separations;
using Storage = io::Dataset::Storage;

io::ResultFile to_result(const analysis::SeparationDevelopment& development) {
  io::ResultFile result;
  result.kind = "separation";
  const auto add = [&](const char* name, Dimension dimension, auto member,
                       Storage storage = Storage::Float64) {
    result.datasets.push_back(io::column(
        std::string("/separation/") + name, dimension,
        development.frames, [member](const Separations& s) -> const auto& { return s.*member; }, storage));
  };
  add("time", Dimension::Time, &Separations::time);
  result.datasets.push_back(io::column("/separation/edges", Dimension::Length, development.edges));
  add("density", Dimension::InverseLength, &Separations::density);
  add("count", Dimension::Number, &Separations::count, Storage::Int64);
  add("pairs", Dimension::Number, &Separations::pairs, Storage::Int64);
  add("overlaps", Dimension::Number, &Separations::overlaps, Storage::Int64);
  add("mean", Dimension::Length, &Separations::mean);
  add("smallest", Dimension::Length, &Separations::smallest);
  add("neighbours_per_particle", Dimension::Number, &Separations::neighbours_per_particle);
  result.datasets.push_back(io::column("/separation/near_edges", Dimension::Length, development.near_edges));
  add("near_cumulative", Dimension::Number, &Separations::near_cumulative);
  add("near_pairs", Dimension::Number, &Separations::near_pairs, Storage::Int64);
  result.datasets.push_back(
      io::column("/separation/radial_edges", Dimension::Length, development.radial_edges));
  add("radial_distribution", Dimension::Number, &Separations::radial);
  result.numbers["limit"] = to_si(Dimension::Length, development.limit);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  app::AnalysisOptions options;
  const auto declare = [&](app::CommandLine& line) {
    line.describe(
        "Distribution of the surface separations of near neighbours in every frame, up to the smallest "
        "diameter, so "
        "that no particle lies between (or analysis.separation_limit), the cumulative one near contact, and the "
        "radial distribution function of the centres.",
        "pigment-separation trajectory.h5 --scene scene.yaml -o separation.h5");
    line.references(
        "Sand, A.: Microscopic Simulation of Pigment Coating Consolidation, Abo Akademi 2010, 3.5.3 and 4.4");
    app::declare_analysis(line, options);
  };
  return app::run_tool("separation", argc, argv, declare, [&](app::CommandLine& line) {
    const app::AnalysisInput input = app::open_analysis_input(line, options, "separation");
    if (input.parameters.separation_limit)
      app::require_within_half_period(input, "separation_limit", *input.parameters.separation_limit);
    if (input.parameters.radial_limit)
      app::require_within_half_period(input, "radial_limit", *input.parameters.radial_limit);
    app::require_within_half_period(input, "near_separation_limit", input.parameters.near_separation_limit);
    const auto development =
        analysis::measure_separations(input.frames, input.particles().radius, input.parameters);
    io::ResultFile result = to_result(development);
    result.provenance = input.provenance;
    io::write_result(line.common.output, result);
    const Separations& last = development.frames.back();
    note(fmt::format(
        "{} frames; at the end {} pairs closer than {:.4g} nm, {} closer than {:.4g} nm, smallest {:.4g} nm",
        development.frames.size(), last.pairs, 1e3 * development.limit, last.near_pairs,
        1e3 * development.near_edges.back(), 1e3 * last.smallest));
    if (last.overlaps > 0)
      warning(fmt::format("{} pairs overlap at the end; they count as separated by 0", last.overlaps));
  });
}
