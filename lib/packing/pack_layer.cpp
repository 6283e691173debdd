#include "packing/pack_layer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/layer_measures.h"
#include "packing/equilibrate.h"
#include "packing/random_insertion.h"
#include "packing/relax_overlaps.h"
#include "packing/sample_sizes.h"
#include "packing/slab.h"

namespace pigment::packing {
namespace {

// Densest packing of equal spheres, pi/sqrt(18). Spheres of several sizes can be stacked denser, by hand; at
// random they jam before they get there.
constexpr double densest = 0.7405;
// Gaps are packed wider by this, um, so that rounding and the way through SI units in a file never take the
// minimum gap away. A millionth of a nanometre.
constexpr double guard = 1e-9;

std::string solids_text(const LayerParameters& layer, double volume_fraction) {
  if (!layer.solids_by_weight) return fmt::format("{:.4g} vol%", 100 * volume_fraction);
  return fmt::format("{:.4g} wt% ({:.1f} vol%)", 100 * layer.solids, 100 * volume_fraction);
}

std::vector<SizeDistribution> distributions_of(const std::vector<Species>& species) {
  std::vector<SizeDistribution> sizes;
  for (const Species& s : species) {
    try {
      sizes.emplace_back(s.size);
    } catch (const InputError& e) {
      throw InputError(fmt::format("particles, species {}: {}", s.name, e.what()));
    }
  }
  return sizes;
}

// What no arrangement of particles could give, before anything is computed.
void refuse_impossible(const Recipe& recipe, const LayerTarget& target,
                       const std::vector<SizeDistribution>& sizes) {
  if (recipe.species.empty()) throw InputError("particles: no species is given, so there is nothing to pack");
  const double gap = recipe.packing.minimum_gap;
  if (const auto why = too_dense(recipe.layer, target.volume_fraction))
    throw Impossible("layer", "solids", *why);
  double largest = 0;
  for (const SizeDistribution& s : sizes) largest = std::max(largest, s.largest());
  if (recipe.layer.width < 2 * largest)
    throw Impossible("layer", "width",
                     fmt::format("{:.6g} um is less than two largest diameters ({:.6g} um), so that "
                                 "particles would meet their own "
                                 "images; widen the layer or lower the size law's max",
                                 recipe.layer.width, 2 * largest));
  if (target.thickness < largest + 2 * gap)
    throw Impossible("layer", recipe.layer.thickness ? "thickness" : "coat_weight",
                     fmt::format("a wet layer of {:.6g} um is thinner than the largest particle ({:.6g} um) "
                                 "with the minimum gap ({:.4g} um) on "
                                 "either side",
                                 target.thickness, largest, gap));
}

// The box that holds these particles at exactly the solids asked for.
Cell box_for(const Recipe& recipe, const LayerTarget& target, const Particles& particles, double mean_height) {
  const double solids = solids_volume(particles.radius);
  double mass = 0;
  for (const double m : particles.mass) mass += m;
  const double volume =
      recipe.layer.solids_by_weight
          ? solids + mass * (1 - recipe.layer.solids) / (recipe.layer.solids * recipe.liquid_density)
          : solids / recipe.layer.solids;
  // A mixture's sample may differ a little from the recipe's proportions: the coat weight, where it is given,
  // is met too.
  const double height = recipe.layer.thickness ? target.thickness : volume * *recipe.layer.coat_weight / mass;
  const double width = std::sqrt(volume / height);
  // The thickness is that of the liquid and the solids over the substrate's mean height.
  return {width, width, height + mean_height};
}

void refuse_what_the_sample_shows(const Recipe& recipe, const Layer& layer, const std::vector<double>& radius) {
  const Cell& cell = layer.cell;
  const double gap = recipe.packing.minimum_gap, largest = 2 * radius.front();
  if (cell.width_x < 2 * (largest + gap))
    throw Impossible("layer", "width",
                     fmt::format("the {} particles of this layer need a width of {:.6g} um to meet the "
                                 "solids, which is less than two "
                                 "largest diameters ({:.6g} um) with their gaps; widen the layer",
                                 radius.size(), cell.width_x, 2 * largest));
  if (cell.height < largest + 2 * gap)
    throw Impossible("layer", recipe.layer.thickness ? "thickness" : "coat_weight",
                     fmt::format("the layer of {:.6g} um is thinner than its largest particle ({:.6g} um) "
                                 "with the minimum gap on either side",
                                 cell.height, largest));
  const double room = layer.substrate ? layer.substrate->space_below(cell.height) : cell.height;
  if (layer.substrate && cell.height - layer.substrate->crest() < largest + 2 * gap)
    throw Impossible("layer", recipe.layer.thickness ? "thickness" : "coat_weight",
                     fmt::format("a layer of {:.6g} um over the substrate's mean height ends {:.6g} um above its crests, where the largest particle "
                                 "({:.6g} um) has no room with the minimum gap on either side; take a thicker layer or a lower substrate.roughness",
                                 room, cell.height - layer.substrate->crest(), largest));
  double filled = 0;
  for (const double a : radius) filled += Particles::sphere_volume(a + gap / 2);
  filled /= cell.area() * (room - gap);
  if (filled > densest)
    throw Impossible(
        "packing", "minimum_gap",
        fmt::format(
            "with half of the minimum gap of {:.4g} um around each, the particles fill {:.1f} % of the "
            "layer, more than any random packing does; lower the gap or the solids",
            gap, 100 * filled));
}

}  // namespace

std::optional<std::string> too_dense(const LayerParameters& layer, double volume_fraction) {
  if (!(volume_fraction > densest)) return std::nullopt;
  return fmt::format(
      "{} cannot be packed: equal spheres fill 74 % of space at the densest, and random packings of mixed "
      "sizes jam at "
      "about 64 to 73 %; coating colours go to about 78 wt%",
      solids_text(layer, volume_fraction));
}

Packing pack_layer(const Recipe& recipe, const OnProgress& on_progress) {
  Packing packing;
  packing.sizes = distributions_of(recipe.species);
  packing.target = layer_target(recipe.layer, recipe.species, recipe.liquid_density);
  refuse_impossible(recipe, packing.target, packing.sizes);

  const double asked_area = recipe.layer.width * recipe.layer.width;
  Layer& layer = packing.layer;
  layer.particles =
      sample_particles(recipe.species, packing.sizes,
                       packing.target.volume_fraction * packing.target.thickness * asked_area, recipe.seed);
  double mean_height = 0;
  if (recipe.substrate) mean_height = HeightField(*recipe.substrate, Cell{1, 1, 1}).mean_height();
  layer.cell = box_for(recipe, packing.target, layer.particles, mean_height);
  if (recipe.substrate) layer.substrate = std::make_shared<const HeightField>(*recipe.substrate, layer.cell);
  packing.width_scale = layer.cell.width_x / recipe.layer.width;
  refuse_what_the_sample_shows(recipe, layer, layer.particles.radius);

  const double gap = recipe.packing.minimum_gap + guard;
  const Slab slab{layer.cell.width_x, gap / 2, layer.cell.height - gap / 2, layer.substrate.get(), gap / 2};
  std::vector<double> kept_apart = layer.particles.radius;
  for (double& r : kept_apart) r += gap / 2;

  const auto report = [&](const char* stage) {
    return [&on_progress, stage](double fraction) {
      if (on_progress) on_progress(stage, fraction);
    };
  };
  Insertion insertion = insert_largest_first(slab, kept_apart, recipe.seed, report("inserting"));
  layer.position = std::move(insertion.centre);
  packing.inserted_overlapping = insertion.overlapping;
  if (insertion.overlapping > 0) {
    // Progress in decades: from overlaps as deep as the largest radius to a millionth of it; an overlap may
    // deepen in passing.
    const double deepest = kept_apart.front();
    double farthest = 0;
    const Relaxation relaxation = relax_overlaps(slab, kept_apart, layer.position, [&](double overlap) {
      farthest = std::clamp(std::log10(deepest / overlap) / 6, farthest, 1.0);
      if (on_progress) on_progress("removing overlaps", farthest);
    });
    packing.relaxation_steps = relaxation.steps;
    if (!relaxation.done)
      throw Impossible(
          "layer", "solids",
          fmt::format("no packing without overlaps was found at {} with a minimum gap of {:.4g} um: after {} "
                      "steps the "
                      "deepest overlap is still {:.3g} nm; lower the solids or packing.minimum_gap, or take "
                      "a wider size law",
                      solids_text(recipe.layer, packing.target.volume_fraction), recipe.packing.minimum_gap,
                      relaxation.steps, 1e3 * relaxation.largest_overlap));
  }
  packing.acceptance = equilibrate(slab, kept_apart, layer.position, recipe.packing.equilibration_sweeps,
                                   recipe.seed, report("equilibrating"))
                           .acceptance;
  return packing;
}

}  // namespace pigment::packing
