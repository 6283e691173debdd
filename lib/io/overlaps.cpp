#include "io/overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/log.h"

namespace pigment::io {

// Found along the vertical: a layer is thick beside its largest particle, so that few pairs are looked at.
void warn_of_overlaps(const std::filesystem::path& file, const Layer& layer) {
  const auto& radius = layer.particles.radius;
  const std::size_t count = radius.size();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return layer.position[a].z() < layer.position[b].z(); });
  const double largest = *std::max_element(radius.begin(), radius.end());
  std::size_t overlaps = 0, worst_a = 0, worst_b = 0;
  double deepest = 0;
  const auto found = [&](std::size_t a, std::size_t b, double depth) {
    if (!(depth > 0)) return;
    ++overlaps;
    if (depth > deepest) deepest = depth, worst_a = a, worst_b = b;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t a = order[i];
    found(a, a,
          2 * radius[a] - std::min(layer.cell.width_x, layer.cell.width_y));  // with its own periodic image
    for (std::size_t j = i + 1; j < count; ++j) {
      const std::size_t b = order[j];
      if (layer.position[b].z() - layer.position[a].z() > radius[a] + largest) break;
      found(a, b,
            radius[a] + radius[b] - layer.cell.minimum_image(layer.position[b] - layer.position[a]).norm());
    }
  }
  if (overlaps == 0) return;
  warning(fmt::format("{}: {} {} of particles overlap{}; the deepest is {:.3g} nm, ids {} and {}",
                      file.string(), overlaps, overlaps == 1 ? "pair" : "pairs", overlaps == 1 ? "s" : "",
                      1e3 * deepest, layer.particles.id[worst_a], layer.particles.id[worst_b]));
}

}  // namespace pigment::io
