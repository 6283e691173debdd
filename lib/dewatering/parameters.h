#pragma once
// The scene's `dewatering` block: how the liquid leaves the layer, by absorption into the substrate and by evaporation.
#include <filesystem>
#include <optional>

#include "config/node.h"
#include "model/layer_parameters.h"
#include "model/liquid.h"

namespace pigment::dewatering {

// Drying strategies of [sand2010] section 4.2, and a table of the user's own.
enum class Strategy {
  HighLowLow,   // HLL: absorption; evaporation high for the first third of the duration, then low
  LowLowHigh,   // LLH: absorption; evaporation low for two thirds of the duration, then high
  Absorption,   // ABS: absorption alone
  Evaporation,  // EVA: evaporation alone, at the high rate all the time
  Table,        // file: both fluxes, and perhaps the temperature, from a CSV file
};

// Darcy flow through a growing filter cake, (1).
struct AbsorptionParameters {
  double permeability = 0;        // um^2, of the cake
  double cake_solids = 0;         // volume fraction
  double capillary_pressure = 0;  // pN/um^2
  double external_pressure = 0;   // pN/um^2
};

struct EvaporationParameters {
  double high = 0, low = 0;  // engine mass fluxes, pN ms/um^3
};

struct DewateringParameters {
  Strategy strategy = Strategy::HighLowLow;
  std::filesystem::path file;                 // of a table
  std::optional<double> duration;             // ms; a table may do without: its last time
  std::optional<SolidsContent> final_solids;  // absent: fluxes as written
  std::optional<double> reference_thickness;  // um; absent: the layer's own
  std::optional<AbsorptionParameters> absorption;
  std::optional<EvaporationParameters> evaporation;

  bool absorbs() const;     // by Darcy's law
  bool evaporates() const;  // at the rates of the block
};
// Keys: strategy or file, duration, final_solids, reference_thickness, absorption, evaporation. ABS and EVA accept the
// block that they do not use, so that one scene serves all strategies; a table refuses both.
DewateringParameters read_dewatering(config::Node);

// What dewatering must know of the coating that it acts on.
struct Coating {
  double volume_fraction;  // of solids, at the start
  double thickness;        // um, at the start
  double dry_density;      // engine units, of the solids
  Liquid liquid;
};

// Reports on the node what cannot be for this coating: a cake no denser than the coating, final solids no higher than
// those at the start.
void check_dewatering(config::Node, const DewateringParameters&, const Coating&);

}  // namespace pigment::dewatering
