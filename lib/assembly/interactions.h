#pragma once
// What acts in a scene: its hydrodynamics and forces, built once. A term that is not there costs nothing.
#include <optional>
#include <vector>

#include "forces/parameters.h"
#include "model/liquid.h"
#include "neighbours/pair_search.h"
#include "resistance/parameters.h"

namespace pigment::assembly {

struct Interactions {
  resistance::HydrodynamicsParameters hydrodynamics;
  std::vector<forces::ColloidalLaw> colloidal;
  std::optional<forces::SubstrateParameters> substrate;
  std::optional<forces::FreeSurfaceParameters> free_surface;
  std::optional<forces::GravityParameters> gravity;
  std::optional<forces::BrownianParameters> brownian;
  LiquidParameters liquid;
  std::vector<double> surface_potential;  // mV, by species

  bool lubrication() const { return hydrodynamics.model != resistance::HydrodynamicsParameters::Model::Drag; }
  bool hindered() const { return hydrodynamics.drag == resistance::HydrodynamicsParameters::Drag::Hindered; }
  bool pressure_limited() const {
    return free_surface && free_surface->model == forces::FreeSurfaceParameters::Model::PressureLimited;
  }
  // Rotation is worth solving for only where something couples to it.
  bool rotation() const { return hydrodynamics.rotation && lubrication(); }
};

// The longest reach of any pair term at this liquid, without skin.
neighbours::PairRange pair_range(const Interactions&, const Liquid&);

}  // namespace pigment::assembly
