#pragma once
// What peers were measured on: spheres whose number density falls as a^-4 over sizes 1:8 (volume evenly spread over ln a), at 41
// or 60 vol%, packed once a size and solids.
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "packing/pack_layer.h"
#include "scene/scene.h"

namespace pigment::bench {

inline const Layer& wide_mixture(int particles, int percent) {
  static std::map<std::pair<int, int>, Layer> layers;
  const auto found = layers.find({particles, percent});
  if (found != layers.end()) return found->second;
  {
    std::ofstream csv("wide_mixture.csv");
    csv << "diameter [um],finer [wt%]\n";
    for (int k = 0; k <= 24; ++k) csv << 0.25 * std::pow(8, k / 24.0) << ',' << 100 * k / 24.0 << '\n';
  }
  {
    // 8.02 particles a cubic micrometre at 41 vol%.
    const double edge = std::cbrt(particles / (8.02 * percent / 41.0));
    std::ofstream scene("wide_mixture.yaml");
    scene << "layer: {thickness: " << edge << " um, solids: " << percent << " vol%, width: " << edge << " um}\n"
          << "particles: [{species: pigment, density: 2700 kg/m3, size: {law: table, file: wide_mixture.csv}}]\n"
          << "packing: {minimum_gap: 1 nm}\n";
  }
  config::Document document("wide_mixture.yaml", {});
  const scene::Scene scene = scene::read_scene(document);
  return layers.emplace(std::pair{particles, percent},
                        packing::pack_layer({*scene.layer, scene.packing, scene.species, scene.liquid.density, scene.seed}).layer)
      .first->second;
}

}  // namespace pigment::bench
