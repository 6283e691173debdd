// What a solution of the linear system says of the step: how far its gaps came out from those that it was linearised about, and where
// Newton's method goes on.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "assembly/step_assembly.h"
#include "forces/surface_spring.h"

namespace pigment::assembly {

namespace {

// Particles that neither touch the surface nor leave it may be held in one pass and free in the next for ever. After some passes one
// stays as it is that the surface holds back by less than kT/nm, or that sticks out by less than a tenth of an atom.
constexpr double weak_hold = 4;  // pN
constexpr int unsure = 3;  // passes after which the load that held a particle no longer foretells its height

// Newton's method ends where what its linearisation left is this share of the step's tolerance, no gap being further from its guess (but see right_share). A
// hundredth took a quarter more passes, whose solves had next to nothing to do.
constexpr double linearisation_share = 0.05, linear_range = 0.3;
// A gap may be further off if its linear law is wrong there by less than this share of the force: contacts that open and close in a jam cross
// a wide barrier, where the force hardly changes.
constexpr double right_share = 0.1;

// Splitting alone: where a gap began further than this, its last motion foretells where it comes to, if not as near as it would if it were
// alone: clusters hold most particles a few nanometres off each other. Nearer ones fall together faster than they came.
constexpr double falling = 6e-4;       // um
constexpr double furthest_turn = 0.9;  // cosine

// Where an axis's turning changes a gap by more than this share of the scale, the axis half-way is taken. Forces belong along that at the
// step's end, and half-way axes make a step of second order one of first: from a hundredth on a layer (HLL, 30 um) had 4 % more surface
// pressure at 0.3 s, from a twentieth on 2 %, as with none. In a jam of charged particles they save a fifth of the passes. Splitting is of
// first order anyhow.
constexpr double finest_turn = 0.01, least_turn = 0.05;
constexpr int most_usual_passes = 4;  // a step that needs more has axes turned from finest_turn on

// Takes down that a gap came out off its guess. share: of its force, by which the linear law is wrong there; moved: by how much the gap
// changes in the step, um. A pair that is off by a share of the force that others balance moves them by that share of the length over which
// theirs change e-fold, and what is off balance moves by that share of its motion.
void miss(GapCheck& check, double gap, double guess, double scale, double share, double moved) {
  const double missed = (gap - guess) / (std::max(gap, 0.0) + scale), off = std::abs(gap - guess) / guess;
  const double left = std::min(0.5 * off * std::abs(missed), share * (scale + moved) / (std::max(gap, 0.0) + scale));
  check.miss += missed * missed;
  check.linearisation += left * left;
  check.farthest = std::max(check.farthest, off);
  if (off <= linear_range || share < right_share) return;
  check.far = true;
  check.deep = check.deep || gap < guess;
}

// By which share of itself the force at a gap is off its linear law; all of it where there is no such gap.
double wrong_share(const StepForce& force, double gap, double tangent) {
  if (gap <= 0) return 1;
  const double there = force(gap);
  return std::abs(there - tangent) / std::max({std::abs(there), std::abs(tangent), 1e-300});
}

}  // namespace

void StepAssembly::foretell(const std::vector<double>& u) {
  if (!split_) return;
  const std::size_t D = interactions_.rotation() ? 6 : 3;
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (gap_begin_[p] <= 0) continue;
    const auto [i, j] = pairs_[p];
    const double contact = radius_[i] + radius_[j];
    Vec3 d = separation_[p];
    for (int q = 0; q < 3; ++q) d[q] += dt_ * (u[j * D + q] - u[i * D + q]);
    if (gap_begin_[p] > falling && guess_[p] < gap_begin_[p])
      guess_[p] = std::max(guess_[p], std::clamp(d.norm() - contact, largest_fall * gap_begin_[p], gap_begin_[p]));
    // Of the axis the direction alone is taken: spheres as far apart as they are, about which half-way axes leave no turn (refine). A velocity
    // that would carry one round the other is no guess.
    d *= separation_[p].norm() / d.norm();
    if (d.dot(separation_[p]) > furthest_turn * contact * contact) normal_[p] = (separation_[p] + d).normalized();
  }
}

std::vector<double> StepAssembly::in_fours(const std::vector<double>& u) const {
  const std::size_t D = interactions_.rotation() ? 6 : 3;
  std::vector<double> four(4 * radius_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < radius_.size(); ++k) std::copy_n(&u[k * D], 3, &four[4 * k]);
  return four;
}

void StepAssembly::move_pairs(const std::vector<double>& velocity, std::size_t first, std::size_t count, double* gap, double* along) const {
  const auto pairs = std::span(pairs_).subspan(first, count);
  const auto normal = std::span<const Vec3>(normal_).subspan(first, count);
  if (newton_)
    moved_gaps(velocity.data(), dt_, sphere_, pairs, std::span<const Vec3>(separation_).subspan(first, count), normal, std::span(gap, count), std::span(along, count));
  else
    moved_gaps(velocity.data(), dt_, sphere_, pairs, std::span<const double>(gap_begin_).subspan(first, count), normal, std::span(gap, count), std::span(along, count));
}

GapCheck StepAssembly::refine(const solve::PairSystem& system, const std::vector<double>& u, double scale, double tolerance) {
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
  const std::vector<double> velocity = path_ ? std::vector<double>() : in_fours(u);
  // Axes follow the mean of the passes: a particle about to tear swings round its bonds, or a loose one round those that hold it, which
  // lengthens their gaps, which throws it back by as much the next time.
  if (newton_ && passes_ == 0) {
    swing_ = velocity;
  } else if (newton_) {
#pragma omp parallel for schedule(static)
    for (std::size_t q = 0; q < swing_.size(); ++q) swing_[q] = 0.5 * (swing_[q] + velocity[q]);
  }
#pragma omp parallel for schedule(static)
  for (int c = 0; c < chunks; ++c) {
    GapCheck& check = checks[c];
    check.smallest_gap = std::numeric_limits<double>::infinity();
    if (path_) follow_path(c, u, check);
    double gaps[law_pairs], motion[law_pairs];  // at the step's end, along the normal
    for (std::size_t p = topology_.pair_begin(c); p < topology_.pair_begin(c + 1) && !path_; ++p) {
      const std::size_t at_hand = (p - topology_.pair_begin(c)) % law_pairs, count = std::min(law_pairs, topology_.pair_begin(c + 1) - p);
      if (!newton_) {
        // Nothing is to be found but the smallest gap, and most pairs are too far apart to have it.
        if (at_hand == 0) least_gaps(velocity.data(), dt_, std::span(pairs_).subspan(p, count), std::span<const double>(gap_begin_).subspan(p, count), std::span<const Vec3>(normal_).subspan(p, count), std::span(gaps, count));
        if (gaps[at_hand] > std::max(check.smallest_gap, 0.0)) continue;
        move_pairs(velocity, p, 1, &gaps[at_hand], &motion[at_hand]);
      } else if (at_hand == 0) {
        move_pairs(velocity, p, count, gaps, motion);
      }
      const double gap = gaps[at_hand], along = motion[at_hand];
      // What the linear law's force belongs to: not the gap itself, where the axis turned otherwise than the last pass had it.
      const double linear_gap = newton_ ? gap_from(p) + along + turn_[p] : gap;
      if (newton_) turn_[p] = gap - gap_from(p) - along;
      if (newton_ && std::abs(turn_[p]) > (split_ || passes_ >= most_usual_passes ? finest_turn : least_turn) * scale) {
        const auto [i, j] = pairs_[p];
        Vec3 d = separation_[p];
        for (int q = 0; q < 3; ++q) d[q] += dt_ * (swing_[4 * j + q] - swing_[4 * i + q]);
        // The axis half-way: along it the gap changes by what the spheres move, but for a term of fourth order.
        normal_[p] = (separation_[p] + d).normalized();
        turn_[p] = d.norm() - radius_[i] - radius_[j] - gap_from(p) - normal_[p].dot(d - separation_[p]);
      }
      if (gap < check.smallest_gap) {
        check.smallest_gap = gap;
        check.worst_pair = p;
      }
      double& guess = guess_[p];
      if (gap_begin_[p] > 0 && gap <= 0) check.crossed = true;
      // A pair that overlapped from the start has no gap to keep open; its forces part it.
      if (gap_begin_[p] <= 0 || !newton_) continue;
      if (off_guess(gap, guess, two_step_ || split_ || guess != gap_begin_[p])) {
        check.refine = true;
        const StepForce force = pair_step_force(c, p);
        const double tangent = force.tangent(linear_gap);
        miss(check, gap, guess, scale, split_ ? 1 : wrong_share(force, gap, tangent), std::abs(gap - gap_begin_[p]));
        guess = bracket_[c][p].take(next_gap(gap, guess, tangent, force), guess);
        least_stiffness_[p] = wall_stiffness(c, p);
      }
    }
    const bool pairs_refine = std::exchange(check.refine, false);
    bool counted_refine = false;
    for (int k = topology_.chunks().begin[c]; k < topology_.chunks().begin[c + 1]; ++k) {
      const double z = position_[k].z() + dt_ * u[k * D + 2], a = radius_[k];
      if (rough_) {
        const Vec3 end = position_[k] + dt_ * Vec3(u[k * D], u[k * D + 1], u[k * D + 2]);
        rough_->refine(k, laws_, liquid_.viscosity, dt_, end, newton_, check.refine, check.crossed);
      } else if (interactions_.substrate && !path_) {
        const double gap = z - a, begin = (two_step_ ? height_begin_[k] : position_[k].z()) - a;
        double& guess = wall_guess_[k];
        if (interactions_.lubrication() && begin > 0) {
          if (gap <= 0) check.crossed = true;
          if (newton_ && off_guess(gap, guess, two_step_ || split_ || guess != begin)) {
            const StepForce force = substrate_step_force(k);
            const double tangent = force.tangent(gap);
            miss(check, gap, guess, scale, split_ ? 1 : wrong_share(force, gap, tangent), std::abs(gap - begin));
            guess = next_gap(gap, guess, tangent, force);
            counted_refine = true;
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
        const forces::FreeSurfaceParameters& surface = *interactions_.free_surface;
        double wrong = 0, sticks_out = 0;  // pN, um: what is left if this is not put right
        double load = 0;                   // pN, that presses it against others
        if (guess == held) {
          if (holding_force_[k] < (undecided ? -weak_hold : 0)) {
            guess = 0;  // the surface lets go
            wrong = holding_force_[k];
          } else if (const double rigid = forces::rigid_load(surface, a); holding_force_[k] > rigid) {
            load = holding_force_[k];
            // Where it is not the load that is given, but how far the particle comes, this may be far off: if so, from below.
            guess = passes_ < unsure ? forces::lifted_height(surface, a, load) : 2 * forces::rigid_protrusion;
            wrong = load - rigid;
          }
        } else if (guess > 0) {
          const forces::SpringForce spring = forces::lifted_spring(surface, a, guess);
          const double taken = spring.force + spring.stiffness * (protrusion - guess);
          const bool loaded = taken > forces::rigid_load(surface, a);
          if (loaded) load = taken;
          if (protrusion <= 0 && !loaded) {
            guess = held;
            wrong = std::min(taken, 0.0);
          } else {
            wrong = forces::lifted_spring(surface, a, std::max(protrusion, 0.0)).force - taken;
            // What is pressed with a given load comes to where the spring has it, what is pressed to a given height stands there, and the arc,
            // which rises ever more slowly, would have Newton's method from above bring the first below the surface, from far below in many
            // small steps. 1e-4 pN is a thousandth of the drag that a drying surface puts on the smallest particle.
            if (protrusion <= 0) guess = forces::lifted_height(surface, a, taken);
            else if (loaded && protrusion < 0.5 * guess) guess = std::sqrt(protrusion * forces::lifted_height(surface, a, taken));
            else if (std::abs(wrong) > 1e-3 * std::abs(taken) + 1e-4) guess = protrusion;
          }
        } else if (protrusion > (undecided ? forces::rigid_protrusion : 0)) {
          guess = held;  // caught
          holding_force_[k] = 0;
          sticks_out = protrusion;
        }
        if (guess != before) {
          // What is wrong moves a particle against its drag; one that is pressed against others, whose forces change e-fold within the scale,
          // only as far as this share of its load changes their gaps.
          double moves = dt_ * std::abs(wrong) / (6 * std::numbers::pi * liquid_.viscosity * a);
          if (load > 0) moves = std::min(moves, std::abs(wrong) / load * (scale + std::abs(film_.height_begin - surface_end_)));
          const double left = (moves + sticks_out) / scale;
          check.linearisation += left * left;
          (interactions_.pressure_limited() ? check.refine : counted_refine) = true;
        }
      }
    }
    check.counted = !check.refine;
    check.only_pairs = check.counted && !counted_refine;
    check.refine = check.refine || counted_refine || pairs_refine;
  }
  if (path_resistance_ && flow_) follow_flow(u);
  ++passes_;
  GapCheck all = checks[0];
  for (std::size_t c = 1; c < checks.size(); ++c) {
    all.miss += checks[c].miss;
    all.linearisation += checks[c].linearisation;
    all.farthest = std::max(all.farthest, checks[c].farthest);
  }
  for (const GapCheck& check : checks) {
    all.refine = all.refine || check.refine;
    all.crossed = all.crossed || check.crossed;
    all.deep = all.deep || check.deep;
    all.far = all.far || check.far;
    all.counted = all.counted && check.counted;
    all.only_pairs = all.only_pairs && check.only_pairs;
    if (check.smallest_gap < all.smallest_gap) {
      all.smallest_gap = check.smallest_gap;
      all.worst_pair = check.worst_pair;
    }
  }
  const double left = std::sqrt(all.linearisation / static_cast<double>(radius_.size()));
  if (newton_ && all.counted && !all.crossed && !all.far && left < linearisation_share * tolerance) all.refine = false;
  // Once the rest agrees at this height of the surface.
  if (interactions_.pressure_limited() && !all.refine && !all.crossed && !search_.settle(pressure)) {
    surface_end_ = search_.height();
    all.refine = true;
  }
  all.surface_height = surface_end_;
  return all;
}

}  // namespace pigment::assembly
