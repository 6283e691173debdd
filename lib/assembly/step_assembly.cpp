#include "assembly/step_assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forces/surface_spring.h"
#include "resistance/scene_resistance.h"

namespace pigment::assembly {

namespace {

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
  potential_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    radius_[k] = particles.radius[order_[k]];
    mass_[k] = particles.mass[order_[k]];
    potential_[k] = interactions.surface_potential[particles.species[order_[k]]];
  }
  if (interactions.substrate && interactions.height_field) {
    rough_.emplace(interactions, radius_, potential_);
  } else if (interactions.substrate) {
    wall_guess_.resize(n);
  }
  if (interactions.pressure_limited()) entry_pressure_ = forces::entry_pressure(*interactions.free_surface, radius_);
  if (interactions.hindered()) flow_.emplace(radius_, cell.area(), cell.height, interactions.height_field.get());
  normal_.resize(pairs_.size());
  guess_.resize(pairs_.size());
  gap_begin_.resize(pairs_.size());
  resistance_gap_.resize(pairs_.size());
  resistance_height_.resize(n);
  squeeze_.resize(pairs_.size());
  near_.resize(topology_.chunks().count());
  bracket_.resize(topology_.chunks().count());
  acting_.resize(topology_.chunks().count());
  position_.resize(n);
  sphere_.resize(n);
  protrusion_guess_.assign(n, 0.0);
  protrusion_end_.assign(n, 0.0);
  holding_force_.assign(n, 0.0);
}

void StepAssembly::begin(const Vec3Array& position, const Film& film, const Liquid& liquid, double dt, Treatment treatment,
                         const Vec3Array& force, const std::vector<double>& protrusion, const TwoStep* two_step) {
  film_ = film;
  two_step_ = two_step != nullptr;
  surface_end_ = film.height_end;
  if (interactions_.pressure_limited()) {
    const double fall = dt * (film.absorption + film.evaporation);
    search_ = SurfaceSearch(film.height_end, film.height_guess, 0.25 * std::max(fall, 1e-3 * interactions_.free_surface->roughness), entry_pressure_);
    surface_end_ = search_.height();
  }
  liquid_ = liquid;
  dt_ = dt;
  implicit_ = treatment != Treatment::Explicit && treatment != Treatment::ExplicitMidpoint;
  newton_ = treatment == Treatment::Newton || treatment == Treatment::ConvexSplitting;
  split_ = treatment == Treatment::ConvexSplitting;
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
  for (auto& brackets : bracket_) brackets.clear();
  turn_.assign(newton_ ? pairs_.size() : 0, 0.0);
  least_stiffness_.assign(turn_.size(), 0.0);
  const std::size_t n = radius_.size();
  external_force_.resize(force.empty() ? 0 : n);
  const int chunks = topology_.chunks().count();
  const auto squeeze_from = [&](double gap, double gap_before) { return gap * std::exp(two_step->share * std::log(gap / gap_before)); };
  if (two_step_) {
    height_begin_.resize(n);
    wall_squeeze_from_.resize(n);
  }
  if (newton_) separation_.resize(pairs_.size());
  if (two_step_) {
    squeeze_from_.resize(pairs_.size());
    gap_from_.resize(pairs_.size());
  }
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < n; ++k) {
    position_[k] = (two_step_ ? two_step->from : position)[order_[k]];
    sphere_[k] = {position_[k].x(), position_[k].y(), position_[k].z(), radius_[k]};
    resistance_height_[k] = (two_step_ ? two_step->predicted : position)[order_[k]].z();
    if (!force.empty()) external_force_[k] = force[order_[k]];
    if (interactions_.free_surface) protrusion_guess_[k] = protrusion[order_[k]];
    if (interactions_.substrate && !rough_) wall_guess_[k] = position_[k].z() - radius_[k];
    if (two_step_ && interactions_.substrate) {
      const double a = radius_[k], z = height_begin_[k] = position[order_[k]].z(), gap = z - a, gap_before = two_step->before[order_[k]].z() - a;
      if (gap <= 0 || gap_before <= 0 || !interactions_.lubrication()) {
        resistance_height_[k] = z;
        wall_squeeze_from_[k] = gap;
        continue;
      }
      wall_squeeze_from_[k] = squeeze_from(gap, gap_before);
      wall_guess_[k] = first_guess(gap, resistance_height_[k] - a, two_step->range);
      resistance_height_[k] = a + std::max(resistance_height_[k] - a, largest_fall * gap);
    }
  }
  // Only two-step: where particles are, were and are foretold, in engine order.
  std::vector<Sphere> now(two_step_ ? n : 0), before(now.size()), predicted(now.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < now.size(); ++k) {
    const auto sphere = [&, a = radius_[k]](const Vec3& x) { return Sphere{x.x(), x.y(), x.z(), a}; };
    now[k] = sphere(position[order_[k]]);
    before[k] = sphere(two_step->before[order_[k]]);
    predicted[k] = sphere(two_step->predicted[order_[k]]);
  }
  all_act_ = newton_ || path_ || two_step_;
  colloidal_reach_ = 0;
  for (const auto& law : laws_) colloidal_reach_ = std::max(colloidal_reach_, law->cutoff_gap());
  if (rough_) rough_->begin(position_, laws_);
  if (flow_) {
    const double height = two_step_ ? film.height_end : film.height_begin;
    if (two_step_) {
      std::vector<Vec3> predicted(n);
      for (std::size_t k = 0; k < n; ++k) predicted[k] = two_step->predicted[order_[k]];
      flow_->place(predicted, interactions_.free_surface ? height : 0, liquid.viscosity, film.absorption);
    } else {
      flow_->place(position_, interactions_.free_surface ? height : 0, liquid.viscosity, film.absorption);
    }
  }
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c) {
    near_[c].clear();
    const std::size_t first = topology_.pair_begin(c), count = topology_.pair_begin(c + 1) - first;
    if (two_step_) {
      for (std::size_t p = first; p < first + count; p += law_pairs)
        begin_two_step(c, p, std::min(law_pairs, first + count - p), {now, before, sphere_, predicted}, *two_step);
      continue;
    }
    separations(cell_, sphere_, std::span(pairs_).subspan(first, count), std::span(normal_).subspan(first, count),
                std::span(gap_begin_).subspan(first, count), newton_ ? std::span(separation_).subspan(first, count) : std::span<Vec3>());
    for (std::size_t p = first; p < first + count; ++p) guess_[p] = resistance_gap_[p] = gap_begin_[p];
    if (interactions_.lubrication())
      for (std::size_t p = first; p < first + count; ++p)
        set_scalars(c, p, resistance::pair_term(interactions_.hydrodynamics, radius_[pairs_[p].i], radius_[pairs_[p].j], gap_begin_[p]));
    if (all_act_) continue;
    // Which of them is hard to foretell: no branch.
    std::vector<std::int32_t>& acting = acting_[c];
    acting.resize(count);
    std::size_t found = 0;
    for (std::size_t p = first; p < first + count; ++p) {
      acting[found] = static_cast<std::int32_t>(p);
      found += static_cast<std::size_t>(squeeze_[p] > 0) | static_cast<std::size_t>(gap_begin_[p] < colloidal_reach_);
    }
    acting.resize(found);
  }
  wall_.clear();
  surface_.clear();
  if (path_) {
    begin_path();
  } else if (interactions_.lubrication()) {
    const bool wall = interactions_.substrate && !rough_, surface = interactions_.free_surface && !interactions_.pressure_limited();
    std::vector<resistance::BoundaryScalars> at_wall(wall ? n : 0), at_surface(surface ? n : 0);
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < n; ++k) {
      if (wall) at_wall[k] = wall_scalars(static_cast<int>(k));
      if (surface) at_surface[k] = surface_scalars(static_cast<int>(k));
    }
    wall_ = std::move(at_wall);
    surface_ = std::move(at_surface);
  }
  if (split_ || two_step_) memory_.resize(pairs_.size());
  if (!split_) return;
  standing_force_.resize(chunks);
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c) {
    const std::size_t first = topology_.pair_begin(c), count = topology_.pair_begin(c + 1) - first;
    standing_force_[c].assign(count, 0.0);
    double unused[law_pairs] = {};
    for (std::size_t p = first; p < first + count; p += law_pairs) {
      const std::size_t end = std::min(p + law_pairs, first + count);
      add_laws(p, end, Laws::Concave, std::span(standing_force_[c]).subspan(p - first, end - p), std::span(unused, end - p));
    }
    for (std::size_t p = first; p < first + count; ++p)
      if (standing_force_[c][p - first] < 0 && squeeze_[p] > 0 && gap_begin_[p] > 0) guess_[p] = gap_alone(pair_step_force(c, p), geometry(p));
  }
  if (!interactions_.substrate || rough_) return;
  substrate_standing_force_.assign(n, 0.0);
  for (const auto& law : laws_)
    if (law->concave() && interactions_.substrate->colloidal)
      for (std::size_t k = 0; k < n; ++k) substrate_standing_force_[k] += law->switched(wall_geometry(static_cast<int>(k))).force;
  if (!interactions_.lubrication()) return;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < n; ++k)
    if (substrate_standing_force_[k] < 0 && wall_guess_[k] > 0)
      wall_guess_[k] = gap_alone(substrate_step_force(static_cast<int>(k)), wall_geometry(static_cast<int>(k)));
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
  std::vector<double>& sum = system.right_hand_side;
  sum.resize((halo + topology_.halo_count()) * D);
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

double StepAssembly::rough_gap(const Vec3& position, double radius) const {
  return rough_ ? rough_->gap(position, radius) : std::numeric_limits<double>::infinity();
}

}  // namespace pigment::assembly
