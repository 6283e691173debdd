#pragma once
// How Newton's iteration moves the guess of a gap at the step's end.
#include <algorithm>
#include <cmath>
#include <limits>

namespace pigment::assembly {

// A guess falls and rises at most by these factors at a time, so that a gap that came out negative is approached from above and
// that one linearised deep inside a steep barrier is not thrown out too far. It falls further where the force asks for it (next_gap).
inline constexpr double largest_fall = 0.2, largest_rise = 3, deepest_fall = 0.02;
// Nearer than this, um, Born walls, barriers and bonds decide.
inline constexpr double contact_range = 1e-3;

// Where Newton's method begins for a gap that is foretold, not by its forces but by how it moved before. While forces are felt, the gap being
// less than eight times the range over which they change (a double layer's last pN is a drying layer's drag, six ranges off), it is held near
// where it was: a gap of 0.32 nm that was foretold at 0.06 nm had a Born wall of 1 uN there, which threw all its neighbours about, and one
// of six ranges that was foretold at ten, where nothing holds it, came out closed (a 1 nm double layer: a third of all passes).
inline double first_guess(double gap, double foretold, double range) {
  const double within = std::min(0.5 * range, 0.15 * gap), reach = 8 * range;
  foretold = std::max(foretold, largest_fall * gap);
  if (gap < reach) return std::clamp(foretold, gap - within, gap + within);
  return std::max(foretold, std::min(reach, gap - within));
}

// Whether a gap came out far from what the system was linearised about.
inline bool off_guess(double gap, double guess, bool refined) {
  return refined ? std::abs(gap - guess) > 0.05 * guess : gap < 0.5 * guess;
}

// Where Newton's method goes on for one gap, when the gap that a solution of the linearised system gives is far from the one that the
// force was linearised about.
//
// The linear system gives a gap and the force that goes with it, and either may be what the surroundings impose. Where they impose the
// force (a few spheres squeezed between soft neighbours) the next guess is the gap at which the true force has that value: one step
// from either side of a Born wall, h^-8, where the linear answer would be far inside it, or come out of it by an eighth a time.
// Where they impose the gap, what is left is the error of a force that is steeper than the surroundings, and converges as Newton's.
// Within contact_range a pair that comes nearer against an easing force is over its barrier and falls: whatever pushed it there is taken up
// by the Born wall beyond.
// gap: of the linear solution (may be negative), um; tangent: its force, pN; guess > 0; force(h): the true force at h, repulsion positive.
template <typename Force>
double next_gap(double gap, double guess, double tangent, const Force& force) {
  const bool inwards = gap < guess;
  const double direct = std::clamp(gap, largest_fall * guess, largest_rise * guess);
  bool falls = false;
  if (direct == gap) {
    const double reached = force(gap);
    falls = inwards && gap < contact_range && reached <= std::min(tangent, force(guess));
    // Less than the linear law says: the gap itself is the nearer guess, unless it is none.
    if (reached <= tangent && !falls) return gap;
  }
  const double limit = inwards ? std::max(falls ? 0 : gap, deepest_fall * guess) : largest_rise * guess, factor = inwards ? 0.7 : 1.4;
  double from = guess, to = guess;
  for (bool found = false; !found;) {
    if (to == limit) return direct;  // no gap has this force
    from = to;
    to = inwards ? std::max(limit, factor * to) : std::min(limit, factor * to);
    found = inwards ? force(to) >= tangent : force(to) <= tangent;
  }
  for (int k = 0; k < 6; ++k) {
    const double middle = std::sqrt(from * to);
    ((inwards ? force(middle) >= tangent : force(middle) <= tangent) ? to : from) = middle;
  }
  return std::sqrt(from * to);
}

// What the guesses of one gap have shown so far in a step: that the solution lies above `low` and below `high`. A force with a well
// (a bond that may open or close) sends plain iterations from one side of it to the other and back. Other gaps move in the meantime: an end
// of the bracket that two passes running would leave holds no longer.
struct GapBracket {
  float low = 0, high = std::numeric_limits<float>::infinity();
  bool left_above = false, left_below = false;  // by the last pass

  // The next guess: `next`, or half-way (in the logarithm) to the end of the bracket that it would leave.
  double take(double next, double guess) {
    (next > guess ? low : high) = static_cast<float>(guess);
    if (high < 1.02f * low) *this = {};  // the surroundings have moved
    if (left_above && next >= high) high = std::numeric_limits<float>::infinity();
    if (left_below && next <= low) low = 0;
    left_above = next >= high;
    left_below = next <= low;
    if (left_above) return std::sqrt(guess * high);
    return left_below ? std::sqrt(guess * low) : next;
  }
};

}  // namespace pigment::assembly
