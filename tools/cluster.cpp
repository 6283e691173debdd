// cluster: which particles hang together, frame by frame.
#include <fmt/format.h>

#include "analysis/clusters.h"
#include "app/analysis_input.h"
#include "base/log.h"
#include "io/columns.h"

namespace {

using namespace pigment;
using analysis::Clusters;
using Storage = io::Dataset::Storage;

io::ResultFile to_result(const std::vector<Clusters>& frames, const Particles& particles, double threshold) {
  io::ResultFile result;
  result.kind = "cluster";
  const auto add = [&](const char* name, Dimension dimension, auto member,
                       Storage storage = Storage::Float64) {
    result.datasets.push_back(io::column(
        std::string("/cluster/") + name, dimension,
        frames, [member](const Clusters& c) -> const auto& { return c.*member; }, storage));
  };
  add("time", Dimension::Time, &Clusters::time);
  result.datasets.push_back(
      io::column("/cluster/particle_id", Dimension::Number, particles.id, Storage::Int64));
  add("id", Dimension::Number, &Clusters::id, Storage::Int64);
  add("size", Dimension::Number, &Clusters::size, Storage::Int64);
  add("neighbours", Dimension::Number, &Clusters::neighbours, Storage::Int64);
  add("extent", Dimension::Length, &Clusters::extent, Storage::Float32);
  add("count", Dimension::Number, &Clusters::count, Storage::Int64);
  add("connections", Dimension::Number, &Clusters::connections, Storage::Int64);
  add("largest", Dimension::Number, &Clusters::largest, Storage::Int64);
  add("clustered_fraction", Dimension::Number, &Clusters::clustered_fraction);
  add("clustered_volume_fraction", Dimension::Number, &Clusters::clustered_volume_fraction);
  add("largest_fraction", Dimension::Number, &Clusters::largest_fraction);
  add("largest_extent", Dimension::Length, &Clusters::largest_extent);
  result.datasets.push_back(io::column(
      "/cluster/percolates", Dimension::Number, frames,
      [](const Clusters& c) { return c.percolates ? 1 : 0; }, Storage::Int64));
  result.numbers["threshold"] = to_si(Dimension::Length, threshold);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  app::AnalysisOptions options;
  const auto declare = [&](app::CommandLine& line) {
    line.describe(
        "Clusters of particles whose surfaces are closer than analysis.cluster_threshold, in every frame: "
        "identity, "
        "size, neighbours, vertical extent, and whether one reaches from the substrate to the surface.",
        "pigment-cluster trajectory.h5 --set 'analysis.cluster_threshold=50 nm' -o cluster.h5");
    line.references(
        "Sand, A.: Microscopic Simulation of Pigment Coating Consolidation, Abo Akademi 2010, 3.5.3 and 4.5");
    app::declare_analysis(line, options);
  };
  return app::run_tool("cluster", argc, argv, declare, [&](app::CommandLine& line) {
    const app::AnalysisInput input = app::open_analysis_input(line, options, "cluster");
    const double threshold = input.parameters.cluster_threshold;
    app::require_within_half_period(input, "cluster_threshold", threshold);
    const auto frames =
        analysis::find_clusters(input.frames, input.particles().radius, input.particles().id, threshold);
    io::ResultFile result = to_result(frames, input.particles(), threshold);
    result.provenance = input.provenance;
    io::write_result(line.common.output, result);
    const Clusters& last = frames.back();
    note(fmt::format("{} frames; at the end {} clusters hold {:.3g} % of the particles, the largest {}{}",
                     frames.size(), last.count, 100 * last.clustered_fraction, last.largest,
                     last.percolates ? "; one reaches from the substrate to the surface" : ""));
  });
}
