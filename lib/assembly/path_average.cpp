// Steps that keep what thermal noise needs: resistance and force averaged along the way from the beginning of the step to where
// it is guessed to end.
//
// Resistance. With the random force of R at the beginning and the resistance half-way between the ends of the step, the mean
// displacement holds kT div(R^-1) dt: to first order R^-1 (dR/dx . dx/2) R^-1 F averages to it, since <dx dx> = 2 kT dt R^-1
// ([fixman1978]; read the other way, this is the kinetic integral of [hutter1998]). Half-way means gaps, normals and levers; the
// singular squeeze 6 pi R^2/h is averaged exactly, c ln(h0/h1)/(h0 - h1), so that no gap crosses zero and steps that change a
// gap by its own size still have the drift.
//
// Force. -(V(h1) - V(h0))/(h1 - h0), the mean along the way (a discrete gradient, [gonzalez1996]), linearised about the guess
// of h1. The normal half-way is (r0 + r1)/|r0 + r1|, for which the work of that force is the difference of energies. A
// harmonic well has its exact variance at every step, where an implicit step cools it to kT/K/(1 + dt K/2R).
#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/step_assembly.h"
#include "forces/surface_spring.h"
#include "resistance/scene_resistance.h"

namespace pigment::assembly {

namespace {

// A pass is the last when every gap came out this near its guess, relative, or absolute (um): a fifth of the shortest length over
// which a force between surfaces changes, that of Born's repulsion. Two passes do for nearly every step then; a tenth in place of three
// costs a third one, and moves the mean gap of docs/brownian.md's pairs by 0.2 % at the default step.
constexpr double near_enough = 0.3, near_enough_at_contact = 1e-4;
// A force that does less work than this over the gap, in kT, may be taken at any guess.
constexpr double negligible_work = 1e-3;

struct MeanForce {
  double force, stiffness;  // at the guess; stiffness = -d force/d guess where that is positive
};

MeanForce mean_force(const forces::PairTerm& begin, const forces::PairTerm& end, double gap_begin, double gap_end) {
  const double change = gap_end - gap_begin;
  // Below this difference the energies' last digits would show: 1e-16 of 1 pN um over 1e-6 um is 1e-10 pN.
  if (std::abs(change) < 1e-6) return {0.5 * (begin.force + end.force), std::max(0.0, 0.5 * end.stiffness)};
  const double force = -(end.energy - begin.energy) / change;
  return {force, std::max(0.0, (force - end.force) / change)};
}

double next_guess(double gap, double guess, bool kept_open) { return kept_open ? std::max(gap, largest_fall * guess) : gap; }

}  // namespace

forces::PairTerm StepAssembly::substrate_term(const forces::PairGeometry& g) const {
  forces::PairTerm sum;
  if (interactions_.substrate->colloidal && g.gap < colloidal_reach_)
    for (const auto& law : laws_) {
      const forces::PairTerm t = law->switched(g);
      sum.energy += t.energy;
      sum.force += t.force;
      sum.stiffness += t.stiffness;
    }
  // The plane stops particles whatever the forces.
  if (g.gap < 0) {
    sum.energy += 0.5 * forces::contact_stiffness * g.gap * g.gap;
    sum.force -= forces::contact_stiffness * g.gap;
    sum.stiffness += forces::contact_stiffness;
  }
  return sum;
}

void StepAssembly::begin_path() {
  const int chunks = topology_.chunks().count();
  separation_.resize(pairs_.size());
  term_begin_.resize(pairs_.size());
  mean_force_.resize(pairs_.size());
  substrate_term_begin_.resize(wall_guess_.size());
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c) {
    const std::size_t begin = topology_.pair_begin(c), end = topology_.pair_begin(c + 1);
    for (std::size_t p = begin; p < end; ++p) {
      const auto [i, j] = pairs_[p];
      separation_[p] = normal_[p] * (gap_begin_[p] + radius_[i] + radius_[j]);
      term_begin_[p] = {};
    }
    for (std::size_t p = begin; p < end; p += law_pairs) {
      const std::size_t last = std::min(p + law_pairs, end);
      add_laws(p, last, std::span(term_begin_).subspan(p, last - p));
    }
    if (interactions_.substrate)
      for (int k = topology_.chunks().begin[c]; k < topology_.chunks().begin[c + 1]; ++k)
        substrate_term_begin_[k] = substrate_term(wall_geometry(k));
  }
}

void StepAssembly::path_forces(std::size_t begin, std::size_t end, std::span<double> force, std::span<double> stiffness) const {
  if (!path_force_ || passes_ == 0) {
    // Not moved yet: the mean force is that at the beginning, and follows the end of the step by half.
    for (std::size_t p = begin; p < end; ++p) {
      force[p - begin] = term_begin_[p].force;
      stiffness[p - begin] = (path_force_ ? 0.5 : 1.0) * term_begin_[p].stiffness;
    }
    return;
  }
  forces::PairTerm term[law_pairs] = {};
  add_laws(begin, end, std::span(term, end - begin));
  for (std::size_t p = begin; p < end; ++p) {
    const MeanForce mean = mean_force(term_begin_[p], term[p - begin], gap_begin_[p], guess_[p]);
    force[p - begin] = mean.force;
    stiffness[p - begin] = mean.stiffness;
  }
}

StepAssembly::SubstrateState StepAssembly::path_substrate_state(int k) const {
  const double begin = position_[k].z() - radius_[k], guess = wall_guess_[k];
  const forces::PairTerm& first = substrate_term_begin_[k];
  if (!path_force_) {
    const double stiffness = implicit_ ? std::max(first.stiffness, 0.0) : 0;
    return {begin, first.force - stiffness * (guess - begin), stiffness};
  }
  const MeanForce mean = mean_force(first, passes_ == 0 ? first : substrate_term(wall_geometry(k)), begin, guess);
  return {begin, mean.force, mean.stiffness};
}

void StepAssembly::follow_path(int chunk, const std::vector<double>& u, GapCheck& check) {
  const std::size_t D = interactions_.rotation() ? 6 : 3;
  // Lubrication keeps an open gap open; without it spheres may come to overlap, and their forces part them.
  const bool lubrication = interactions_.lubrication();
  const double least_work = negligible_work * liquid_.thermal_energy();
  if (passes_ == 0) check.refine = true;
  const auto judge = [&](double gap, double guess, double begin) {
    const bool crossed = begin > 0 && gap <= 0;
    if (crossed) check.crossed = true;
    const double allowed = lubrication ? near_enough * std::abs(guess) : std::max(near_enough * std::abs(guess), near_enough_at_contact);
    if (path_force_ ? std::abs(gap - guess) > allowed : crossed && lubrication) check.refine = true;
  };
  for (std::size_t p = topology_.pair_begin(chunk); p < topology_.pair_begin(chunk + 1); ++p) {
    const auto [i, j] = pairs_[p];
    Vec3 d = separation_[p];
    for (int q = 0; q < 3; ++q) d[q] += dt_ * (u[j * D + q] - u[i * D + q]);
    const double gap = d.norm() - radius_[i] - radius_[j];
    if (gap < check.smallest_gap) {
      check.smallest_gap = gap;
      check.worst_pair = p;
    }
    double& guess = guess_[p];
    const double work = std::abs(mean_force_[p] * guess);  // of the mean force to the guess
    if (squeeze_[p] > 0 || gap <= 0 || work > least_work) judge(gap, guess, gap_begin_[p]);
    guess = next_guess(gap, guess, lubrication && gap_begin_[p] > 0);
    if (!path_resistance_) continue;
    normal_[p] = (separation_[p] + d).normalized();
    resistance_gap_[p] = 0.5 * (gap_begin_[p] + guess);
  }
  for (int k = topology_.chunks().begin[chunk]; k < topology_.chunks().begin[chunk + 1]; ++k) {
    const double a = radius_[k], begin = position_[k].z() - a;
    const double z = position_[k].z() + dt_ * u[k * D + 2];
    double end = z - a;
    if (interactions_.substrate) {
      double& guess = wall_guess_[k];
      if (lubrication) {
        judge(end, guess, begin);
        end = guess = next_guess(end, guess, begin > 0);
      } else {
        if ((end < 0) != (guess < 0)) check.refine = true;
        guess = end;
      }
    }
    if (path_resistance_) resistance_height_[k] = a + 0.5 * (begin + end);
  }
}

void StepAssembly::follow_flow(const std::vector<double>& u) {
  const std::size_t D = interactions_.rotation() ? 6 : 3;
  std::vector<Vec3> middle = position_;
  for (std::size_t k = 0; k < middle.size(); ++k) middle[k].z() += 0.5 * dt_ * u[k * D + 2];
  flow_->place(middle, interactions_.free_surface ? 0.5 * (film_.height_begin + surface_end_) : 0, liquid_.viscosity, film_.absorption);
}

}  // namespace pigment::assembly
