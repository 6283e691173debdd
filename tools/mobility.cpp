// mobility: how far particles move between frames, by direction, start height and size; speeds of each
// particle.
#include "analysis/mobility.h"

#include <fmt/format.h>

#include "analysis/trajectories.h"
#include "app/analysis_input.h"
#include "base/error.h"
#include "base/log.h"
#include "io/columns.h"

namespace {

using namespace pigment;
using analysis::Displacements;
using analysis::MobilityInterval;
using Storage = io::Dataset::Storage;

// Datasets [intervals, bands] and [intervals, bands, bins] of one group of particles; of(interval) lists its
// bands.
template <typename Of>
void add_group(io::ResultFile& result, const std::string& group, const analysis::Mobility& mobility,
               const Of& of) {
  const auto add = [&](const char* name, Dimension dimension, auto member,
                       Storage storage = Storage::Float64) {
    io::Dataset dataset{
        "/mobility/" + group + "/" + name, {mobility.intervals.size()}, {}, dimension, storage};
    dataset.shape.push_back(of(mobility.intervals.front()).size());
    for (const MobilityInterval& interval : mobility.intervals)
      for (const Displacements& band : of(interval))
        if constexpr (std::is_same_v<decltype(member), double Displacements::*>)
          dataset.values.push_back(band.*member);
        else
          dataset.values.insert(dataset.values.end(), (band.*member).begin(), (band.*member).end());
    if constexpr (!std::is_same_v<decltype(member), double Displacements::*>)
      dataset.shape.push_back(mobility.edges.size() - 1);
    result.datasets.push_back(std::move(dataset));
  };
  add("particles", Dimension::Number, &Displacements::particles, Storage::Int64);
  add("absolute", Dimension::InverseLength, &Displacements::absolute);
  add("vertical", Dimension::InverseLength, &Displacements::vertical);
  add("lateral", Dimension::InverseLength, &Displacements::lateral);
  add("mean_absolute", Dimension::Length, &Displacements::mean_absolute);
  add("mean_vertical", Dimension::Length, &Displacements::mean_vertical);
  add("rms_vertical", Dimension::Length, &Displacements::rms_vertical);
  add("rms_lateral", Dimension::Length, &Displacements::rms_lateral);
}

io::ResultFile to_result(const analysis::Mobility& mobility, const Particles& particles,
                         const analysis::Parameters& parameters) {
  io::ResultFile result;
  result.kind = "mobility";
  const auto add = [&](const char* name, Dimension dimension, auto member,
                       Storage storage = Storage::Float64) {
    result.datasets.push_back(io::column(
        std::string("/mobility/") + name, dimension,
        mobility.intervals, [member](const MobilityInterval& i) -> const auto& { return i.*member; },
        storage));
  };
  add("start_time", Dimension::Time, &MobilityInterval::start);
  add("time", Dimension::Time, &MobilityInterval::end);
  add("thickness", Dimension::Length, &MobilityInterval::thickness);
  add("band_edges", Dimension::Length, &MobilityInterval::band_edges);
  result.datasets.push_back(io::column("/mobility/surface_band", Dimension::Length, parameters.surface_band));
  result.datasets.push_back(
      io::column("/mobility/size_class_borders", Dimension::Length, parameters.size_classes));
  result.datasets.push_back(io::column("/mobility/edges", Dimension::Length, mobility.edges));
  add_group(
      result, "all_sizes", mobility, [](const MobilityInterval& i) -> const auto& { return i.all_sizes; });
  for (std::size_t c = 0; c < parameters.size_class_count(); ++c)
    add_group(
        result, fmt::format("size_class_{}", c),
        mobility, [c](const MobilityInterval& i) -> const auto& { return i.by_size_and_height[c]; });
  result.datasets.push_back(
      io::column("/mobility/particle_id", Dimension::Number, particles.id, Storage::Int64));
  add("local_speed", Dimension::Velocity, &MobilityInterval::speed, Storage::Float32);
  result.datasets.push_back(
      io::column("/mobility/global_displacement", Dimension::Length, mobility.displacement));
  result.datasets.push_back(io::column("/mobility/global_speed", Dimension::Velocity, mobility.speed));
  return result;
}

void add_trajectories(io::ResultFile& result, const analysis::Trajectories& paths, const Particles& particles) {
  const std::string group = "/mobility/trajectory/";
  std::vector<std::int64_t> id;
  std::vector<double> radius, position;
  for (const std::size_t i : paths.particle) {
    id.push_back(particles.id[i]);
    radius.push_back(particles.radius[i]);
  }
  for (const Vec3Array& frame : paths.position)
    for (const Vec3& p : frame) position.insert(position.end(), {p.x(), p.y(), p.z()});
  result.datasets.push_back(io::column(group + "particle_id", Dimension::Number, id, Storage::Int64));
  result.datasets.push_back(io::column(group + "radius", Dimension::Length, radius));
  result.datasets.push_back(io::column(group + "time", Dimension::Time, paths.time));
  result.datasets.push_back(io::column(group + "thickness", Dimension::Length, paths.thickness));
  result.datasets.push_back(
      {group + "position", {paths.time.size(), paths.particle.size(), 3}, position, Dimension::Length});
}

std::vector<std::size_t> frames_to_compare(const app::AnalysisInput& input) {
  const std::vector<double>& time = input.file->times();
  const std::string file = input.file->path().string();
  if (time.size() < 2)
    throw FileError(file + ": holds one frame; displacements need a trajectory of two or more");
  for (std::size_t k = 1; k < time.size(); ++k)
    if (!(time[k] > time[k - 1]))
      throw FileError(
          fmt::format("{}: /particles/layer/position/time: entry {} is {:g} s, not after the one before it "
                      "({:g} s); displacements need times that rise",
                      file, k, 1e-3 * time[k], 1e-3 * time[k - 1]));
  std::vector<std::size_t> numbers = analysis::choose_frames(time, input.parameters);
  if (numbers.size() < 2)
    throw InputError(fmt::format(
        "analysis.mobility_start, mobility_end, mobility_interval: choose fewer than two of the {} "
        "frames of {} ({:g} s to {:g} s); widen the window or shorten the interval",
        time.size(), file, 1e-3 * time.front(), 1e-3 * time.back()));
  return numbers;
}

}  // namespace

int main(int argc, char** argv) {
  app::AnalysisOptions options;
  const auto declare = [&](app::CommandLine& line) {
    line.describe(
        "Distributions of particle displacements between frames: absolute, vertical and lateral, by start "
        "height "
        "and size class; local and global speed of each particle; the paths of chosen ones.",
        "pigment-mobility trajectory.h5 --set 'analysis.mobility_interval=50 ms' -o mobility.h5");
    line.references(
        "Sand, A.: Microscopic Simulation of Pigment Coating Consolidation, Abo Akademi 2010, 3.5.2 and 4.3");
    app::declare_analysis(line, options);
  };
  return app::run_tool("mobility", argc, argv, declare, [&](app::CommandLine& line) {
    const app::AnalysisInput input = app::open_analysis_input(line, options, "mobility");
    const auto numbers = frames_to_compare(input);
    analysis::Parameters every_frame = input.parameters;
    every_frame.mobility_interval.reset();
    const auto window = analysis::choose_frames(input.file->times(), every_frame);
    const auto followed =
        analysis::choose_particles(input.frames.read(window.front()), input.particles().radius,
                                   input.particles().id, input.parameters);
    const auto mobility =
        analysis::measure_mobility(input.frames, numbers, input.particles().radius, input.parameters);
    io::ResultFile result = to_result(mobility, input.particles(), input.parameters);
    add_trajectories(result, analysis::follow_particles(input.frames, window, followed), input.particles());
    result.provenance = input.provenance;
    io::write_result(line.common.output, result);
    const double span = mobility.intervals.back().end - mobility.intervals.front().start;
    note(fmt::format("{} intervals over {:.4g} s", mobility.intervals.size(), 1e-3 * span));
  });
}
