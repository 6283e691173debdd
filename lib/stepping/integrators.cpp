#include "stepping/integrator.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "assembly/interaction_curves.h"

namespace pigment::stepping {

namespace {

// Whether two particles of mean radius, those that are charged least, fall into contact: they have to climb less than 5 kT on the way in,
// and contact holds them by more than that.
bool coagulates(const Problem& problem) {
  const assembly::Interactions& interactions = problem.interactions;
  const Liquid liquid = liquid_at(interactions.liquid, problem.dewatering.temperature_at(0, interactions.liquid.temperature));
  const auto& radius = problem.particles.radius;
  const auto& potentials = interactions.surface_potential;
  if (radius.empty() || potentials.empty() || interactions.colloidal.empty()) return false;
  const double mean = std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
  const double potential =
      *std::min_element(potentials.begin(), potentials.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const assembly::InteractionEvaluator pair(interactions, liquid);
  double lowest = 0, highest_climb = 0;  // on the way in, from where nothing acts to the Born minimum
  for (double gap = 0.5; gap > 3e-4; gap *= 0.95) {
    const double energy = pair.total({assembly::Partner::Sphere, mean, mean, potential, potential}, gap).energy;
    lowest = std::min(lowest, energy);
    highest_climb = std::max(highest_climb, energy - lowest);
  }
  const double limit = 5 * liquid.thermal_energy();
  return highest_climb < limit && lowest < -limit;
}

}  // namespace

std::unique_ptr<Integrator> make_integrator(const Problem& problem) {
  using I = SteppingParameters::Integrator;
  const auto& brownian = problem.interactions.brownian;
  if (brownian && brownian->model == forces::BrownianParameters::Model::FluctuationDissipation) {
    if (problem.stepping.integrator == I::ExplicitEuler) return fluctuating(assembly::Treatment::ExplicitMidpoint);
    if (problem.stepping.integrator == I::LinearlyImplicit) return fluctuating(assembly::Treatment::ImplicitMidpoint);
    return fluctuating(assembly::Treatment::PathAverage);
  }
  switch (problem.stepping.integrator) {
    case I::ExplicitEuler: return explicit_euler();
    case I::ExplicitMidpoint: return explicit_midpoint();
    case I::LinearlyImplicit: return linearly_implicit();
    case I::NewtonImplicit: return newton_implicit();
    case I::Extrapolated: return extrapolated();
    case I::ConvexSplitting: return convex_splitting();
    case I::BackwardDifferentiation: return backward_differentiation();
    case I::Automatic: break;
  }
  // Noise is rough: there is no second order to gain, and neither a step that looks back nor an extrapolated one has its statistics.
  if (brownian) return newton_implicit();
  // Where particles bond at every touch Newton's method converges in long steps only if it has a minimum to find.
  if (coagulates(problem)) return convex_splitting();
  // At equal error of a layer one solution of second order costs a third of three, and a fraction of many of first order (the accuracy
  // study). Contacts with a tilted wall are known at the beginning of a step alone.
  return problem.interactions.height_field ? extrapolated() : backward_differentiation();
}

Vec3Array moved(const Vec3Array& position, const Vec3Array& velocity, double dt) {
  Vec3Array result(position.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < position.size(); ++k) result[k] = position[k] + dt * velocity[k];
  return result;
}

}  // namespace pigment::stepping
