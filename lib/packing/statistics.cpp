#include "packing/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/layer_measures.h"
#include "neighbours/pair_search.h"

namespace pigment::packing {
namespace {

// Largest distance between a law and the steps of a sample whose k-th diameter counts weight[k].
template <typename Law>
double largest_distance(const std::vector<double>& sorted, const std::vector<double>& weight, Law&& law) {
  double total = 0, below = 0, distance = 0;
  for (const double w : weight) total += w;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const double expected = law(sorted[k]);
    distance = std::max(distance, expected - below / total);
    below += weight[k];
    distance = std::max(distance, below / total - expected);
  }
  return distance;
}

}  // namespace

double kolmogorov_probability(double distance, double effective_count) {
  const double root = std::sqrt(effective_count);
  const double x = (root + 0.12 + 0.11 / root) * distance;
  if (x < 0.2) return 1;  // the series below converges slowly there; 1 to 12 digits
  double sum = 0, sign = 1;
  for (int k = 1; k <= 100; ++k, sign = -sign) sum += sign * std::exp(-2.0 * k * k * x * x);
  return std::clamp(2 * sum, 0.0, 1.0);
}

KolmogorovSmirnov compare_numbers(std::vector<double> diameter, const SizeDistribution& law) {
  if (law.monodisperse() || diameter.empty()) return {};
  std::sort(diameter.begin(), diameter.end());
  const std::vector<double> one(diameter.size(), 1.0);
  const double distance = largest_distance(diameter, one, [&](double d) { return law.number_below(d); });
  return {distance, kolmogorov_probability(distance, static_cast<double>(diameter.size()))};
}

KolmogorovSmirnov compare_weights(std::vector<double> diameter, const SizeDistribution& law) {
  if (law.monodisperse() || diameter.empty()) return {};
  std::sort(diameter.begin(), diameter.end());
  std::vector<double> volume;
  double sum = 0, sum2 = 0;
  for (const double d : diameter) {
    volume.push_back(d * d * d);
    sum += volume.back();
    sum2 += volume.back() * volume.back();
  }
  const double distance = largest_distance(diameter, volume, [&](double d) { return law.weight_below(d); });
  return {distance, kolmogorov_probability(distance, sum * sum / sum2)};
}

std::vector<SizeAgreement> compare_sizes(const Layer& layer, const std::vector<SizeDistribution>& sizes) {
  std::vector<SizeAgreement> result;
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    std::vector<double> diameter;
    for (std::size_t i = 0; i < layer.particles.size(); ++i)
      if (layer.particles.species[i] == static_cast<int>(s))
        diameter.push_back(2 * layer.particles.radius[i]);
    result.push_back(
        {diameter.size(), compare_numbers(diameter, sizes[s]), compare_weights(diameter, sizes[s])});
  }
  return result;
}

namespace {

double space_below(const Layer& layer, double z) { return layer.substrate ? layer.substrate->space_below(z) : z; }
double divided(double part, double whole) { return whole > 0 ? part / whole : 0; }
double gap_to_substrate(const Layer& layer, std::size_t i) {
  const double a = layer.particles.radius[i];
  return layer.substrate ? layer.substrate->gap(layer.position[i], a, 2 * a) : layer.position[i].z() - a;
}

}  // namespace

ProfileFlatness measure_flatness(const Layer& layer, int slices) {
  ProfileFlatness result;
  const double height = layer.cell.height, area = layer.cell.area();
  const auto fraction = [&](const std::vector<double>& edges) {
    std::vector<double> part = slice_volumes(edges, layer.position, layer.particles.radius);
    for (std::size_t s = 0; s < part.size(); ++s) part[s] = divided(part[s], area * (space_below(layer, edges[s + 1]) - space_below(layer, edges[s])));
    return part;
  };
  result.edges = equal_slices(height, slices);
  result.volume_fraction = fraction(result.edges);

  const double outer = std::min(1.0, height / 3);
  const auto parts = fraction({0, outer, height - outer, height});
  result.outer_bottom = parts[0], result.inner = parts[1], result.outer_top = parts[2];
  double sum = 0, sum2 = 0;
  int count = 0;
  for (int s = 0; s < slices; ++s)
    if (result.edges[s] >= outer && result.edges[s + 1] <= height - outer) {
      sum += result.volume_fraction[s];
      sum2 += result.volume_fraction[s] * result.volume_fraction[s];
      ++count;
    }
  if (count > 1 && sum > 0) {
    const double mean = sum / count;
    result.inner_deviation = std::sqrt(std::max(0.0, (sum2 - count * mean * mean) / (count - 1))) / mean;
  }
  return result;
}

SmallestGaps smallest_gaps(const Layer& layer) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double>& radius = layer.particles.radius;
  SmallestGaps gaps{infinity, infinity, infinity};
  for (std::size_t i = 0; i < radius.size(); ++i) {
    gaps.substrate = std::min(gaps.substrate, gap_to_substrate(layer, i));
    gaps.surface = std::min(gaps.surface, layer.cell.height - layer.position[i].z() - radius[i]);
  }
  if (radius.size() < 2) return gaps;
  const double farthest = layer.cell.width_x + layer.cell.width_y + layer.cell.height;
  for (double reach = 0.1 * *std::max_element(radius.begin(), radius.end());; reach *= 4) {
    for (const auto& p : neighbours::find_pairs(layer.cell, layer.position, radius, {0, 0, reach}))
      gaps.particles = std::min(gaps.particles,
                                layer.cell.minimum_image(layer.position[p.j] - layer.position[p.i]).norm() -
                                    radius[p.i] - radius[p.j]);
    if (std::isfinite(gaps.particles) || reach > farthest) return gaps;
  }
}

Solids solids_of(const Layer& layer, double liquid_density) {
  double mass = 0;
  for (const double m : layer.particles.mass) mass += m;
  const double volume = solids_volume(layer.particles.radius), box = layer.cell.area() * space_below(layer, layer.cell.height);
  return {volume / box, mass / (mass + liquid_density * (box - volume)), mass / layer.cell.area()};
}

}  // namespace pigment::packing
