#pragma once
// What the tools that measure packings and trajectories have in common: the file, the scene's `analysis` block, the frames.
#include <memory>
#include <string>
#include <vector>

#include "analysis/frames.h"
#include "analysis/parameters.h"
#include "app/tool.h"
#include "io/particle_file.h"

namespace pigment::app {

struct AnalysisOptions {
  path input, scene;
};
// The particle file, --scene, --output and --threads.
void declare_analysis(CommandLine&, AnalysisOptions&);

struct AnalysisInput {
  std::shared_ptr<const io::ParticleFile> file;
  analysis::Parameters parameters;
  analysis::Frames frames;  // reading shows progress
  io::Provenance provenance;
  const io::Particles& particles() const { return file->particles(); }
};
// Throws InputError for the scene, FileError for the particle file.
AnalysisInput open_analysis_input(const CommandLine&, const AnalysisOptions&, const std::string& tool);

}  // namespace pigment::app
