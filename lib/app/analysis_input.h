#pragma once
// What the tools that measure packings and trajectories have in common: the file, the scene's `analysis`
// block, the frames.
#include <memory>
#include <string>

#include "analysis/frames.h"
#include "analysis/parameters.h"
#include "analysis/solids_profile.h"
#include "app/tool.h"
#include "io/particle_file.h"

namespace pigment::app {

struct AnalysisOptions {
  path input, scene;
};
// The particle file, --scene, --output, --threads.
void declare_analysis(CommandLine&, AnalysisOptions&);

struct AnalysisInput {
  std::shared_ptr<const io::ParticleFile> file;
  analysis::Parameters parameters;
  double liquid_density = 1e-3;         // engine units
  std::vector<double> species_density;  // engine units, the scene's; empty where it names none
  analysis::Frames frames;              // reading them shows progress
  io::Provenance provenance;

  const Particles& particles() const { return file->particles(); }
};
// `tool` is without the prefix. The liquid is the scene's; without --scene, that of the run that made the
// file; else of 1000 kg/m3. Throws InputError for the scene, FileError for the particle file.
AnalysisInput open_analysis_input(const CommandLine&, const AnalysisOptions&, const std::string& tool);

// Masses by particle: the file's; where it has none, by the density of the scene's species, or else of 2700
// kg/m3, which a note says.
analysis::Solids weigh_solids(const AnalysisInput&);

// Throws InputError where `distance`, written under analysis.KEY, reaches beyond half a period of any frame's
// cell: then a pair is near by more images than the nearest, and counts would be too low.
void require_within_half_period(const AnalysisInput&, const std::string& key, double distance);

}  // namespace pigment::app
