#pragma once
// The forces of a scene: its blocks colloidal, substrate, free_surface, gravity and brownian.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/node.h"
#include "forces/pair_law.h"
#include "model/height_map.h"

namespace pigment::forces {

struct ColloidalLaw {
  std::string name;
  std::shared_ptr<const PairLaw> law;
};
// One law a block, in the order of the registry; a law that the scene leaves out is not there.
std::vector<ColloidalLaw> read_colloidal(config::Node colloidal);

struct SubstrateParameters {
  bool colloidal = true;                    // the substrate carries the particles' colloidal forces
  enum class Suction { Impermeable, Uniform };
  Suction suction = Suction::Impermeable;   // what its resistance acts on: U, or U + q e_z
  std::optional<double> surface_potential;  // mV; absent: that of the particle in front of it
  std::optional<Roughness> roughness;       // absent: the plane z = 0
};
SubstrateParameters read_substrate(config::Node);

struct FreeSurfaceParameters {
  enum class Model { Spring, Constraint, PressureLimited };
  enum class Elongation { Arc, ArcMinusChord };
  enum class Approach { Interface, Squeeze };
  Model model = Model::Spring;
  double surface_tension = 72000;  // pN/um
  double roughness = 0.002;        // um
  Elongation elongation = Elongation::Arc;
  Approach approach = Approach::Interface;  // resistance acts on U_z + q + e (source), or on U_z + q (exact squeeze)
  std::optional<double> max_pressure;  // pN/um^2, pressure_limited only; absent: entry_pressure below
};
FreeSurfaceParameters read_free_surface(config::Node);

struct GravityParameters {
  double acceleration = 9.81;  // um/ms^2, along -z
};
GravityParameters read_gravity(config::Node);

struct BrownianParameters {
  enum class Model { KBrown, FluctuationDissipation };
  Model model = Model::KBrown;
  bool drift = true;  // fluctuation_dissipation: with kT div(R^-1); without it the distribution is wrong, for comparison
  // calibration: by pigment-kbrown
  std::vector<double> temperatures;      // K; empty: the scene's
  int simulations = 25, displacements = 45000;
  std::optional<double> time_step;       // ms; absent: 0.1 ms
  double diameter = 2;                   // um, of the calibration particle
};
BrownianParameters read_brownian(config::Node);

}  // namespace pigment::forces
