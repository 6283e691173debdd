#include "report/particle_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pigment::report {
namespace {

const Colour pale_grey = from_srgb(214, 216, 220);

}  // namespace

Colour ParticleColours::of(std::size_t particle) const {
  if (!pale.empty() && pale[particle]) return pale_grey;
  if (!categories.empty()) return categorical(static_cast<std::size_t>(std::max(0.0, value[particle])));
  if (map == Map::Identity) return identity_tint(static_cast<std::int64_t>(value[particle]));
  return on_scale(position(value[particle]));
}

Colour ParticleColours::on_scale(double at) const {
  return map == Map::NearToFar ? near_to_far(at) : sequential(at);
}

double ParticleColours::position(double v) const {
  if (!(high > low)) return 0.5;
  if (logarithmic) return std::log(std::max(v, 1e-300) / low) / std::log(high / low);
  return (v - low) / (high - low);
}

Ticks scale_ticks(const ParticleColours& c, int wanted) {
  if (!c.logarithmic || !(c.high > c.low)) {
    // One number alone says nothing of a scale; round steps may leave as few.
    Ticks ticks = linear_ticks(c.low, c.high, wanted);
    for (int more = wanted + 1; c.high > c.low && ticks.values.size() < 3 && more <= 3 * wanted; ++more)
      ticks = linear_ticks(c.low, c.high, more);
    return ticks;
  }
  Ticks ticks = logarithmic_ticks(c.low, c.high);
  std::erase_if(ticks.values, [&](double v) { return c.position(v) < 0.12 || c.position(v) > 0.88; });
  ticks.values.insert(ticks.values.begin(), c.low);
  ticks.values.push_back(c.high);
  ticks.labels.clear();
  for (const double v : ticks.values) ticks.labels.push_back(number_text(v, v < 10 ? 2 : 3));
  return ticks;
}

ParticleColours colours_by_size(const Particles& particles) {
  ParticleColours c{"diameter", "µm", {}, 0, 0, true, {}};
  for (const double a : particles.radius) c.value.push_back(2 * a);
  const auto [low, high] = std::minmax_element(c.value.begin(), c.value.end());
  if (low != c.value.end()) c.low = *low, c.high = *high;
  return c;
}

ParticleColours colours_by_species(const Particles& particles, const std::vector<std::string>& names) {
  ParticleColours c{"species", "", {}, 0, 1, false, names};
  for (const int s : particles.species) c.value.push_back(s);
  c.value.resize(particles.size(), 0);
  const double most = c.value.empty() ? 0 : *std::max_element(c.value.begin(), c.value.end());
  for (std::size_t i = c.categories.size(); i <= static_cast<std::size_t>(most); ++i)
    c.categories.push_back(fmt::format("species {}", i + 1));
  return c;
}

ParticleColours colours_by_height(const Layer& layer, double highest) {
  ParticleColours c{"height", "µm", {}, 0, highest, false, {}};
  for (const Vec3& p : layer.position) c.value.push_back(p.z());
  return c;
}

namespace {

void scale_by_percentiles(ParticleColours& c) {
  if (c.value.empty()) return;
  std::vector<double> sorted = c.value;
  std::sort(sorted.begin(), sorted.end());
  const auto percentile = [&](double p) {
    return sorted[static_cast<std::size_t>(p * static_cast<double>(sorted.size() - 1))];
  };
  c.low = percentile(0.02), c.high = percentile(0.98);
}

}  // namespace

ParticleColours colours_by_speed(const std::string& label, const std::vector<double>& speed) {
  ParticleColours c{label, "µm/s", {}, 0, 0, false, {}};
  for (const double v : speed) c.value.push_back(1000 * v);
  scale_by_percentiles(c);
  return c;
}

ParticleColours colours_by_local_solids(const std::vector<double>& fraction) {
  ParticleColours c{"solids in its own space", "vol-%", {}, 0, 0, false, {}};
  for (const double v : fraction) c.value.push_back(100 * v);
  scale_by_percentiles(c);
  return c;
}

ParticleColours colours_by_cluster(const std::vector<double>& size) {
  ParticleColours c{"particles in the cluster (grey: alone)", "", size, 2, 2, true, {}};
  for (const double s : size) {
    c.high = std::max(c.high, s);
    c.pale.push_back(s < 2);
  }
  return c;
}

ParticleColours colours_by_cluster_identity(const std::vector<std::int64_t>& id,
                                            const std::vector<std::int64_t>& size) {
  ParticleColours c{"a tint each cluster (grey: alone)", "", {id.begin(), id.end()}, 0, 1, false, {}};
  c.map = ParticleColours::Map::Identity;
  for (const std::int64_t s : size) c.pale.push_back(s < 2);
  return c;
}

ParticleColours colours_by_membership(const std::vector<std::int64_t>& size) {
  ParticleColours c{"membership", "", {}, 0, 1, false, {"alone", "in a cluster"}};
  for (const std::int64_t s : size) c.value.push_back(s < 2 ? 0 : 1);
  return c;
}

}  // namespace pigment::report
