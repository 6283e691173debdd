#pragma once
// A layer without overlaps for tests: largest first, each at random where it fits.
#include <algorithm>

#include "base/random.h"
#include "model/particles.h"

namespace pigment::tests {

inline Layer synthetic_layer(std::size_t count, double width, double height, double smallest,
                             double largest) {
  Layer layer;
  layer.cell = {width, width, height};
  std::vector<double> radius;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = random_uniforms({7, Stream::Tests}, i)[0];
    const double a = smallest / std::pow(1 - u * (1 - std::pow(smallest / largest, 2.0)), 0.5);
    radius.push_back(a);
  }
  std::sort(radius.rbegin(), radius.rend());
  // A grid of lists keeps the insertion quick.
  const double cell = 2 * largest;
  const int n = std::max(1, static_cast<int>(width / cell)), m = static_cast<int>(height / cell) + 2;
  std::vector<std::vector<std::size_t>> grid(static_cast<std::size_t>(n * n * m));
  const auto index = [&](int x, int y, int z) {
    return static_cast<std::size_t>((z * n + (y % n + n) % n) * n + (x % n + n) % n);
  };
  for (std::size_t i = 0; i < count; ++i)
    for (std::uint64_t attempt = 0; attempt < 2000; ++attempt) {
      const auto u = random_uniforms({8, Stream::Tests}, i, attempt);
      const double a = radius[i];
      const Vec3 p(u[0] * width, u[1] * width, a + u[2] * (height - 2 * a));
      const int x = static_cast<int>(p.x() / width * n), y = static_cast<int>(p.y() / width * n),
                z = static_cast<int>(p.z() / cell);
      bool free = true;
      for (int dz = -1; dz <= 1 && free; ++dz)
        for (int dy = -1; dy <= 1 && free; ++dy)
          for (int dx = -1; dx <= 1 && free; ++dx) {
            if (z + dz < 0 || z + dz >= m) continue;
            for (const std::size_t j : grid[index(x + dx, y + dy, z + dz)]) {
              const double reach = a + layer.particles.radius[j];
              if (layer.cell.minimum_image(layer.position[j] - p).squaredNorm() < reach * reach) free = false;
            }
          }
      if (!free) continue;
      grid[index(x, y, z)].push_back(layer.position.size());
      layer.position.push_back(p);
      layer.particles.radius.push_back(a);
      layer.particles.id.push_back(static_cast<std::int64_t>(i));
      layer.particles.species.push_back(static_cast<int>(layer.position.size() % 3));
      layer.particles.mass.push_back(0);
      break;
    }
  return layer;
}

}  // namespace pigment::tests
