#include "forces/parameters.h"

namespace pigment::forces {

std::vector<ColloidalLaw> read_colloidal(config::Node colloidal) {
  std::vector<ColloidalLaw> laws;
  for (const PairLawEntry& entry : pair_laws())
    if (auto node = colloidal.optional_block(entry.name)) laws.push_back({entry.name, entry.read(*node, colloidal)});
  return laws;
}

SubstrateParameters read_substrate(config::Node node) {
  using Suction = SubstrateParameters::Suction;
  SubstrateParameters p;
  p.colloidal = node.boolean("colloidal", true);
  p.suction = node.choice<Suction>("suction", {{"impermeable", Suction::Impermeable}, {"uniform", Suction::Uniform}}, "impermeable");
  p.surface_potential = node.optional_quantity("surface_potential", Dimension::Potential);
  if (auto block = node.optional_block("roughness")) p.roughness = read_roughness(*block);
  return p;
}

FreeSurfaceParameters read_free_surface(config::Node node) {
  using P = FreeSurfaceParameters;
  P p;
  p.model = node.choice<P::Model>("model", {{"spring", P::Model::Spring}, {"constraint", P::Model::Constraint},
                                            {"pressure_limited", P::Model::PressureLimited}}, "spring");
  p.surface_tension = node.quantity("surface_tension", Dimension::SurfaceTension, "72 mN/m", config::positive());
  p.roughness = node.quantity("roughness", Dimension::Length, "2 nm", config::positive());
  p.elongation = node.choice<P::Elongation>("elongation", {{"arc", P::Elongation::Arc}, {"arc_minus_chord", P::Elongation::ArcMinusChord}}, "arc");
  p.approach = node.choice<P::Approach>("approach", {{"interface", P::Approach::Interface}, {"squeeze", P::Approach::Squeeze}}, "interface");
  if (p.model != P::Model::PressureLimited) {
    if (node.has("max")) node.error("max", "is a limit of model: pressure_limited; the model here is another");
  } else if (node.is_word("max", "auto") || !node.has("max")) {
    node.accept_word("max", "auto");
  } else {
    p.max_pressure = node.quantity("max", Dimension::Pressure, config::positive());
  }
  return p;
}

GravityParameters read_gravity(config::Node node) {
  return {node.quantity("acceleration", Dimension::Acceleration, "9.81 m/s2", config::non_negative())};
}

BrownianParameters read_brownian(config::Node node) {
  using P = BrownianParameters;
  P p;
  p.model = node.choice<P::Model>("model", {{"k_brown", P::Model::KBrown}, {"fluctuation_dissipation", P::Model::FluctuationDissipation}}, "k_brown");
  p.drift = node.boolean("drift", true);
  if (!p.drift && p.model == P::Model::KBrown) node.error("drift", "belongs to model: fluctuation_dissipation; k_brown has none");
  config::Node calibration = node.block("calibration");
  if (calibration.has("temperatures"))
    p.temperatures = calibration.quantities("temperatures", Dimension::Temperature, {}, config::between(253.15, 383.15));
  p.simulations = static_cast<int>(calibration.integer("simulations", 25, config::between(2, 100000)));
  p.displacements = static_cast<int>(calibration.integer("displacements", 45000, config::between(10, 100000000)));
  p.diameter = calibration.quantity("diameter", Dimension::Length, "2 um", config::positive());
  if (calibration.is_word("time_step", "auto") || !calibration.has("time_step")) calibration.accept_word("time_step", "auto");
  else p.time_step = calibration.quantity("time_step", Dimension::Time, config::positive());
  return p;
}

}  // namespace pigment::forces
