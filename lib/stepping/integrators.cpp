#include "stepping/integrator.h"

namespace pigment::stepping {

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
  return problem.interactions.brownian ? newton_implicit() : extrapolated();
}

Vec3Array moved(const Vec3Array& position, const Vec3Array& velocity, double dt) {
  Vec3Array result(position.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < position.size(); ++k) result[k] = position[k] + dt * velocity[k];
  return result;
}

}  // namespace pigment::stepping
