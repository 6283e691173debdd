#pragma once
// The layer of the drying study, about 1,200 or 10,000 particles of it, packed once a size.
#include <map>
#include <string>

#include "packing/pack_layer.h"
#include "scene/scene.h"

namespace pigment::bench {

inline config::Document drying_scene(int thousands) {
  const char* size = thousands == 1 ? "{thickness: 5 um, solids: 65 wt%, width: 5 um}"
                                    : "{thickness: 20 um, solids: 65 wt%, width: 7.3 um}";
  return config::Document(std::string(PIGMENT_SOURCE_DIR) + "/workflows/drying/scene.yaml", {std::string("layer=") + size});
}

inline packing::Recipe drying_recipe(int thousands) {
  config::Document document = drying_scene(thousands);
  const scene::Scene scene = scene::read_scene(document);
  return {*scene.layer, scene.packing, scene.species, scene.liquid.density, scene.seed};
}

inline const Layer& drying_layer(int thousands) {
  static std::map<int, Layer> layers;
  const auto found = layers.find(thousands);
  if (found != layers.end()) return found->second;
  return layers.emplace(thousands, packing::pack_layer(drying_recipe(thousands)).layer).first->second;
}

}  // namespace pigment::bench
