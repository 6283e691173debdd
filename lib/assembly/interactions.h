#pragma once
// What acts in a scene: its hydrodynamics and forces, built once. A term that is not there costs nothing.
#include <memory>
#include <optional>
#include <vector>

#include "forces/parameters.h"
#include "model/height_field.h"
#include "model/liquid.h"
#include "neighbours/pair_search.h"
#include "resistance/parameters.h"

namespace pigment::assembly {

struct Interactions {
  resistance::HydrodynamicsParameters hydrodynamics;
  std::vector<forces::ColloidalLaw> colloidal;
  std::optional<forces::SubstrateParameters> substrate;
  std::shared_ptr<const HeightField> height_field;  // of a substrate that is not flat, fitted to the cell; null: the plane z = 0
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
  // Volume over area between the substrate and the plane z, um.
  double space_below(double z) const { return height_field ? height_field->space_below(z) : z; }
  // Rotation is worth solving for only where something couples to it.
  bool rotation() const { return hydrodynamics.rotation && lubrication(); }
};

// The longest reach of any pair term at this liquid, without skin.
neighbours::PairRange pair_range(const Interactions&, const Liquid&);

}  // namespace pigment::assembly
