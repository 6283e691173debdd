#include "packing/sample_sizes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "base/random.h"
#include "packing/impossible.h"

namespace pigment::packing {
namespace {

constexpr double most_particles = 1e7;  // some gigabytes and many hours downstream

struct Sampled {
  double radius;
  int species;
};

std::string count_text(double count) {
  std::ostringstream text;
  text.precision(3);
  text << count;
  return text.str();
}

}  // namespace

Particles sample_particles(const std::vector<Species>& species, const std::vector<SizeDistribution>& sizes,
                           double solids_volume, std::uint64_t seed) {
  double total_parts = 0;  // by volume
  for (const Species& s : species) total_parts += s.parts / s.density;

  std::vector<Sampled> sampled;
  for (std::size_t s = 0; s < species.size(); ++s) {
    const double share = species[s].parts / species[s].density / total_parts;
    const double expected = solids_volume * share / sizes[s].mean_volume();
    if (expected > most_particles)
      throw Impossible("layer", "width",
                       "the layer would hold " + count_text(expected) + " particles of species " +
                           species[s].name + ", more than " + count_text(most_particles) +
                           "; make it narrower or thinner, or raise the lower cut-off of the size law");
    const auto count = static_cast<std::uint64_t>(std::llround(expected));
    if (count == 0 && species[s].parts > 0)
      throw Impossible("layer", "width",
                       "the layer is too small to hold a single particle of species " + species[s].name +
                           " (" + count_text(expected) + " expected); make it wider or thicker");
    for (std::uint64_t k = 0; k < count; ++k) {
      const double u = random_uniforms({seed, Stream::PackingSizes}, k, s)[0];
      const double quantile = (static_cast<double>(k) + u) / static_cast<double>(count);
      sampled.push_back({sizes[s].diameter_at_number(quantile) / 2, static_cast<int>(s)});
    }
  }
  std::stable_sort(sampled.begin(), sampled.end(),
                   [](const Sampled& a, const Sampled& b) { return a.radius > b.radius; });

  Particles particles;
  for (const Sampled& p : sampled) {
    particles.radius.push_back(p.radius);
    particles.species.push_back(p.species);
    particles.mass.push_back(species[static_cast<std::size_t>(p.species)].density *
                             Particles::sphere_volume(p.radius));
  }
  particles.id.resize(sampled.size());
  std::iota(particles.id.begin(), particles.id.end(), std::int64_t{0});
  return particles;
}

}  // namespace pigment::packing
