#pragma once
// How Newton's iteration moves the guess of a gap at the step's end.
#include <algorithm>
#include <cmath>

namespace pigment::assembly {

// A guess may fall by this factor in one refinement, so that a gap that came out negative is approached from above; and rise by
// this, since repulsion linearised deep inside a steep barrier throws a gap out too far.
inline constexpr double largest_fall = 0.2, largest_rise = 3;

// Whether a gap came out far from what the system was linearised about.
inline bool off_guess(double gap, double guess, bool refined) {
  return refined ? std::abs(gap - guess) > 0.05 * guess : gap < 0.5 * guess;
}

inline double next_guess(double gap, double guess) { return std::clamp(gap, largest_fall * guess, largest_rise * guess); }

}  // namespace pigment::assembly
