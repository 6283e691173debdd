#include "packing/equilibrate.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/random.h"
#include "packing/adjacency.h"

namespace pigment::packing {
namespace {

// Displacement lengths of one size class (a factor of two in radius).
struct MoveLength {
  double longest = 0, length = 0;  // um
  std::uint64_t tried = 0, accepted = 0;

  void tune() {
    if (tried == 0) return;
    const double acceptance = static_cast<double>(accepted) / static_cast<double>(tried);
    length = std::min(longest, length * std::clamp(acceptance / 0.4, 0.7, 1.4));
    tried = accepted = 0;
  }
};

}  // namespace

Equilibration equilibrate(const Slab& slab, const std::vector<double>& radius, Vec3Array& centre, int sweeps,
                          std::uint64_t seed, const std::function<void(double)>& on_progress) {
  Equilibration result;
  if (radius.empty() || sweeps <= 0) return result;
  const Cell cell = slab.cell();
  const double smallest = *std::min_element(radius.begin(), radius.end());
  // Wide enough for several moves between two searches; the cell (two largest diameters wide) bounds it too,
  // since a neighbour is known by its nearest image only.
  const double skin = 0.8 * smallest;

  std::vector<int> size_class(radius.size());
  std::vector<MoveLength> move;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    size_class[i] = std::ilogb(radius[i] / smallest);
    if (move.size() <= static_cast<std::size_t>(size_class[i])) move.resize(size_class[i] + 1);
  }
  for (MoveLength& m : move) m.longest = skin / 4, m.length = skin / 16;

  std::unique_ptr<Adjacency> near;
  Vec3Array reference;
  std::uint64_t all_accepted = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t i = 0; i < radius.size(); ++i) {
      MoveLength& m = move[size_class[i]];
      const auto u = random_uniforms({seed, Stream::PackingMonteCarlo}, i, static_cast<std::uint64_t>(sweep));
      const Vec3 place = centre[i] + m.length * Vec3(2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1);
      ++m.tried;
      if (place.z() < slab.bottom + radius[i] || place.z() > slab.top - radius[i]) continue;
      // The list holds while no sphere has left its reference by more than half of the skin.
      if (!near || (place - reference[i]).squaredNorm() > 0.25 * skin * skin) {
        near = std::make_unique<Adjacency>(cell, centre, radius, skin);
        reference = centre;
      }
      bool free = true;
      for (std::size_t k = near->begin[i]; k < near->begin[i + 1] && free; ++k) {
        const auto j = static_cast<std::size_t>(near->other[k]);
        const double contact = radius[i] + radius[j];
        free = cell.minimum_image(centre[j] - place).squaredNorm() >= contact * contact;
      }
      if (!free || slab.floor_overlap(place, radius[i]) > 0) continue;
      centre[i] = place;
      ++m.accepted, ++all_accepted;
    }
    if (sweep < sweeps / 2)
      for (MoveLength& m : move) m.tune();
    if (on_progress) on_progress(static_cast<double>(sweep + 1) / sweeps);
  }
  for (Vec3& c : centre) c = cell.wrap(c);
  result.acceptance =
      static_cast<double>(all_accepted) / (static_cast<double>(sweeps) * static_cast<double>(radius.size()));
  return result;
}

}  // namespace pigment::packing
