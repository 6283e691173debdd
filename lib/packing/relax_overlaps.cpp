#include "packing/relax_overlaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "packing/adjacency.h"

namespace pigment::packing {
namespace {

// Waking threads for less than this takes longer than the work.
constexpr std::size_t worth_threads = 10000;
// Steps between two looks at whether the energy still falls.
constexpr int stall_check = 300;

// One minimisation on radii enlarged by the factor 1 + margin.
class Minimisation {
 public:
  Minimisation(const Slab& slab, const std::vector<double>& radius, double margin, Vec3Array& centre)
      : slab_(slab),
        cell_(slab.cell()),
        radius_(radius),
        enlarged_(radius),
        mass_(radius.size()),
        centre_(centre),
        velocity_(radius.size(), Vec3::Zero()),
        force_(radius.size(), Vec3::Zero()),
        overlap_(radius.size(), 0.0),
        energy_(radius.size(), 0.0) {
    const double smallest = *std::min_element(radius.begin(), radius.end());
    for (std::size_t i = 0; i < radius.size(); ++i) {
      enlarged_[i] *= 1 + margin;
      // The number of contacts grows like the surface, and the mass with it: one time step then suits all
      // sizes.
      mass_[i] = (radius[i] / smallest) * (radius[i] / smallest);
    }
    skin_ = 0.4 * smallest;
  }

  // True when no overlap of the true radii is left.
  bool run(int most_steps, Relaxation& result, const std::function<void(double)>& on_progress) {
    // Unit spring stiffness and a unit mass for the smallest sphere: a dozen contacts give a highest
    // frequency near 5, which a step of 0.25 resolves.
    constexpr double first_step = 0.1, longest_step = 0.25;
    double step = first_step, mixing = 0.1;
    int steps_downhill = 0;
    double energy_before = std::numeric_limits<double>::infinity();
    for (int n = 0; n < most_steps; ++n, ++result.steps) {
      refresh_neighbours();
      evaluate_forces();
      result.largest_overlap = std::max(0.0, *std::max_element(overlap_.begin(), overlap_.end()));
      if (result.largest_overlap <= 0) return true;
      if (on_progress && n % 64 == 0) on_progress(result.largest_overlap);
      if (n % stall_check == 0) {
        // Where there is room the energy falls by decades in this many steps; where there is none it settles.
        double energy = 0;
        for (const double e : energy_) energy += e;
        if (energy > 0.7 * energy_before) return false;
        energy_before = energy;
      }

      double power = 0, speed2 = 0, force2 = 0;  // in the metric of the masses
      for (std::size_t i = 0; i < radius_.size(); ++i) {
        power += force_[i].dot(velocity_[i]);
        speed2 += mass_[i] * velocity_[i].squaredNorm();
        force2 += force_[i].squaredNorm() / mass_[i];
      }
      if (power > 0) {
        const double along_force = force2 > 0 ? mixing * std::sqrt(speed2 / force2) : 0;
        for (std::size_t i = 0; i < radius_.size(); ++i)
          velocity_[i] = (1 - mixing) * velocity_[i] + along_force / mass_[i] * force_[i];
        if (++steps_downhill > 5) step = std::min(1.1 * step, longest_step), mixing *= 0.99;
      } else {
        std::fill(velocity_.begin(), velocity_.end(), Vec3(Vec3::Zero()));
        steps_downhill = 0, mixing = 0.1;
        step = std::max(0.5 * step, 0.02);
      }
      move(step);
    }
    return false;
  }

 private:
  void refresh_neighbours() {
    double moved2 = 0;
    for (std::size_t i = 0; i < centre_.size() && !reference_.empty(); ++i)
      moved2 = std::max(moved2, cell_.minimum_image(centre_[i] - reference_[i]).squaredNorm());
    // Two spheres may have used up half of the skin each.
    if (!reference_.empty() && moved2 < 0.25 * skin_ * skin_) return;
    for (Vec3& c : centre_) c = cell_.wrap(c);
    near_ = std::make_unique<Adjacency>(cell_, centre_, enlarged_, skin_);
    reference_ = centre_;
  }

  void evaluate_forces() {
#pragma omp parallel for schedule(static) if (centre_.size() > worth_threads)
    for (std::size_t i = 0; i < centre_.size(); ++i) {
      Vec3 force = Vec3::Zero();
      double worst = 0, energy = 0;
      for (std::size_t k = near_->begin[i]; k < near_->begin[i + 1]; ++k) {
        const auto j = static_cast<std::size_t>(near_->other[k]);
        const Vec3 d = cell_.minimum_image(centre_[j] - centre_[i]);
        const double contact = enlarged_[i] + enlarged_[j], distance2 = d.squaredNorm();
        if (distance2 >= contact * contact) continue;
        const double distance = std::sqrt(distance2);
        worst = std::max(worst, radius_[i] + radius_[j] - distance);
        // Concentric spheres part along x, the lower index to the left.
        const Vec3 normal = distance > 0 ? Vec3(d / distance) : Vec3(i < j ? 1 : -1, 0, 0);
        force -= (contact - distance) * normal;
        energy += (contact - distance) * (contact - distance);
      }
      if (slab_.floor)
        for (const HeightField::Foot& foot : slab_.floor->feet(centre_[i], enlarged_[i] + slab_.floor_gap)) {
          const double depth = enlarged_[i] + slab_.floor_gap - foot.distance;
          worst = std::max(worst, radius_[i] + slab_.floor_gap - foot.distance);
          force += depth * foot.normal;
          energy += depth * depth;
        }
      force_[i] = force;
      overlap_[i] = worst;
      energy_[i] = energy;
    }
  }

  void move(double step) {
#pragma omp parallel for schedule(static) if (centre_.size() > worth_threads)
    for (std::size_t i = 0; i < centre_.size(); ++i) {
      velocity_[i] += step / mass_[i] * force_[i];
      Vec3 displacement = step * velocity_[i];
      // Deep overlaps at the start must not throw spheres past their neighbours.
      const double length = displacement.norm(), longest = 0.1 * radius_[i];
      if (length > longest) displacement *= longest / length;
      centre_[i] += displacement;
      const double low = slab_.bottom + radius_[i], high = slab_.top - radius_[i];
      if (centre_[i].z() < low || centre_[i].z() > high) {
        centre_[i].z() = std::clamp(centre_[i].z(), low, high);
        velocity_[i].z() = 0;
      }
    }
  }

  Slab slab_;
  Cell cell_;
  const std::vector<double>& radius_;
  std::vector<double> enlarged_, mass_;
  Vec3Array& centre_;
  Vec3Array velocity_, force_, reference_;
  std::vector<double> overlap_, energy_;
  std::unique_ptr<Adjacency> near_;
  double skin_ = 0;
};

}  // namespace

Relaxation relax_overlaps(const Slab& slab, const std::vector<double>& radius, Vec3Array& centre,
                          const std::function<void(double)>& on_progress) {
  Relaxation result;
  if (radius.empty()) {
    result.done = true;
    return result;
  }
  // A wide margin gets there in a few hundred steps; where there is no room for it, a narrower one.
  constexpr struct {
    double margin;
    int steps;
  } passes[] = {{1e-2, 3000}, {3e-3, 4000}, {1e-3, 6000}, {1e-4, 8000}};
  for (const auto& pass : passes) {
    Minimisation minimisation(slab, radius, pass.margin, centre);
    result.done = minimisation.run(pass.steps, result, on_progress);
    if (result.done) break;
  }
  for (Vec3& c : centre) c = slab.cell().wrap(c);
  return result;
}

}  // namespace pigment::packing
