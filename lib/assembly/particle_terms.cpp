// What acts between one particle and the liquid, the substrate and the free surface in a step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/step_assembly.h"
#include "forces/surface_spring.h"
#include "resistance/scene_resistance.h"

namespace pigment::assembly {

forces::PairGeometry StepAssembly::wall_geometry(int k) const {
  return {wall_guess_[k], radius_[k], std::numeric_limits<double>::infinity(), potential_[k],
          interactions_.substrate->surface_potential.value_or(potential_[k])};
}

resistance::BoundaryScalars StepAssembly::wall_scalars(int k) const {
  return wall_.empty() ? resistance::wall_term(interactions_.hydrodynamics, radius_[k], resistance_height_[k] - radius_[k]) : wall_[k];
}

double StepAssembly::surface_gap(int k) const {
  const double height = two_step_ ? surface_end_ : path_resistance_ ? 0.5 * (film_.height_begin + surface_end_) : film_.height_begin;
  return height - resistance_height_[k] - radius_[k];
}

resistance::BoundaryScalars StepAssembly::surface_scalars(int k) const {
  // At the roughness the surface hands over to the spring: the hydrodynamic term stays what it is there.
  if (surface_.empty())
    return resistance::free_surface_term(interactions_.hydrodynamics, radius_[k], std::max(surface_gap(k), interactions_.free_surface->roughness));
  return surface_[k];
}

resistance::SqueezeStep StepAssembly::wall_squeeze(int k) const {
  const double a = radius_[k], gap = resistance::hydrodynamic_gap(position_[k].z() - a, a);
  const double at = resistance::hydrodynamic_gap(resistance_height_[k] - a, a);
  resistance::SqueezeStep s{wall_scalars(k).perpendicular, 0};
  const double guess = wall_guess_[k];
  if (two_step_) {
    if (wall_squeeze_from_[k] > 0 && guess > 0) {
      const double c = resistance::squeeze_constant(a), from = position_[k].z() - a;
      s.coefficient += c * (1 / guess - 1 / at);
      s.impulse = c * (std::log(wall_squeeze_from_[k] / guess) + (guess - from) / guess);
    }
    return s;
  }
  if ((newton_ || path_resistance_) && guess != position_[k].z() - a && guess > 0 && gap > 0) {
    const resistance::SqueezeStep step = resistance::squeeze_step(a, gap, guess, at);  // 6 pi a^2/h: a pair's with R = a
    s.coefficient += step.coefficient;
    s.impulse = step.impulse;
  }
  return s;
}

StepForce StepAssembly::substrate_step_force(int k) const {
  const double a = radius_[k], begin = position_[k].z() - a;
  static const std::vector<std::unique_ptr<forces::PreparedPairLaw>> none;
  StepForce f{interactions_.substrate->colloidal ? laws_ : none, wall_geometry(k), begin, two_step_ ? wall_squeeze_from_[k] : begin};
  const double at = resistance::hydrodynamic_gap(resistance_height_[k] - a, a);
  f.singular = liquid_.viscosity * resistance::squeeze_constant(a) / dt_;
  f.split = split_;
  if (split_) f.standing = substrate_standing_force_[k];
  f.linear = liquid_.viscosity * wall_scalars(k).perpendicular / dt_ - f.singular / at;
  return f;
}

StepAssembly::SubstrateState StepAssembly::substrate_state(int k) const {
  if (path_) return path_substrate_state(k);
  SubstrateState s{position_[k].z() - radius_[k], split_ ? substrate_standing_force_[k] : 0, 0};
  if (interactions_.substrate->colloidal && wall_guess_[k] < colloidal_reach_)
    for (const auto& law : laws_) {
      if (split_ && law->concave()) continue;
      const forces::PairTerm t = law->switched(wall_geometry(k));
      s.force += t.force;
      s.stiffness += t.stiffness;
    }
  // The plane stops particles whatever the forces.
  if (wall_guess_[k] < 0) {
    s.force -= forces::contact_stiffness * wall_guess_[k];
    s.stiffness += forces::contact_stiffness;
  }
  return s;
}

StepAssembly::SurfaceState StepAssembly::surface_state(int k) const {
  const forces::FreeSurfaceParameters& surface = *interactions_.free_surface;
  SurfaceState s{surface_gap(k), 0, 0, 0, protrusion_guess_[k]};
  if (interactions_.lubrication()) s.resistance = surface_scalars(k).perpendicular;
  if (protrusion_guess_[k] > held) {
    const forces::SpringForce spring = forces::lifted_spring(surface, radius_[k], protrusion_guess_[k]);
    s.force = spring.force;
    s.stiffness = spring.stiffness;
  }
  return s;
}

void StepAssembly::particle_terms(int chunk, solve::PairSystem& system, double* rhs) const {
  const int D = system.unknowns_per_particle();
  const double mu = liquid_.viscosity, dt = implicit_ ? dt_ : 0;
  for (int k = topology_.chunks().begin[chunk]; k < topology_.chunks().begin[chunk + 1]; ++k) {
    const double a = radius_[k], drag = flow_ ? flow_->drag(k) : mu * resistance::stokes_drag(a);
    solve::ParticleTerm t{drag, drag, 0, mu * resistance::stokes_torque(a), mu * resistance::stokes_torque(a)};
    double* f = rhs + static_cast<std::size_t>(k) * D;
    for (int d = 0; d < D; ++d) f[d] = random_force_.empty() ? 0 : random_force_[static_cast<std::size_t>(k) * D + d];
    if (!external_force_.empty())
      for (int d = 0; d < 3; ++d) f[d] += external_force_[k][d];
    f[2] += flow_ ? flow_->force(k) : -drag * film_.absorption;  // (10): relative to the liquid, which moves with -q e_z
    if (interactions_.gravity)
      f[2] -= (mass_[k] - liquid_.density * Particles::sphere_volume(a)) * interactions_.gravity->acceleration;
    if (rough_) {
      rough_->add_far(k, mu, film_.absorption, t, f);
      rough_->add_near(k, laws_, mu, dt_, implicit_, film_.absorption, D, f, system.own[chunk]);
    } else if (interactions_.substrate) {
      if (interactions_.lubrication()) {
        const resistance::BoundaryScalars w = wall_scalars(k);
        const resistance::SqueezeStep squeeze = wall_squeeze(k);
        const double perpendicular = mu * squeeze.coefficient;
        f[2] += mu * squeeze.impulse / dt_;
        t.along += perpendicular;
        t.across += mu * w.parallel;
        t.coupling += mu * w.coupling;
        t.spin_along += mu * w.twist;
        t.spin_across += mu * w.rolling;
        if (interactions_.substrate->suction == forces::SubstrateParameters::Suction::Uniform)
          f[2] -= perpendicular * film_.absorption;
      }
      const SubstrateState s = substrate_state(k);
      const double stiffness = std::max(s.stiffness, 0.0);
      f[2] += s.force + (implicit_ ? stiffness * (wall_guess_[k] - s.gap_begin) : 0);
      if (!resistance_only_) t.along += dt * stiffness;
    }
    if (interactions_.free_surface) {
      const SurfaceState s = surface_state(k);
      if (interactions_.lubrication()) {
        const resistance::BoundaryScalars w = surface_scalars(k);
        t.across += mu * w.parallel;
        t.coupling += mu * w.coupling;
        t.spin_along += mu * w.twist;
        t.spin_across += mu * w.rolling;
        t.along += mu * s.resistance;
        f[2] -= mu * s.resistance * approach_speed();
      }
      // protrusion at the end: p1 = z0 + a + dt U_z + roughness - H1
      const double without_motion = position_[k].z() + a + interactions_.free_surface->roughness - surface_end_;
      if (s.force > 0) {
        f[2] -= s.force + s.stiffness * (without_motion - s.anchor);
        if (!resistance_only_) t.along += dt_ * s.stiffness;
      }
      system.held[k] = protrusion_guess_[k] == held;
      system.held_velocity[k] = system.held[k] ? -without_motion / dt_ : 0;
    }
    system.particle[k] = t;
  }
}

double StepAssembly::approach_speed() const {
  const bool squeeze = interactions_.free_surface->approach == forces::FreeSurfaceParameters::Approach::Squeeze;
  const double fall = film_.absorption + film_.evaporation;
  const double share = squeeze && fall > 0 ? film_.absorption / fall : 1;
  // A pressure-limited surface may lag behind what the dewatering takes.
  return interactions_.pressure_limited() ? share * (film_.height_begin - surface_end_) / dt_ : squeeze ? film_.absorption : fall;
}

// What the surface presses with: hydrodynamic, springs, and what holds those that are held.
double StepAssembly::surface_pressure(const std::vector<double>& u) const {
  const std::size_t D = interactions_.rotation() ? 6 : 3;
  double force = 0;
  for (int k = 0; k < static_cast<int>(radius_.size()); ++k) {
    const SurfaceState s = surface_state(k);
    force += liquid_.viscosity * s.resistance * (u[k * D + 2] + approach_speed());
    if (s.force > 0) force += s.force + s.stiffness * (protrusion_end_[k] - s.anchor);
    if (protrusion_guess_[k] == held) force += holding_force_[k];
  }
  return force / cell_.area();
}

BoundaryPressures StepAssembly::boundary_pressures(const std::vector<double>& u) const {
  const std::size_t D = interactions_.rotation() ? 6 : 3;
  const double mu = liquid_.viscosity;
  std::vector<BoundaryPressures> parts(topology_.chunks().count());
#pragma omp parallel for schedule(static)
  for (int c = 0; c < topology_.chunks().count(); ++c)
    for (int k = topology_.chunks().begin[c]; k < topology_.chunks().begin[c + 1]; ++k) {
      BoundaryPressures& part = parts[c];
      const double uz = u[k * D + 2];
      if (!flow_) part.liquid -= mu * resistance::stokes_drag(radius_[k]) * (uz + film_.absorption);
      if (interactions_.free_surface && protrusion_guess_[k] > 0) ++part.contacts;
      if (rough_) {
        part.substrate += rough_->force_along_z(k, laws_, mu, dt_, implicit_, film_.absorption, static_cast<int>(D), &u[k * D]);
      } else if (interactions_.substrate) {
        const SubstrateState s = substrate_state(k);
        const double gap_end = position_[k].z() + dt_ * uz - radius_[k];
        part.substrate += s.force - (implicit_ ? std::max(s.stiffness, 0.0) : 0) * (gap_end - wall_guess_[k]);
        const bool uniform = interactions_.substrate->suction == forces::SubstrateParameters::Suction::Uniform;
        if (interactions_.lubrication()) {
          const resistance::SqueezeStep squeeze = wall_squeeze(k);
          part.substrate += mu * (squeeze.impulse / dt_ - squeeze.coefficient * (uz + (uniform ? film_.absorption : 0)));
        }
      }
    }
  BoundaryPressures total;
  for (const SliceState& slice : slice_states(u)) total.liquid += slice.pressure_drop * cell_.area();
  for (const BoundaryPressures& part : parts) {
    total.substrate += part.substrate;
    total.liquid += part.liquid;
    total.contacts += part.contacts;
  }
  if (interactions_.free_surface) total.surface = surface_pressure(u);
  total.substrate /= cell_.area();
  total.liquid /= cell_.area();
  return total;
}

std::vector<SliceState> StepAssembly::slice_states(const std::vector<double>& u) const {
  if (!flow_) return {};
  return flow_->states(u, interactions_.rotation() ? 6 : 3);
}

std::vector<double> StepAssembly::protrusions() const {
  std::vector<double> result(order_.size(), 0.0);
  if (interactions_.free_surface)
    for (std::size_t k = 0; k < order_.size(); ++k)
      // A held particle stays held until the force would pull; a free one starts the next step free.
      result[order_[k]] = protrusion_guess_[k] > held ? std::max(protrusion_end_[k], 2 * held) : protrusion_guess_[k];
  return result;
}

}  // namespace pigment::assembly
