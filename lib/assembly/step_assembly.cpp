#include "assembly/step_assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "forces/surface_spring.h"
#include "resistance/scene_resistance.h"

namespace pigment::assembly {

namespace {

// Particles that neither touch the surface nor leave it may be held in one pass and free in the next for ever. After some passes one
// stays as it is that the surface holds back by less than kT/nm, or that sticks out by less than a tenth of an atom.
constexpr double weak_hold = 4;  // pN

std::vector<int> chunk_of_pairs(const solve::PairTopology& t) {
  std::vector<int> count;
  for (int c = 0; c < t.chunks().count(); ++c) count.push_back(static_cast<int>(t.pair_begin(c + 1) - t.pair_begin(c)));
  return count;
}

solve::PairTopology topology_of(std::size_t particles, const std::vector<neighbours::IndexPair>& pairs) {
  std::vector<std::int32_t> i(pairs.size()), j(pairs.size());
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    i[p] = pairs[p].i;
    j[p] = pairs[p].j;
  }
  return solve::PairTopology(particles, i, j);
}

}  // namespace

StepAssembly::StepAssembly(const Interactions& interactions, const Particles& particles, const Cell& cell,
                           const neighbours::NeighbourList& list)
    : interactions_(interactions), cell_(cell), order_(list.order), pairs_(list.pairs),
      topology_(topology_of(particles.size(), list.pairs)) {
  const std::size_t n = particles.size();
  radius_.resize(n);
  mass_.resize(n);
  std::vector<double> potential(n);
  for (std::size_t k = 0; k < n; ++k) {
    radius_[k] = particles.radius[order_[k]];
    mass_[k] = particles.mass[order_[k]];
    potential[k] = interactions.surface_potential[particles.species[order_[k]]];
  }
  geometry_.resize(pairs_.size());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const auto [i, j] = pairs_[p];
    geometry_[p] = {0, radius_[i], radius_[j], potential[i], potential[j]};
  }
  if (interactions.substrate && interactions.height_field) {
    rough_.emplace(interactions, radius_, potential);
  } else if (interactions.substrate) {
    substrate_geometry_.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      substrate_geometry_[k] = {0, radius_[k], std::numeric_limits<double>::infinity(), potential[k],
                                interactions.substrate->surface_potential.value_or(potential[k])};
  }
  if (interactions.pressure_limited()) entry_pressure_ = forces::entry_pressure(*interactions.free_surface, radius_);
  if (interactions.hindered()) flow_.emplace(radius_, cell.area(), cell.height, interactions.height_field.get());
  normal_.resize(pairs_.size());
  gap_begin_.resize(pairs_.size());
  resistance_gap_.resize(pairs_.size());
  resistance_height_.resize(n);
  scalars_.resize(pairs_.size());
  bracket_.resize(pairs_.size());
  turn_.resize(pairs_.size());
  position_.resize(n);
  protrusion_guess_.assign(n, 0.0);
  protrusion_end_.assign(n, 0.0);
  holding_force_.assign(n, 0.0);
  const std::vector<int> count = chunk_of_pairs(topology_);
  force_.resize(count.size());
  stiffness_.resize(count.size());
  term_.resize(count.size());
  for (std::size_t c = 0; c < count.size(); ++c) {
    force_[c].resize(count[c]);
    stiffness_[c].resize(count[c]);
  }
}

void StepAssembly::begin(const Vec3Array& position, const Film& film, const Liquid& liquid, double dt, Treatment treatment,
                         const Vec3Array& force, const std::vector<double>& protrusion) {
  film_ = film;
  surface_end_ = film.height_end;
  if (interactions_.pressure_limited()) {
    const double fall = dt * (film.absorption + film.evaporation);
    search_ = SurfaceSearch(film.height_end, film.height_guess, 0.25 * std::max(fall, 1e-3 * interactions_.free_surface->roughness), entry_pressure_);
    surface_end_ = search_.height();
  }
  liquid_ = liquid;
  dt_ = dt;
  implicit_ = treatment != Treatment::Explicit && treatment != Treatment::ExplicitMidpoint;
  newton_ = treatment == Treatment::Newton;
  path_force_ = treatment == Treatment::PathAverage;
  path_ = path_force_ || treatment == Treatment::ExplicitMidpoint || treatment == Treatment::ImplicitMidpoint;
  path_resistance_ = path_ && !(interactions_.brownian && !interactions_.brownian->drift);
  passes_ = 0;
  random_force_.clear();
  if (liquid.temperature != prepared_temperature_) {
    laws_.clear();
    for (const auto& [name, law] : interactions_.colloidal) laws_.push_back(law->prepare(liquid));
    prepared_temperature_ = liquid.temperature;
  }
  std::fill(bracket_.begin(), bracket_.end(), GapBracket{});
  std::fill(turn_.begin(), turn_.end(), 0.0);
  const std::size_t n = radius_.size();
  external_force_.resize(force.empty() ? 0 : n);
  const int chunks = topology_.chunks().count();
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < n; ++k) {
    position_[k] = position[order_[k]];
    resistance_height_[k] = position_[k].z();
    if (!force.empty()) external_force_[k] = force[order_[k]];
    if (interactions_.free_surface) protrusion_guess_[k] = protrusion[order_[k]];
    if (interactions_.substrate && !rough_) substrate_geometry_[k].gap = position_[k].z() - radius_[k];
  }
  if (rough_) rough_->begin(position_, laws_);
  if (flow_) flow_->place(position_, interactions_.free_surface ? film.height_begin : 0, liquid.viscosity, film.absorption);
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c)
    for (std::size_t p = topology_.pair_begin(c); p < topology_.pair_begin(c + 1); ++p) {
      const auto [i, j] = pairs_[p];
      const Vec3 d = cell_.minimum_image(position_[j] - position_[i]);
      const double r = d.norm();
      normal_[p] = d / r;
      gap_begin_[p] = geometry_[p].gap = resistance_gap_[p] = r - radius_[i] - radius_[j];
      if (interactions_.lubrication()) scalars_[p] = resistance::pair_term(interactions_.hydrodynamics, radius_[i], radius_[j], gap_begin_[p]);
    }
  if (path_) begin_path();
}

void StepAssembly::pair_terms(int chunk, solve::PairSystem& system, double* rhs) const {
  const int D = system.unknowns_per_particle();
  const std::size_t begin = topology_.pair_begin(chunk), end = topology_.pair_begin(chunk + 1);
  std::vector<double>&force = force_[chunk], &stiffness = stiffness_[chunk];
  std::fill(force.begin(), force.end(), 0.0);
  std::fill(stiffness.begin(), stiffness.end(), 0.0);
  if (path_) {
    if (!resistance_only_) path_forces(chunk, force, stiffness);
  } else {
    for (const auto& law : laws_) law->add(std::span(geometry_).subspan(begin, end - begin), force, stiffness);
  }
  solve::FullPairs& full = system.full[chunk];
  solve::SqueezePairs& squeeze = system.squeeze[chunk];
  full.clear();
  squeeze.clear();
  const double mu = liquid_.viscosity;
  for (std::size_t p = begin; p < end; ++p) {
    const auto [i, j] = pairs_[p];
    const Vec3& n = normal_[p];
    const double k = implicit_ ? std::max(stiffness[p - begin], 0.0) : 0, guess = geometry_[p].gap;
    double f = force[p - begin] + (path_ && !path_force_ ? 0 : k * (guess - gap_begin_[p] - turn_[p]));
    const std::int32_t target = topology_.target(p);
    const double at = resistance_gap_[p];
    if (path_resistance_ && passes_ > 0 && interactions_.lubrication())
      scalars_[p] = resistance::pair_term(interactions_.hydrodynamics, radius_[i], radius_[j], at);
    const resistance::PairScalars& s = scalars_[p];
    double viscous = s.squeeze;
    if ((newton_ || path_resistance_) && viscous > 0 && guess != gap_begin_[p] && guess > 0 && gap_begin_[p] > 0) {
      const forces::PairGeometry& g = geometry_[p];
      const double weight = squeeze_weight(p);
      const resistance::SqueezeStep step = resistance::squeeze_step(g.reduced_radius(), gap_begin_[p], guess, at);
      viscous += weight * step.coefficient;
      f += mu * weight * (step.impulse - resistance::squeeze_constant(g.reduced_radius()) * turn_[p] / guess) / dt_;
    }
    if (f != 0)
      for (int d = 0; d < 3; ++d) {
        rhs[static_cast<std::size_t>(i) * D + d] -= f * n[d];
        rhs[static_cast<std::size_t>(target) * D + d] += f * n[d];
      }
    const double total = mu * viscous + dt_ * k;
    if (s.shear > 0) {
      const auto o = resistance::operator_scalars(s, radius_[i], radius_[j]);
      full.push_back({i, j, target, {n[0], n[1], n[2]}, radius_[i] + 0.5 * at, radius_[j] + 0.5 * at,
                      total, mu * o.twist, mu * o.a, mu * o.b, mu * o.c});
    } else if (total > 0) {
      squeeze.push_back({i, j, target, {n[0], n[1], n[2]}, total});
    }
  }
}

void StepAssembly::build_resistance(solve::PairSystem& system) {
  resistance_only_ = true;
  build(system);
  resistance_only_ = false;
}

void StepAssembly::build(solve::PairSystem& system) const {
  const std::size_t n = radius_.size();
  const int chunks = topology_.chunks().count();
  system.rotation = interactions_.rotation();
  system.topology = &topology_;
  system.particle.resize(n);
  if (flow_) system.mean_flow = flow_->term();
  system.full.resize(chunks);
  system.squeeze.resize(chunks);
  system.own.resize(rough_ ? chunks : 0);
  for (auto& blocks : system.own) blocks.clear();
  const std::size_t D = system.unknowns_per_particle();
  const std::size_t halo = topology_.first_slot();
  std::vector<double> sum((halo + topology_.halo_count()) * D);
  system.held.assign(interactions_.free_surface ? n : 0, 0);
  system.held_velocity.assign(interactions_.free_surface ? n : 0, 0.0);
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (int c = 0; c < chunks; ++c) {
      for (std::size_t h = (halo + topology_.halo_begin(c)) * D; h < (halo + topology_.halo_begin(c + 1)) * D; ++h) sum[h] = 0;
      particle_terms(c, system, sum.data());
      pair_terms(c, system, sum.data());
    }
#pragma omp for schedule(static)
    for (int c = 0; c < chunks; ++c)
      for (int k = topology_.chunks().begin[c]; k < topology_.chunks().begin[c + 1]; ++k)
        for (const std::int32_t* slot = topology_.slots_begin(k); slot != topology_.slots_end(k); ++slot)
          for (std::size_t d = 0; d < D; ++d) sum[k * D + d] += sum[(halo + *slot) * D + d];
  }
  sum.resize(n * D);
  system.right_hand_side = std::move(sum);
}

void StepAssembly::gap_velocities(const std::vector<double>& u, std::vector<double>& rate) const {
  const std::size_t D = interactions_.rotation() ? 6 : 3;
  rate.resize(pairs_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const auto [i, j] = pairs_[p];
    double sum = 0;
    for (int d = 0; d < 3; ++d) sum += normal_[p][d] * (u[j * D + d] - u[i * D + d]);
    rate[p] = sum;
  }
}

GapCheck StepAssembly::refine(const solve::PairSystem& system, const std::vector<double>& u, double scale) {
  const std::size_t D = interactions_.rotation() ? 6 : 3;
  const int chunks = topology_.chunks().count();
  std::vector<GapCheck> checks(chunks);
  std::vector<double> row;
  double pressure = 0;
  const bool undecided = passes_ >= 6;
  if (interactions_.free_surface) {
    solve::apply(system, u, row);
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < radius_.size(); ++k) {
      const bool is_held = protrusion_guess_[k] == held;
      protrusion_end_[k] = is_held ? 0 : position_[k].z() + dt_ * u[k * D + 2] + radius_[k] + interactions_.free_surface->roughness - surface_end_;
      // What the row leaves is the force that keeps the particle at the surface.
      if (is_held) holding_force_[k] = system.right_hand_side[k * D + 2] - row[k * D + 2];
    }
    if (interactions_.pressure_limited()) pressure = surface_pressure(u);
  }
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c) {
    GapCheck& check = checks[c];
    check.smallest_gap = std::numeric_limits<double>::infinity();
    if (path_) follow_path(c, u, check);
    for (std::size_t p = topology_.pair_begin(c); p < topology_.pair_begin(c + 1) && !path_; ++p) {
      const auto [i, j] = pairs_[p];
      Vec3 d = normal_[p] * (gap_begin_[p] + radius_[i] + radius_[j]);
      double along = 0;
      for (int q = 0; q < 3; ++q) {
        const double moved = dt_ * (u[j * D + q] - u[i * D + q]);
        d[q] += moved;
        along += normal_[p][q] * moved;
      }
      const double gap = d.norm() - radius_[i] - radius_[j];
      if (newton_) turn_[p] = gap - gap_begin_[p] - along;
      if (gap < check.smallest_gap) {
        check.smallest_gap = gap;
        check.worst_pair = p;
      }
      double& guess = geometry_[p].gap;
      if (gap_begin_[p] > 0 && gap <= 0) check.crossed = true;
      // A pair that overlapped from the start has no gap to keep open; its forces part it.
      if (gap_begin_[p] <= 0 || !newton_) continue;
      if (off_guess(gap, guess, guess != gap_begin_[p])) {
        const double missed = (gap - guess) / (std::max(gap, 0.0) + scale);
        check.miss += missed * missed;
        const StepForce force = pair_step_force(p);
        const double next = next_gap(gap, guess, force.tangent(gap), force);
        guess = bracket_[p].take(next, guess);
        check.refine = true;
      }
    }
    const bool pairs_refine = std::exchange(check.refine, false);
    for (int k = topology_.chunks().begin[c]; k < topology_.chunks().begin[c + 1]; ++k) {
      const double z = position_[k].z() + dt_ * u[k * D + 2], a = radius_[k];
      if (rough_) {
        const Vec3 end = position_[k] + dt_ * Vec3(u[k * D], u[k * D + 1], u[k * D + 2]);
        rough_->refine(k, laws_, liquid_.viscosity, dt_, end, newton_, check.refine, check.crossed);
      } else if (interactions_.substrate && !path_) {
        const double gap = z - a, begin = position_[k].z() - a;
        double& guess = substrate_geometry_[k].gap;
        if (interactions_.lubrication() && begin > 0) {
          if (gap <= 0) check.crossed = true;
          if (newton_ && off_guess(gap, guess, guess != begin)) {
            const StepForce force = substrate_step_force(k);
            guess = next_gap(gap, guess, force.tangent(gap), force);
            check.refine = true;
          }
        } else if ((gap < 0) != (guess < 0)) {
          guess = gap;
          check.refine = true;
        }
      }
      if (interactions_.free_surface) {
        const double protrusion = z + a + interactions_.free_surface->roughness - surface_end_;
        double& guess = protrusion_guess_[k];
        const double before = guess;
        if (guess == held) {
          if (holding_force_[k] < (undecided ? -weak_hold : 0)) guess = 0;  // the surface lets go
          else if (holding_force_[k] > forces::rigid_load(*interactions_.free_surface, a)) guess = 2 * forces::rigid_protrusion;
        } else if (guess > 0) {
          const forces::SpringForce spring = forces::lifted_spring(*interactions_.free_surface, a, guess);
          const double taken = spring.force + spring.stiffness * (protrusion - guess);
          const double true_force = forces::lifted_spring(*interactions_.free_surface, a, protrusion).force;
          if (protrusion <= 0) guess = held;
          // 1e-4 pN is a thousandth of the drag that a drying surface puts on the smallest particle. The force rises ever more slowly with
          // the height: Newton's method from below comes nearer without overshooting, so what left the constant part begins at its end.
          else if (std::abs(true_force - taken) > 1e-3 * taken + 1e-4)
            guess = guess < forces::rigid_protrusion && protrusion > forces::rigid_protrusion ? forces::rigid_protrusion : protrusion;
        } else if (protrusion > (undecided ? forces::rigid_protrusion : 0)) {
          guess = held;  // caught
        }
        if (guess != before) check.refine = true;
      }
    }
    check.only_pairs = !check.refine;
    check.refine = check.refine || pairs_refine;
  }
  if (path_resistance_ && flow_) follow_flow(u);
  ++passes_;
  GapCheck all = checks[0];
  for (std::size_t c = 1; c < checks.size(); ++c) all.miss += checks[c].miss;
  for (const GapCheck& check : checks) {
    all.refine = all.refine || check.refine;
    all.crossed = all.crossed || check.crossed;
    all.only_pairs = all.only_pairs && check.only_pairs;
    if (check.smallest_gap < all.smallest_gap) {
      all.smallest_gap = check.smallest_gap;
      all.worst_pair = check.worst_pair;
    }
  }
  // Once the rest agrees at this height of the surface.
  if (interactions_.pressure_limited() && !all.refine && !all.crossed && !search_.settle(pressure)) {
    surface_end_ = search_.height();
    all.refine = true;
  }
  all.surface_height = surface_end_;
  return all;
}

double StepAssembly::rough_gap(const Vec3& position, double radius) const {
  return rough_ ? rough_->gap(position, radius) : std::numeric_limits<double>::infinity();
}

StepForce StepAssembly::pair_step_force(std::size_t p) const {
  const forces::PairGeometry& g = geometry_[p];
  StepForce f{laws_, g, gap_begin_[p]};
  f.turn = turn_[p];
  const resistance::PairScalars& s = scalars_[p];
  if (s.squeeze > 0) {
    const double singular = liquid_.viscosity * squeeze_weight(p) * resistance::squeeze_constant(g.reduced_radius()) / dt_;
    f.singular = singular;
    f.linear = liquid_.viscosity * s.squeeze / dt_ - singular / resistance_gap_[p];
  }
  return f;
}

double StepAssembly::squeeze_weight(std::size_t p) const {
  const forces::PairGeometry& g = geometry_[p];
  return resistance::taper(resistance_gap_[p] / std::min(g.radius_a, g.radius_b), interactions_.hydrodynamics.taper.squeeze_begin,
                           interactions_.hydrodynamics.taper.squeeze_end);
}

double StepAssembly::pair_force(std::size_t p) const {
  double force = 0;
  for (const auto& law : laws_) force += law->switched(geometry_[p]).force;
  return force;
}

}  // namespace pigment::assembly
