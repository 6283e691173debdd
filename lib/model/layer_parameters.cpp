#include "model/layer_parameters.h"

namespace pigment {

SolidsContent read_solids(config::Node& node, const std::string& key) {
  const std::string text = node.text(key);
  if (text.empty()) return {};  // missing: already an error
  // The unit decides, so the text is read first and converted here.
  const ParsedQuantity by_weight = parse_quantity(text, Dimension::MassFraction);
  const ParsedQuantity solids = by_weight.ok ? by_weight : parse_quantity(text, Dimension::VolumeFraction);
  if (!solids.ok) {
    node.error(key, "\"" + text + "\" is not a solids content; write e.g. \"65 wt%\" or \"40 vol%\"");
    return {};
  }
  if (!(solids.si > 0 && solids.si < 1)) {
    node.error(key, "\"" + text + "\" is not between 0 and 100 %");
    return {};
  }
  return {solids.si, by_weight.ok};
}

double SolidsContent::volume_fraction(double dry_density, double liquid_density) const {
  return by_weight ? volume_fraction_of(fraction, dry_density, liquid_density) : fraction;
}

LayerParameters read_layer(config::Node node) {
  LayerParameters layer;
  layer.thickness = node.optional_quantity("thickness", Dimension::Length, config::positive());
  layer.coat_weight = node.optional_quantity("coat_weight", Dimension::AreaDensity, config::positive());
  if (layer.thickness && layer.coat_weight)
    node.error("coat_weight", "thickness and coat_weight both fix how much is coated; give one of them");
  if (!node.has("thickness") && !node.has("coat_weight"))
    node.error("thickness",
               "is missing; give thickness (e.g. \"25 um\") or coat_weight (dry, e.g. \"26 g/m2\")");
  const SolidsContent solids = read_solids(node, "solids");
  layer.solids = solids.fraction;
  layer.solids_by_weight = solids.by_weight;
  layer.width = node.quantity("width", Dimension::Length, config::positive());
  return layer;
}

double volume_fraction_of(double mass_fraction, double dry_density, double liquid_density) {
  const double solids = mass_fraction / dry_density, liquid = (1 - mass_fraction) / liquid_density;
  return solids / (solids + liquid);
}

double mass_fraction_of(double volume_fraction, double dry_density, double liquid_density) {
  const double solids = volume_fraction * dry_density, liquid = (1 - volume_fraction) * liquid_density;
  return solids / (solids + liquid);
}

double dry_density(const std::vector<Species>& species) {
  double parts = 0, volume = 0;
  for (const Species& s : species) {
    parts += s.parts;
    volume += s.parts / s.density;
  }
  return parts / volume;
}

LayerTarget layer_target(const LayerParameters& layer, const std::vector<Species>& species,
                         double liquid_density) {
  const double density = dry_density(species);
  LayerTarget target{};
  if (layer.solids_by_weight) {
    target.mass_fraction = layer.solids;
    target.volume_fraction = volume_fraction_of(layer.solids, density, liquid_density);
  } else {
    target.volume_fraction = layer.solids;
    target.mass_fraction = mass_fraction_of(layer.solids, density, liquid_density);
  }
  target.thickness =
      layer.thickness ? *layer.thickness : layer.coat_weight.value_or(0) / (target.volume_fraction * density);
  return target;
}

}  // namespace pigment
