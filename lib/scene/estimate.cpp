#include "scene/estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/particles.h"

namespace pigment::scene {
namespace {

// What the error control takes as a step on the average, and the time of one core a particle and step, in the 10 um layer
// of the example scene on its way from 65 to 85 wt%: noise keeps steps short and solves long.
struct Pace {
  double step;                       // ms
  double seconds_per_particle_step;
};
constexpr Pace with_brownian{0.06, 6.5e-6}, without_brownian{0.15, 3e-6};
constexpr double bytes_per_particle_and_frame = 9 * 4;  // position, velocity, angular velocity in single precision

// Diameter that holds the fraction u of the number of all species below it: bisection over the mixture.
double quantile(const LayerEstimate& layer, double u) {
  double low = layer.smallest, high = layer.largest;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    double below = 0;
    for (std::size_t s = 0; s < layer.sizes.size(); ++s) below += layer.number_share[s] * layer.sizes[s].number_below(middle);
    (below < u ? low : high) = middle;
  }
  return high;
}

}  // namespace

LayerEstimate estimate_layer(const Scene& scene) {
  const LayerTarget target = layer_target(*scene.layer, scene.species, scene.liquid.density);
  LayerEstimate e;
  e.volume_fraction = target.volume_fraction;
  e.mass_fraction = target.mass_fraction;
  e.thickness = target.thickness;
  e.dry_coat_weight = target.volume_fraction * target.thickness * dry_density(scene.species);
  const double volume = target.volume_fraction * target.thickness * scene.layer->width * scene.layer->width;
  double parts_volume = 0;
  for (const Species& s : scene.species) parts_volume += s.parts / s.density;
  for (const Species& s : scene.species) {
    e.sizes.emplace_back(s.size);
    e.number_share.push_back(volume * (s.parts / s.density / parts_volume) / e.sizes.back().mean_volume());
    e.particles += e.number_share.back();
  }
  for (double& share : e.number_share) share /= e.particles;
  e.smallest = e.sizes.front().smallest();
  for (const SizeDistribution& d : e.sizes) {
    e.smallest = std::min(e.smallest, d.smallest());
    e.largest = std::max(e.largest, d.largest());
  }
  e.median = quantile(e, 0.5);
  // Spheres of the mean volume on a face-centred lattice touch at pi/sqrt(18).
  const double mean_diameter = std::cbrt(6 / std::numbers::pi * volume / e.particles);
  e.mean_gap = mean_diameter * (std::cbrt(std::numbers::pi / std::sqrt(18.0) / e.volume_fraction) - 1);
  return e;
}

RateEstimate estimate_rates(const dewatering::Profile& profile) {
  constexpr int parts = 100;
  RateEstimate r;
  r.duration = profile.duration;
  r.removed = profile.removed;
  const DewateringCurve& curve = profile.curve;
  for (int k = 0; k < parts; ++k) {
    const double t0 = r.duration * k / parts, t1 = r.duration * (k + 1) / parts;
    const double rate = curve.mean_absorption_flux(t0, t1) + curve.mean_evaporation_flux(t0, t1);
    r.fastest = std::max(r.fastest, rate);
    r.slowest = k == 0 ? rate : std::min(r.slowest, rate);
    r.mean += rate / parts;
  }
  return r;
}

CostEstimate estimate_cost(const Scene& scene, const LayerEstimate& layer, double duration) {
  CostEstimate c;
  c.particles = layer.particles;
  const Liquid liquid = liquid_at(scene.liquid, scene.liquid.temperature);
  double reach = 0;
  for (const forces::ColloidalLaw& law : scene.colloidal) reach = std::max(reach, law.law->prepare(liquid)->cutoff_gap());
  const bool lubrication = scene.hydrodynamics.model != resistance::HydrodynamicsParameters::Model::Drag;
  // Mean volume of the shell of gaps within reach, over pairs of a number-weighted sample.
  constexpr int sample = 40;
  double shell = 0;
  for (int i = 0; i < sample; ++i)
    for (int j = 0; j < sample; ++j) {
      const double a = quantile(layer, (i + 0.5) / sample) / 2, b = quantile(layer, (j + 0.5) / sample) / 2;
      const double gap = std::max(reach, lubrication ? scene.hydrodynamics.taper.squeeze_end * std::min(a, b) : 0.0);
      shell += Particles::sphere_volume(a + b + gap) - Particles::sphere_volume(a + b);
    }
  shell /= sample * sample;
  const double density = layer.particles / (layer.thickness * scene.layer->width * scene.layer->width);
  c.pairs = 0.5 * layer.particles * density * shell * (1 + 0.75 * layer.volume_fraction);
  const Pace& pace = scene.brownian ? with_brownian : without_brownian;
  c.step = scene.stepping.time_step.value_or(pace.step);
  c.steps = duration / c.step;
  c.frames = 1 + std::floor(duration / scene.output.every);
  c.seconds = pace.seconds_per_particle_step * c.particles * c.steps;
  c.megabytes = 1e-6 * bytes_per_particle_and_frame * c.particles * c.frames;
  return c;
}

}  // namespace pigment::scene
