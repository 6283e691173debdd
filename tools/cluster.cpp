// cluster: which particles hang together, frame by frame.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/clusters.h"
#include "app/analysis_input.h"
#include "base/log.h"
#include "io/columns.h"

namespace {

using namespace pigment;
using analysis::Clusters;
using Storage = io::Dataset::Storage;

// The connections of all frames behind one another; begin[k] is where those of frame k begin.
void add_connections(io::ResultFile& result, const std::vector<Clusters>& frames) {
  std::vector<std::int64_t> begin{0}, first, second;
  std::vector<double> separation;
  for (const Clusters& frame : frames) {
    for (const analysis::Connection& c : frame.pairs) {
      first.push_back(c.first);
      second.push_back(c.second);
      separation.push_back(c.separation);
    }
    begin.push_back(static_cast<std::int64_t>(first.size()));
  }
  const std::string group = "/cluster/connection/";
  result.datasets.push_back(io::column(group + "begin", Dimension::Number, begin, Storage::Int64));
  result.datasets.push_back(io::column(group + "first", Dimension::Number, first, Storage::Int64));
  result.datasets.push_back(io::column(group + "second", Dimension::Number, second, Storage::Int64));
  result.datasets.push_back(io::column(group + "separation", Dimension::Length, separation, Storage::Float32));
}

// Particles by their number of neighbours, [frames, most neighbours + 1].
io::Dataset coordination_of(const std::vector<Clusters>& frames) {
  std::size_t most = 1;
  for (const Clusters& c : frames) most = std::max(most, c.coordination.size());
  return io::column(
      "/cluster/coordination", Dimension::Number, frames,
      [most](const Clusters& c) {
        auto counts = c.coordination;
        counts.resize(most, 0);
        return counts;
      },
      Storage::Int64);
}

io::ResultFile to_result(const std::vector<Clusters>& frames, const Particles& particles, double threshold,
                         const ColumnGrid& columns) {
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
  add("mean_coordination", Dimension::Number, &Clusters::mean_coordination);
  result.datasets.push_back(coordination_of(frames));
  add_connections(result, frames);
  io::Dataset cake = io::column(
      "/cluster/cake_height", Dimension::Length, frames,
      [](const Clusters& c) -> const auto& { return c.cake_height; }, Storage::Float32);
  cake.shape = {frames.size(), columns.x, columns.y};
  result.datasets.push_back(std::move(cake));
  add("mean_cake_height", Dimension::Length, &Clusters::mean_cake_height);
  add("cake_roughness", Dimension::Length, &Clusters::cake_roughness);
  if (const auto time = analysis::percolation_time(frames))
    result.numbers["percolation_time"] = to_si(Dimension::Time, *time);
  result.numbers["threshold"] = to_si(Dimension::Length, threshold);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  app::AnalysisOptions options;
  const auto declare = [&](app::CommandLine& line) {
    line.describe(
        "Clusters of particles whose surfaces are closer than analysis.cluster_threshold, in every frame: "
        "identity, size, neighbours, vertical extent, connections with their distances, whether and when one "
        "reaches from the substrate to the surface, and the height of the filter cake from place to place.",
        "pigment-cluster trajectory.h5 --set 'analysis.cluster_threshold=50 nm' -o cluster.h5");
    line.references(
        "Sand, A.: Microscopic Simulation of Pigment Coating Consolidation, Abo Akademi 2010, 3.5.3 and 4.5");
    app::declare_analysis(line, options);
  };
  return app::run_tool("cluster", argc, argv, declare, [&](app::CommandLine& line) {
    const app::AnalysisInput input = app::open_analysis_input(line, options, "cluster");
    const double threshold = input.parameters.cluster_threshold;
    app::require_within_half_period(input, "cluster_threshold", threshold);
    const ColumnGrid columns = columns_of(input.file->layer(0).cell, input.parameters.envelope_column);
    const auto frames = analysis::find_clusters(input.frames, input.particles().radius, input.particles().id,
                                                threshold, columns);
    io::ResultFile result = to_result(frames, input.particles(), threshold, columns);
    result.provenance = input.provenance;
    io::write_result(line.common.output, result);
    const Clusters& last = frames.back();
    note(fmt::format("{} frames; at the end {} clusters hold {:.3g} % of the particles, the largest {}{}",
                     frames.size(), last.count, 100 * last.clustered_fraction, last.largest,
                     last.percolates ? "; one reaches from the substrate to the surface" : ""));
  });
}
