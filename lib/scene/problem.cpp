#include "scene/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/log.h"

namespace pigment::scene {
namespace {

// Index into the scene's species for every species index of the packing.
std::vector<int> species_map(const Scene& scene, const io::ParticleFile& packing) {
  int largest = 0;
  for (int s : packing.particles().species) largest = std::max(largest, s);
  std::vector<int> map;
  const auto& names = packing.species_names();
  for (int s = 0; s <= largest; ++s) {
    if (static_cast<std::size_t>(s) < names.size()) {
      const auto found = std::find_if(scene.species.begin(), scene.species.end(), [&](const Species& k) { return k.name == names[s]; });
      if (found == scene.species.end())
        throw FileError(fmt::format("{}: /particles/layer/species: \"{}\" is not among the scene's particles", packing.path().string(), names[s]));
      map.push_back(static_cast<int>(found - scene.species.begin()));
    } else if (static_cast<std::size_t>(s) < scene.species.size()) {
      map.push_back(s);
    } else {
      throw FileError(fmt::format("{}: /particles/layer/species: found species {}, the scene has {}", packing.path().string(), s, scene.species.size()));
    }
  }
  return map;
}

}  // namespace

assembly::Interactions interactions_of(const Scene& scene) {
  assembly::Interactions in;
  in.hydrodynamics = scene.hydrodynamics;
  in.colloidal = scene.colloidal;
  in.substrate = scene.substrate;
  in.free_surface = scene.free_surface;
  in.gravity = scene.gravity;
  in.brownian = scene.brownian;
  in.liquid = scene.liquid;
  for (const Species& s : scene.species) in.surface_potential.push_back(s.surface_potential);
  return in;
}

namespace {

// The scene's substrate against where the particles stand, and against the surface that they were packed over.
void check_substrate(const io::ParticleFile& packing, const HeightField* field) {
  const Layer layer = packing.layer();
  const auto same_surface = [&] {
    if (!field || !layer.substrate) return !field && !layer.substrate;
    const HeightMap &a = field->map(), &b = layer.substrate->map();
    if (a.count_x != b.count_x || a.count_y != b.count_y) return false;
    const double rounding = 1e-12 * field->crest();  // of the way through the file's units
    for (std::size_t k = 0; k < a.height.size(); ++k)
      if (std::abs(a.height[k] - b.height[k]) > rounding) return false;
    return true;
  };
  if (!same_surface())
    note(fmt::format("{}: packed over a {} substrate; the scene's{} is taken", packing.path().string(), layer.substrate ? "rough" : "flat",
                     layer.substrate && field ? ", another one," : ""));
  if (!field) return;
  double deepest = 0;
  std::size_t overlaps = 0, worst = 0;
  for (std::size_t k = 0; k < layer.position.size(); ++k) {
    const Vec3& p = layer.position[k];
    const double height = field->height(p.x(), p.y());
    if (!(p.z() > height))
      throw FileError(fmt::format("{}: /particles/layer/position: particle {} (id {}) is centred at z = {:.6g} um, expected above the scene's "
                                  "substrate, which stands at {:.6g} um there", packing.path().string(), k, layer.particles.id[k], p.z(), height));
    const double depth = -field->gap(p, layer.particles.radius[k], 0);
    if (depth > deepest) deepest = depth, worst = k;
    overlaps += depth > 0;
  }
  if (overlaps > 0)
    warning(fmt::format("{}: {} {} into the substrate, the deepest {:.3g} nm, id {}", packing.path().string(), overlaps,
                        overlaps == 1 ? "particle reaches" : "particles reach", 1e3 * deepest, layer.particles.id[worst]));
}

}  // namespace

stepping::Problem problem_of(const Scene& scene, const io::ParticleFile& packing) {
  stepping::Problem problem;
  problem.particles = packing.particles();
  problem.cell = packing.frame(0).cell;
  const std::vector<int> map = species_map(scene, packing);
  Particles& particles = problem.particles;
  for (int& s : particles.species) s = map[s];
  if (!packing.has_mass()) {
    for (std::size_t k = 0; k < particles.size(); ++k)
      particles.mass[k] = scene.species[particles.species[k]].density * Particles::sphere_volume(particles.radius[k]);
    note(fmt::format("{}: no mass given; {:.6g} kg/m3 of species \"{}\" taken", packing.path().string(),
                     to_si(Dimension::Density, scene.species.front().density), scene.species.front().name));
  }
  const double largest = *std::max_element(particles.radius.begin(), particles.radius.end());
  if (std::min(problem.cell.width_x, problem.cell.width_y) < 4 * largest)
    throw FileError(fmt::format("{}: /particles/layer/box/edges: {:.6g} x {:.6g} um is under two largest diameters ({:.6g} um each): a particle "
                                "would meet its own periodic image", packing.path().string(), problem.cell.width_x, problem.cell.width_y, 2 * largest));
  problem.interactions = interactions_of(scene);
  if (scene.substrate && scene.substrate->roughness)
    problem.interactions.height_field = std::make_shared<const HeightField>(height_map(*scene.substrate->roughness), problem.cell);
  check_substrate(packing, problem.interactions.height_field.get());
  problem.stepping = scene.stepping;
  problem.seed = scene.seed;
  return problem;
}

stepping::RunSettings run_settings_of(const Scene& scene, const stepping::Problem& problem) {
  stepping::RunSettings settings;
  settings.output_every = scene.output.every;
  const DewateringCurve& curve = problem.dewatering;
  if (scene.stepping.until) settings.until = *scene.stepping.until;
  else if (!curve.time.empty()) settings.until = curve.time.back();
  else throw InputError("stepping.until: missing; without a dewatering curve nothing else ends the run; write e.g. \"until: 0.5 s\"");
  const bool evaporates = std::any_of(curve.evaporation_flux.begin(), curve.evaporation_flux.end(), [](double e) { return e > 0; });
  if (evaporates && !scene.free_surface)
    throw InputError("free_surface: missing; the dewatering curve evaporates, and evaporation needs a surface: add \"free_surface: {model: spring}\"");
  return settings;
}

}  // namespace pigment::scene
