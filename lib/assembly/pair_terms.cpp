// What acts between two particles in a step.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "assembly/step_assembly.h"
#include "resistance/scene_resistance.h"

namespace pigment::assembly {

void StepAssembly::begin_two_step(int chunk, std::size_t first, std::size_t count, const TwoStepSpheres& spheres, const TwoStep& two_step) {
  double before[law_pairs], foretold[law_pairs];
  const auto of = [&](auto& array) { return std::span(array).subspan(first, count); };
  separations(cell_, spheres, std::span(pairs_).subspan(first, count),
              {of(separation_), of(normal_), of(gap_begin_), std::span(before, count), of(gap_from_), std::span(foretold, count), of(turn_)});
  for (std::size_t p = first; p < first + count; ++p) {
    const auto [i, j] = pairs_[p];
    const double gap = gap_begin_[p], gap_before = before[p - first];
    guess_[p] = resistance_gap_[p] = foretold[p - first];
    if (gap > 0) {
      guess_[p] = first_guess(gap, foretold[p - first], two_step.range);
      resistance_gap_[p] = std::max(foretold[p - first], largest_fall * gap);
    }
    squeeze_from_[p] = resistance_gap_[p];
    least_stiffness_[p] = wall_stiffness(chunk, p);
    if (!interactions_.lubrication()) continue;
    set_scalars(chunk, p, resistance::pair_term(interactions_.hydrodynamics, radius_[i], radius_[j], resistance_gap_[p]));
    if (squeeze_[p] > 0) squeeze_from_[p] = gap > 0 && gap_before > 0 ? gap * std::exp(two_step.share * std::log(gap / gap_before)) : 0;
  }
}

void StepAssembly::set_scalars(int chunk, std::size_t p, const resistance::PairScalars& scalars) {
  squeeze_[p] = scalars.squeeze;
  if (scalars.shear > 0) near_[chunk].push_back({static_cast<std::int32_t>(p), scalars});
}

forces::PairGeometry StepAssembly::geometry(std::size_t p) const {
  const auto [i, j] = pairs_[p];
  return {guess_[p], radius_[i], radius_[j], potential_[i], potential_[j]};
}

void StepAssembly::add_laws(std::size_t begin, std::size_t end, Laws which, std::span<double> force, std::span<double> stiffness) const {
  forces::PairGeometry at[law_pairs];
  for (std::size_t p = begin; p < end; ++p) at[p - begin] = geometry(p);
  for (const auto& law : laws_)
    if (which == Laws::All || law->concave() == (which == Laws::Concave)) law->add(std::span(at, end - begin), force, stiffness);
}

void StepAssembly::add_laws(std::span<const std::int32_t> pairs, std::span<double> force, std::span<double> stiffness) const {
  forces::PairGeometry at[law_pairs];
  for (std::size_t q = 0; q < pairs.size(); ++q) at[q] = geometry(pairs[q]);
  for (const auto& law : laws_) law->add(std::span(at, pairs.size()), force, stiffness);
}

void StepAssembly::add_laws(std::size_t begin, std::size_t end, std::span<forces::PairTerm> sum) const {
  forces::PairGeometry at[law_pairs];
  for (std::size_t p = begin; p < end; ++p) at[p - begin] = geometry(p);
  for (const auto& law : laws_) law->add(std::span(at, end - begin), sum);
}

void StepAssembly::pair_terms(int chunk, solve::PairSystem& system, double* rhs) const {
  const int D = system.unknowns_per_particle();
  const std::size_t begin = topology_.pair_begin(chunk), end = topology_.pair_begin(chunk + 1);
  const std::vector<std::int32_t>& acting = acting_[chunk];
  const std::size_t count = all_act_ ? end - begin : acting.size();
  double force[law_pairs], stiffness[law_pairs];
  solve::FullPairs& full = system.full[chunk];
  solve::SqueezePairs& squeeze = system.squeeze[chunk];
  std::size_t resisting = 0;
  for (std::size_t q = 0; q < count; ++q) resisting += squeeze_[all_act_ ? begin + q : acting[q]] > 0;
  full.restart(near_[chunk].size());
  squeeze.restart(resisting - std::min(resisting, near_[chunk].size()));
  const double mu = liquid_.viscosity;
  auto near = near_[chunk].begin();
  for (std::size_t q = 0; q < count; ++q) {
    const std::size_t p = all_act_ ? begin + q : acting[q], at_hand = q % law_pairs;
    if (at_hand == 0) {
      const std::size_t some = std::min(law_pairs, count - q);
      if (split_) std::copy_n(standing_force_[chunk].begin() + static_cast<std::ptrdiff_t>(q), some, force);
      else std::fill_n(force, some, 0.0);
      std::fill_n(stiffness, some, 0.0);
      if (!all_act_) add_laws(std::span(acting).subspan(q, some), std::span(force, some), std::span(stiffness, some));
      else if (!path_) add_laws(p, p + some, split_ ? Laws::NotConcave : Laws::All, std::span(force, some), std::span(stiffness, some));
      else if (!resistance_only_) path_forces(p, p + some, std::span(force, some), std::span(stiffness, some));
      if (path_) std::copy_n(force, some, mean_force_.begin() + static_cast<std::ptrdiff_t>(p));
    }
    const bool listed = near != near_[chunk].end() && near->pair == static_cast<std::int32_t>(p);
    // Many pairs are too far apart for anything to act.
    if (!path_ && !listed && force[at_hand] == 0 && stiffness[at_hand] == 0 && squeeze_[p] == 0) {
      if (split_ || two_step_) memory_[p] = 1;
      continue;
    }
    const auto [i, j] = pairs_[p];
    const Vec3& n = normal_[p];
    const double tangent = implicit_ ? std::max(stiffness[at_hand], 0.0) : 0, k = newton_ ? std::max(tangent, least_stiffness_[p]) : tangent;
    const double guess = guess_[p], turn = newton_ ? turn_[p] : 0, from = gap_from(p);
    double f = force[at_hand] + (path_ && !path_force_ ? 0 : k * (guess - from - turn));
    const std::int32_t target = topology_.target(p);
    const double at = resistance_gap_[p];
    resistance::PairScalars s{squeeze_[p]};
    if (listed) s = (near++)->scalars;
    if (path_resistance_ && passes_ > 0 && interactions_.lubrication()) {
      s = resistance::pair_term(interactions_.hydrodynamics, radius_[i], radius_[j], at);
      squeeze_[p] = s.squeeze;
    }
    double viscous = s.squeeze;
    if (two_step_) {
      if (viscous > 0 && squeeze_from_[p] > 0 && guess > 0) {
        const double c = resistance::squeeze_constant(geometry(p).reduced_radius()), weight = squeeze_weight(p);
        viscous += weight * c * (1 / guess - 1 / at);
        f += mu * weight * c * (std::log(squeeze_from_[p] / guess) + (guess - from - turn) / guess) / dt_;
      }
    } else if ((newton_ || path_resistance_) && viscous > 0 && guess != gap_begin_[p] && guess > 0 && gap_begin_[p] > 0) {
      const double weight = squeeze_weight(p), reduced_radius = geometry(p).reduced_radius();
      const resistance::SqueezeStep step = resistance::squeeze_step(reduced_radius, gap_begin_[p], guess, at);
      viscous += weight * step.coefficient;
      f += mu * weight * (step.impulse - resistance::squeeze_constant(reduced_radius) * turn / guess) / dt_;
    }
    if (f != 0)
      for (int d = 0; d < 3; ++d) {
        rhs[static_cast<std::size_t>(i) * D + d] -= f * n[d];
        rhs[static_cast<std::size_t>(target) * D + d] += f * n[d];
      }
    const double total = mu * viscous + dt_ * k, relaxing = mu * viscous + dt_ * tangent;
    if (split_ || two_step_) memory_[p] = relaxing > 0 ? mu * viscous / relaxing : 1;
    if (s.shear > 0) {
      const auto o = resistance::operator_scalars(s, radius_[i], radius_[j]);
      full.push_back({i, j, target, {n[0], n[1], n[2]}, radius_[i] + 0.5 * at, radius_[j] + 0.5 * at,
                      total, mu * o.twist, mu * o.a, mu * o.b, mu * o.c});
    } else if (total > 0) {
      squeeze.push_back({i, j, target, {n[0], n[1], n[2]}, total});
    }
  }
}

StepForce StepAssembly::pair_step_force(int chunk, std::size_t p) const {
  const forces::PairGeometry g = geometry(p);
  StepForce f{laws_, g, gap_from(p), squeeze_from(p)};
  f.turn = turn_[p];
  f.split = split_;
  if (newton_) f.least_stiffness = least_stiffness_[p];
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

// A gap in contact that is guessed half as long again has lost its Born wall: what presses it together would then go right through the other
// particle, be let out by the next pass, and so on. So the linear law of one that opens is as stiff as
// that from where the step began.
double StepAssembly::wall_stiffness(int chunk, std::size_t p) const {
  constexpr double opens = 1.01;  // times its length: of one that hardly does the tangent is right
  const double begin = gap_begin_[p], guess = guess_[p];
  return begin > 0 && begin < contact_range && guess > opens * begin ? std::max(pair_step_force(chunk, p).mean_stiffness(begin, guess), 0.0) : 0;
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
