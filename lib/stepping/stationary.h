#pragma once
// Whether a layer under a steady flow has come to where it stays, in the mean: `stepping.stop_when: stationary`.
#include <deque>

namespace pigment::stepping {

// height: of the mass centre, um, at each frame, the oldest first. The last 2 * window frames are judged: the means of the two
// halves differ by less than `tolerance` of the height, beyond doubt, that is with twice the standard error of their difference
// added (5 % false alarms at the limit). The errors are those of five blocks in each half, long against the memory of the
// noise if the window is. False where fewer frames are there; window: at least 5.
bool is_stationary(const std::deque<double>& height, std::size_t window, double tolerance);

}  // namespace pigment::stepping
