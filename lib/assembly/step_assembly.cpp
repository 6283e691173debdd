#include "assembly/step_assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

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
    substrate_geometry_.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      substrate_geometry_[k] = {0, radius_[k], std::numeric_limits<double>::infinity(), potential_[k],
                                interactions.substrate->surface_potential.value_or(potential_[k])};
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
  position_.resize(n);
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
  bracket_.assign(newton_ ? pairs_.size() : 0, GapBracket{});
  turn_.assign(newton_ ? pairs_.size() : 0, 0.0);
  const std::size_t n = radius_.size();
  external_force_.resize(force.empty() ? 0 : n);
  const int chunks = topology_.chunks().count();
  const auto squeeze_from = [&](double gap, double gap_before) { return gap * std::exp(two_step->share * std::log(gap / gap_before)); };
  if (two_step_) {
    height_begin_.resize(n);
    wall_squeeze_from_.resize(n);
  }
  if (two_step_ || split_) separation_.resize(pairs_.size());
  if (two_step_) squeeze_from_.resize(pairs_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < n; ++k) {
    position_[k] = (two_step_ ? two_step->from : position)[order_[k]];
    resistance_height_[k] = (two_step_ ? two_step->predicted : position)[order_[k]].z();
    if (!force.empty()) external_force_[k] = force[order_[k]];
    if (interactions_.free_surface) protrusion_guess_[k] = protrusion[order_[k]];
    if (interactions_.substrate && !rough_) substrate_geometry_[k].gap = position_[k].z() - radius_[k];
    if (two_step_ && interactions_.substrate) {
      const double a = radius_[k], z = height_begin_[k] = position[order_[k]].z(), gap = z - a, gap_before = two_step->before[order_[k]].z() - a;
      if (gap <= 0 || gap_before <= 0 || !interactions_.lubrication()) {
        resistance_height_[k] = z;
        wall_squeeze_from_[k] = gap;
        continue;
      }
      wall_squeeze_from_[k] = squeeze_from(gap, gap_before);
      substrate_geometry_[k].gap = std::max(resistance_height_[k] - a, largest_fall * gap);
      resistance_height_[k] = a + substrate_geometry_[k].gap;
    }
  }
  std::vector<TwoStepPoint> points(two_step_ ? n : 0);
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::int32_t i = order_[k];
    points[k] = {position[i], two_step->before[i], two_step->predicted[i]};
  }
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
    for (std::size_t p = topology_.pair_begin(c); p < topology_.pair_begin(c + 1); ++p) {
      const auto [i, j] = pairs_[p];
      if (two_step_) {
        begin_two_step(c, p, points[i], points[j], two_step->share);
        continue;
      }
      const Vec3 d = cell_.minimum_image(position_[j] - position_[i]);
      const double r = d.norm();
      normal_[p] = d / r;
      if (split_) separation_[p] = d;
      gap_begin_[p] = guess_[p] = resistance_gap_[p] = r - radius_[i] - radius_[j];
      if (interactions_.lubrication()) set_scalars(c, p, resistance::pair_term(interactions_.hydrodynamics, radius_[i], radius_[j], gap_begin_[p]));
    }
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
      for (std::size_t k = 0; k < n; ++k) substrate_standing_force_[k] += law->switched(substrate_geometry_[k]).force;
  if (!interactions_.lubrication()) return;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < n; ++k)
    if (substrate_standing_force_[k] < 0 && substrate_geometry_[k].gap > 0)
      substrate_geometry_[k].gap = gap_alone(substrate_step_force(static_cast<int>(k)), substrate_geometry_[k]);
}

void StepAssembly::begin_two_step(int chunk, std::size_t p, const TwoStepPoint& a, const TwoStepPoint& b, double share) {
  const auto [i, j] = pairs_[p];
  const double contact = radius_[i] + radius_[j];
  // One image throughout: a pair whose nearest image changes within two steps is nowhere near.
  const Vec3 now = b.now - a.now, image = cell_.minimum_image(now) - now;
  const Vec3 from = position_[j] - position_[i] + image, predicted = b.predicted - a.predicted + image;
  const double r = predicted.norm(), gap = (now + image).norm() - contact, gap_before = (b.before - a.before + image).norm() - contact;
  separation_[p] = from;
  normal_[p] = predicted / r;
  gap_begin_[p] = gap;
  turn_[p] = normal_[p].dot(from) - from.norm();
  double guess = r - contact;
  if (gap > 0) guess = std::max(guess, largest_fall * gap);
  guess_[p] = resistance_gap_[p] = guess;
  squeeze_from_[p] = guess;
  if (!interactions_.lubrication()) return;
  set_scalars(chunk, p, resistance::pair_term(interactions_.hydrodynamics, radius_[i], radius_[j], guess));
  if (squeeze_[p] > 0) squeeze_from_[p] = gap > 0 && gap_before > 0 ? gap * std::exp(share * std::log(gap / gap_before)) : 0;
}

void StepAssembly::set_scalars(int chunk, std::size_t p, const resistance::PairScalars& scalars) {
  squeeze_[p] = scalars.squeeze;
  if (scalars.shear > 0) near_[chunk].push_back({static_cast<std::int32_t>(p), scalars});
}

forces::PairGeometry StepAssembly::geometry(std::size_t p) const {
  const auto [i, j] = pairs_[p];
  return {guess_[p], radius_[i], radius_[j], potential_[i], potential_[j]};
}

double StepAssembly::gap_from(std::size_t p) const {
  return two_step_ ? separation_[p].norm() - (radius_[pairs_[p].i] + radius_[pairs_[p].j]) : gap_begin_[p];
}

void StepAssembly::add_laws(std::size_t begin, std::size_t end, Laws which, std::span<double> force, std::span<double> stiffness) const {
  forces::PairGeometry at[law_pairs];
  for (std::size_t p = begin; p < end; ++p) at[p - begin] = geometry(p);
  for (const auto& law : laws_)
    if (which == Laws::All || law->concave() == (which == Laws::Concave)) law->add(std::span(at, end - begin), force, stiffness);
}

void StepAssembly::add_laws(std::size_t begin, std::size_t end, std::span<forces::PairTerm> sum) const {
  forces::PairGeometry at[law_pairs];
  for (std::size_t p = begin; p < end; ++p) at[p - begin] = geometry(p);
  for (const auto& law : laws_) law->add(std::span(at, end - begin), sum);
}

void StepAssembly::pair_terms(int chunk, solve::PairSystem& system, double* rhs) const {
  const int D = system.unknowns_per_particle();
  const std::size_t begin = topology_.pair_begin(chunk), end = topology_.pair_begin(chunk + 1);
  double force[law_pairs], stiffness[law_pairs];
  solve::FullPairs& full = system.full[chunk];
  solve::SqueezePairs& squeeze = system.squeeze[chunk];
  const auto resisting = static_cast<std::size_t>(std::count_if(squeeze_.begin() + static_cast<std::ptrdiff_t>(begin),
                                                                squeeze_.begin() + static_cast<std::ptrdiff_t>(end), [](double k) { return k > 0; }));
  full.restart(near_[chunk].size());
  squeeze.restart(resisting - std::min(resisting, near_[chunk].size()));
  const double mu = liquid_.viscosity;
  auto near = near_[chunk].begin();
  for (std::size_t p = begin; p < end; ++p) {
    const std::size_t at_hand = (p - begin) % law_pairs;
    if (at_hand == 0) {
      const std::size_t last = std::min(p + law_pairs, end), count = last - p;
      if (split_) std::copy_n(standing_force_[chunk].begin() + static_cast<std::ptrdiff_t>(p - begin), count, force);
      else std::fill_n(force, count, 0.0);
      std::fill_n(stiffness, count, 0.0);
      if (!path_) add_laws(p, last, split_ ? Laws::NotConcave : Laws::All, std::span(force, count), std::span(stiffness, count));
      else if (!resistance_only_) path_forces(p, last, std::span(force, count), std::span(stiffness, count));
      if (path_) std::copy_n(force, count, mean_force_.begin() + static_cast<std::ptrdiff_t>(p));
    }
    const auto [i, j] = pairs_[p];
    const Vec3& n = normal_[p];
    const double k = implicit_ ? std::max(stiffness[at_hand], 0.0) : 0, guess = guess_[p], turn = newton_ ? turn_[p] : 0, from = gap_from(p);
    double f = force[at_hand] + (path_ && !path_force_ ? 0 : k * (guess - from - turn));
    const std::int32_t target = topology_.target(p);
    const double at = resistance_gap_[p];
    resistance::PairScalars s{squeeze_[p]};
    const bool listed = near != near_[chunk].end() && near->pair == static_cast<std::int32_t>(p);
    if (listed) s = (near++)->scalars;
    if (path_resistance_ && passes_ > 0 && interactions_.lubrication()) {
      s = resistance::pair_term(interactions_.hydrodynamics, radius_[i], radius_[j], at);
      squeeze_[p] = s.squeeze;
    }
    const double reduced_radius = radius_[i] * radius_[j] / (radius_[i] + radius_[j]);
    double viscous = s.squeeze;
    if (two_step_) {
      if (viscous > 0 && squeeze_from_[p] > 0 && guess > 0) {
        const double c = resistance::squeeze_constant(reduced_radius), weight = squeeze_weight(p);
        viscous += weight * c * (1 / guess - 1 / at);
        f += mu * weight * c * (std::log(squeeze_from_[p] / guess) + (guess - from - turn) / guess) / dt_;
      }
    } else if ((newton_ || path_resistance_) && viscous > 0 && guess != gap_begin_[p] && guess > 0 && gap_begin_[p] > 0) {
      const double weight = squeeze_weight(p);
      const resistance::SqueezeStep step = resistance::squeeze_step(reduced_radius, gap_begin_[p], guess, at);
      viscous += weight * step.coefficient;
      f += mu * weight * (step.impulse - resistance::squeeze_constant(reduced_radius) * turn / guess) / dt_;
    }
    if (f != 0)
      for (int d = 0; d < 3; ++d) {
        rhs[static_cast<std::size_t>(i) * D + d] -= f * n[d];
        rhs[static_cast<std::size_t>(target) * D + d] += f * n[d];
      }
    const double total = mu * viscous + dt_ * k;
    if (split_ || two_step_) memory_[p] = total > 0 ? mu * viscous / total : 1;
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

double StepAssembly::rough_gap(const Vec3& position, double radius) const {
  return rough_ ? rough_->gap(position, radius) : std::numeric_limits<double>::infinity();
}

StepForce StepAssembly::pair_step_force(int chunk, std::size_t p) const {
  const forces::PairGeometry g = geometry(p);
  StepForce f{laws_, g, gap_from(p), squeeze_from(p)};
  f.turn = turn_[p];
  f.split = split_;
  if (split_) f.standing = standing_force_[chunk][p - topology_.pair_begin(chunk)];
  if (!(f.squeeze_from > 0)) {
    f.squeeze_from = g.gap;
  } else if (squeeze_[p] > 0) {
    const double singular = liquid_.viscosity * squeeze_weight(p) * resistance::squeeze_constant(g.reduced_radius()) / dt_;
    f.singular = singular;
    f.linear = liquid_.viscosity * squeeze_[p] / dt_ - singular / resistance_gap_[p];
  }
  return f;
}

// Where the pair would come to if it were alone.
double StepAssembly::gap_alone(StepForce force, const forces::PairGeometry& pair) const {
  force.linear += 6 * std::numbers::pi * liquid_.viscosity * pair.reduced_radius() / dt_;  // Stokes' drag on both
  const double begin = force.gap_begin;
  const bool inwards = force(begin) < 0;
  constexpr double least = 5e-5;  // um; no Born wall lets anything so near
  double from = begin, to = begin;
  for (int k = 0; k < 40 && to > least; ++k) {
    from = to;
    to *= inwards ? 0.7 : 1.4;
    if ((force(to) < 0) != inwards) break;
  }
  for (int k = 0; k < 6; ++k) {
    const double middle = std::sqrt(from * to);
    ((force(middle) < 0) == inwards ? from : to) = middle;
  }
  return std::sqrt(from * to);
}

double StepAssembly::squeeze_weight(std::size_t p) const {
  return resistance::taper(resistance_gap_[p] / std::min(radius_[pairs_[p].i], radius_[pairs_[p].j]), interactions_.hydrodynamics.taper.squeeze_begin,
                           interactions_.hydrodynamics.taper.squeeze_end);
}

double StepAssembly::pair_force(std::size_t p) const {
  double force = 0;
  for (const auto& law : laws_) force += law->switched(geometry(p)).force;
  return force;
}

}  // namespace pigment::assembly
