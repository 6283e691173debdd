#include "dewatering/parameters.h"

#include <fmt/format.h>

namespace pigment::dewatering {
namespace {

AbsorptionParameters read_absorption(config::Node node) {
  AbsorptionParameters p;
  p.permeability = node.quantity("permeability", Dimension::Area, "1e-18 m2", config::positive());
  p.cake_solids = node.quantity("cake_solids", Dimension::VolumeFraction, "68 vol%", config::strictly_between(0, 1));
  p.capillary_pressure = node.quantity("capillary_pressure", Dimension::Pressure, "50 kPa", config::non_negative());
  p.external_pressure = node.quantity("external_pressure", Dimension::Pressure, "0 kPa", config::non_negative());
  return p;
}

EvaporationParameters read_evaporation(config::Node node) {
  EvaporationParameters p;
  p.high = node.quantity("high", Dimension::MassFlux, "40 g/m2/s", config::non_negative());
  p.low = node.quantity("low", Dimension::MassFlux, "8 g/m2/s", config::non_negative());
  if (p.low > p.high) node.error("low", "must not exceed high");
  return p;
}

void read_strategy(config::Node& node, DewateringParameters& p) {
  if (node.has("file")) {
    p.strategy = Strategy::Table;
    p.file = node.file("file");
    if (node.has("strategy")) node.error("strategy", "stands beside file; give one of them");
    for (const char* block : {"absorption", "evaporation"})
      if (node.has(block)) node.error(block, "the fluxes come from file; leave this block out");
  } else if (node.has("strategy")) {
    p.strategy = node.choice<Strategy>("strategy", {{"HLL", Strategy::HighLowLow},
                                                    {"LLH", Strategy::LowLowHigh},
                                                    {"ABS", Strategy::Absorption},
                                                    {"EVA", Strategy::Evaporation}});
  } else {
    node.error("strategy", "is missing; give strategy (HLL, LLH, ABS or EVA) or file (a CSV table)");
  }
}

}  // namespace

bool DewateringParameters::absorbs() const {
  return strategy == Strategy::HighLowLow || strategy == Strategy::LowLowHigh || strategy == Strategy::Absorption;
}

bool DewateringParameters::evaporates() const {
  return strategy == Strategy::HighLowLow || strategy == Strategy::LowLowHigh || strategy == Strategy::Evaporation;
}

DewateringParameters read_dewatering(config::Node node) {
  DewateringParameters p;
  read_strategy(node, p);
  if (p.strategy == Strategy::Table)
    p.duration = node.optional_quantity("duration", Dimension::Time, config::positive());
  else
    p.duration = node.quantity("duration", Dimension::Time, config::positive());
  if (node.has("final_solids")) p.final_solids = read_solids(node, "final_solids");
  p.reference_thickness = node.optional_quantity("reference_thickness", Dimension::Length, config::positive());
  if (p.reference_thickness && !p.final_solids)
    node.error("reference_thickness", "has no effect without final_solids; leave it out or give final_solids");
  if (p.absorbs() || (node.has("absorption") && p.strategy != Strategy::Table))
    p.absorption = read_absorption(node.block("absorption"));
  if (p.evaporates() || (node.has("evaporation") && p.strategy != Strategy::Table))
    p.evaporation = read_evaporation(node.block("evaporation"));
  return p;
}

void check_dewatering(config::Node node, const DewateringParameters& p, const Coating& coating) {
  if (p.absorbs() && p.absorption && p.absorption->cake_solids <= coating.volume_fraction)
    node.block("absorption").error("cake_solids",
                                   fmt::format("must exceed the solids of the layer ({:.4g} vol%): no filter cake could form",
                                               100 * coating.volume_fraction));
  if (p.final_solids && p.final_solids->fraction > 0) {
    const double final = p.final_solids->volume_fraction(coating.dry_density, coating.liquid.density);
    if (final <= coating.volume_fraction)
      node.error("final_solids",
                 fmt::format("must exceed the solids of the layer at the start ({:.4g} wt%, {:.4g} vol%)",
                             100 * mass_fraction_of(coating.volume_fraction, coating.dry_density, coating.liquid.density),
                             100 * coating.volume_fraction));
  }
}

}  // namespace pigment::dewatering
