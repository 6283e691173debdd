#pragma once
// The wet layer as a scene's `layer` block describes it, and what follows for its volume and thickness.
#include <optional>
#include <vector>

#include "config/node.h"
#include "model/species.h"

namespace pigment {

// A solids content by weight or by volume, as the unit says that the scene writes: "65 wt%", "40 vol%".
struct SolidsContent {
  double fraction = 0;  // 0: was not read
  bool by_weight = true;
  double volume_fraction(double dry_density, double liquid_density) const;
};
SolidsContent read_solids(config::Node&, const std::string& key);  // required, between 0 and 100 %

struct LayerParameters {
  // One of the two is there.
  std::optional<double> thickness;    // um, of the wet layer
  std::optional<double> coat_weight;  // pN ms^2/um^3, dry
  double solids = 0;                  // fraction by weight or by volume
  bool solids_by_weight = true;       // as the scene writes it: wt% or vol%
  double width = 0;                   // um, of the periodic square, before it is scaled to hit the solids
};
// Keys: thickness or coat_weight, solids, width.
LayerParameters read_layer(config::Node);

// Solids by volume from solids by weight, both fractions, and back.
double volume_fraction_of(double mass_fraction, double dry_density, double liquid_density);
double mass_fraction_of(double volume_fraction, double dry_density, double liquid_density);

// Density of the dry solids of a mixture by parts by weight: sum(parts) / sum(parts / density).
double dry_density(const std::vector<Species>&);

// What the layer is to hold: solids by volume, and the wet thickness (um), given or from the coat weight.
struct LayerTarget {
  double volume_fraction, mass_fraction, thickness;
};
LayerTarget layer_target(const LayerParameters&, const std::vector<Species>&, double liquid_density);

}  // namespace pigment
