// consolidate: moves the particles of a packing while the layer loses its liquid, until it is immobile.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numeric>

#include "app/tool.h"
#include "base/error.h"
#include "base/log.h"
#include "base/version.h"
#include "calibration/calibration_file.h"
#include "config/node.h"
#include "dewatering/dewatering_file.h"
#include "io/checkpoint_file.h"
#include "io/particle_file.h"
#include "io/trajectory_writer.h"
#include "scene/problem.h"
#include "scene/scene.h"
#include "stepping/consolidate.h"

using namespace pigment;

namespace {

struct Options {
  app::path scene, packing, dewatering, kbrown;
  double checkpoint_every = 30;
  bool restart = false;
} options;

void declare(app::CommandLine& line) {
  line.describe("Moves the particles of a packing under hydrodynamic, colloidal, surface and Brownian forces while the layer loses\n"
                "its liquid, and writes the trajectory. Stopped by a signal it saves a checkpoint; the same command goes on from it.",
                "pigment-consolidate scene.yaml --packing packing.h5 --dewatering dewatering.h5 -o trajectory.h5");
  line.references("Sand, thesis (2010), chapter 3; docs/physics.md lists every deviation");
  line.positional("scene", options.scene, "the scene");
  line.option("--packing", options.packing, "the particles (packing.h5, or box, position and radius made by hand)", true);
  line.option("--dewatering", options.dewatering, "the liquid lost against time (dewatering.h5); without it the liquid rests");
  line.option("--kbrown", options.kbrown, "calibration of K_Brown (kbrown.h5); without it the closed form is used");
  line.option("--checkpoint-every", options.checkpoint_every, "wall time between checkpoints besides those at frames, s (default 30)");
  line.flag("--restart", options.restart, "set an existing checkpoint aside and begin anew");
  line.output_required();
  line.has_threads();
}

std::vector<io::ObservableInfo> observables(const assembly::Interactions& interactions) {
  std::vector<io::ObservableInfo> infos;
  for (const auto& o : stepping::observable_names(interactions)) infos.push_back({o.name, o.dimension});
  return infos;
}

// Whether a state is one to go on from: what is not finite, or lacks its last frame, would only fail again otherwise.
bool is_sound(const stepping::RunState& state, const io::TrajectoryWriter& writer) {
  return static_cast<std::size_t>(state.frame) == writer.frame_count() &&
         std::all_of(state.position.begin(), state.position.end(), [](const Vec3& p) { return p.allFinite(); });
}

void run(app::CommandLine& line) {
  if (options.checkpoint_every < 0)
    throw InputError(fmt::format("--checkpoint-every: {} is not a time; write 0 s or more", options.checkpoint_every));
  app::keep_freed_memory();
  config::Document document(options.scene, line.common.set);
  const scene::Scene scene = scene::read_scene(document, "consolidate");
  auto packing = std::make_unique<const io::ParticleFile>(options.packing);
  io::Provenance provenance{"pigment-consolidate", document.resolved(scene::stage("consolidate").reads), {}};
  provenance.inputs["packing"] = io::sha256_of_file(options.packing);

  stepping::Problem problem = scene::problem_of(scene, *packing);
  if (!options.dewatering.empty()) {
    problem.dewatering = dewatering::read_curve(options.dewatering);
    provenance.inputs["dewatering"] = io::sha256_of_file(options.dewatering);
  }
  if (!options.kbrown.empty()) {
    problem.calibration = calibration::read_calibration(options.kbrown);
    provenance.inputs["kbrown"] = io::sha256_of_file(options.kbrown);
  } else if (problem.interactions.brownian && problem.interactions.brownian->model == forces::BrownianParameters::Model::KBrown) {
    note("no --kbrown given: K_Brown by its closed form");
  }
  if (scene.substrate && scene.substrate->roughness && !scene.substrate->roughness->file.empty())
    provenance.inputs["heights"] = io::sha256_of_file(scene.substrate->roughness->file);
  const stepping::RunSettings settings = scene::run_settings_of(scene, problem);

  std::map<std::string, std::string> inputs = provenance.inputs;
  inputs["scene"] = io::sha256_of_text(provenance.scene);
  inputs["version"] = version;
  // Another build of the same version may keep another state, and would not go on with the same bytes.
  if (const std::filesystem::path self = "/proc/self/exe"; std::filesystem::exists(self)) inputs["program"] = io::sha256_of_file(self);
  if (options.restart) io::set_checkpoint_aside(line.common.output);
  stepping::RunState state;
  Layer first = packing->layer(0);
  if (const auto checkpoint = io::read_checkpoint(line.common.output, inputs)) {
    state = stepping::RunState::from(checkpoint->arrays, checkpoint->integers);
    note(fmt::format("going on from the checkpoint at t = {:.6g} s", state.time * 1e-3));
  } else {
    state = stepping::initial_state(problem, first.position);
  }
  first.particles = problem.particles;
  first.substrate = problem.interactions.height_field;
  io::TrajectoryWriter writer(line.common.output, std::move(first), packing->species_names(), observables(problem.interactions), provenance,
                              static_cast<std::size_t>(state.frame));
  packing.reset();  // its particles are the problem's
  app::handle_signals();

  Progress progress("consolidate");
  progress.start_at(state.time / settings.until);
  auto last_save = std::chrono::steady_clock::now();
  std::int64_t saved_frame = state.frame;
  const auto save = [&](const stepping::RunState& s) {
    io::write_checkpoint(line.common.output, {s.arrays(), s.integers(), inputs});
    last_save = std::chrono::steady_clock::now();
    saved_frame = s.frame;
  };
  stepping::RunCallbacks callbacks;
  callbacks.on_frame = [&](const stepping::RunState& s, double height, const std::vector<double>& values) {
    io::Frame frame{s.step, s.time, problem.cell, s.position, s.velocity, s.angular_velocity};
    frame.cell.height = height;
    writer.append(frame, values);
  };
  callbacks.on_step = [&](const stepping::RunState& s) {
    const bool stop = app::stop_requested() != 0;
    const double since = std::chrono::duration<double>(std::chrono::steady_clock::now() - last_save).count();
    if (stop || s.frame != saved_frame || since >= options.checkpoint_every) save(s);
    return stop;
  };
  callbacks.on_progress = [&](double fraction, const std::string& detail) { progress.update(fraction, detail); };

  std::string outcome;
  try {
    outcome = stepping::consolidate(problem, settings, state, callbacks);
  } catch (const NumericsError& error) {
    if (is_sound(state, writer)) save(state);
    writer.finish_failed(error.what());
    throw;
  }
  if (outcome == "interrupted") {
    note(fmt::format("stopped by a signal at t = {:.6g} s; the same command goes on from {}", state.time * 1e-3,
                     io::checkpoint_path(line.common.output).string()));
    throw app::Interrupted{app::stop_requested()};
  }
  progress.finish(fmt::format("{} at t = {:.4g} s, {} steps", outcome, state.time * 1e-3, state.step));
  writer.finish(outcome);
  io::remove_checkpoint(line.common.output);
}

}  // namespace

int main(int argc, char** argv) { return app::run_tool("consolidate", argc, argv, declare, run); }
