#include "stepping/integrator.h"

#include <cmath>
#include <limits>

namespace pigment::stepping {

namespace {

// Whether two particles of mean radius fall into contact: somewhere outside the smallest gap of the walk attraction is left, and the
// energy that they would have to climb on the way in is less than 5 kT.
bool coagulates(const Problem& problem) {
  const auto& interactions = problem.interactions;
  const Liquid liquid = liquid_at(interactions.liquid, problem.dewatering.temperature_at(0, interactions.liquid.temperature));
  const auto& radius = problem.particles.radius;
  double mean = 0;
  for (double a : radius) mean += a / static_cast<double>(radius.size());
  double smallest_potential = std::numeric_limits<double>::infinity();
  for (double psi : interactions.surface_potential)
    if (std::abs(psi) < std::abs(smallest_potential)) smallest_potential = psi;
  std::vector<std::unique_ptr<forces::PreparedPairLaw>> laws;
  for (const auto& [name, law] : interactions.colloidal) laws.push_back(law->prepare(liquid));
  const auto energy = [&](double gap) {
    double sum = 0;
    for (const auto& law : laws) sum += law->switched({gap, mean, mean, smallest_potential, smallest_potential}).energy;
    return sum;
  };
  double lowest = 0, highest_climb = 0, deepest = 0;  // on the way in, from where nothing acts
  for (double gap = 0.5; gap > 3e-4; gap *= 0.95) {
    const double e = energy(gap);
    lowest = std::min(lowest, e);
    deepest = std::min(deepest, e);
    highest_climb = std::max(highest_climb, e - lowest);
  }
  const double kT = liquid.thermal_energy();
  return highest_climb < 5 * kT && deepest < -5 * kT;
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
    case I::Automatic: break;
  }
  // At equal error of a layer three solves of second order cost a fraction of many of first order (the accuracy study). Noise
  // is rough: there is no second order to gain, and an extrapolated step does not have its statistics.
  // Where particles bond at every touch a step is as long as Newton's method converges, and extrapolating three such steps costs more
  // than it gains.
  return problem.interactions.brownian || coagulates(problem) ? newton_implicit() : extrapolated();
}

Vec3Array moved(const Vec3Array& position, const Vec3Array& velocity, double dt) {
  Vec3Array result(position.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < position.size(); ++k) result[k] = position[k] + dt * velocity[k];
  return result;
}

}  // namespace pigment::stepping
