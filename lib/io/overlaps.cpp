#include "io/overlaps.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "neighbours/pair_search.h"

namespace pigment::io {

void warn_of_overlaps(const std::filesystem::path& file, const Layer& layer) {
  const auto& radius = layer.particles.radius;
  std::size_t overlaps = 0, worst_a = 0, worst_b = 0;
  double deepest = 0;
  const auto found = [&](std::size_t a, std::size_t b, double depth) {
    if (!(depth > 0)) return;
    ++overlaps;
    if (depth > deepest) deepest = depth, worst_a = a, worst_b = b;
  };
  for (std::size_t a = 0; a < radius.size(); ++a)
    found(a, a,
          2 * radius[a] - std::min(layer.cell.width_x, layer.cell.width_y));  // with its own periodic image
  for (const auto& [a, b] : neighbours::find_pairs(layer.cell, layer.position, radius, {}))
    found(a, b, radius[a] + radius[b] - layer.cell.minimum_image(layer.position[b] - layer.position[a]).norm());
  if (overlaps == 0) return;
  warning(fmt::format("{}: {} {} of particles overlap{}; the deepest is {:.3g} nm, ids {} and {}",
                      file.string(), overlaps, overlaps == 1 ? "pair" : "pairs", overlaps == 1 ? "s" : "",
                      1e3 * deepest, layer.particles.id[worst_a], layer.particles.id[worst_b]));
}

}  // namespace pigment::io
