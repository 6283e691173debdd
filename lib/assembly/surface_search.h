#pragma once
// Where a pressure-limited surface stands at the end of a step (free_surface.model: pressure_limited).
//
// The surface never stands below what the dewatering leaves, and never presses harder than air's entry into the pores:
//   H >= H_drained,  P <= P_entry,  and one of the two is an equality.
// P falls as H rises, so the height with P = P_entry is found by regula falsi (Illinois) between a height where the surface
// presses too hard and one where it does not.
#include <algorithm>
#include <cmath>
#include <optional>

namespace pigment::assembly {

class SurfaceSearch {
 public:
  // The solver leaves a pressure uncertain by about a thousandth; three times that are far less than is known of any pore.
  static constexpr double tolerance = 0.003;

  // lowest: what the dewatering leaves; guess: where to look first; stride: by how much at first, um. entry_pressure: pN/um^2.
  SurfaceSearch(double lowest, double guess, double stride, double entry_pressure)
      : lowest_(lowest), height_(std::max(lowest, guess)), stride_(stride), resolution_(0.01 * stride), entry_(entry_pressure) {}
  SurfaceSearch() = default;

  double height() const { return height_; }

  // The pressure that came out at height(). True: it stands; false: height() has moved.
  bool settle(double pressure) {
    const double excess = pressure - entry_;
    if (last_ || std::abs(excess) <= tolerance * entry_ || (excess < 0 && height_ <= lowest_)) return true;
    std::optional<End>&own = excess > 0 ? below_ : above_, &other = excess > 0 ? above_ : below_;
    if (own && other && (excess > 0) == last_too_hard_) other->excess *= 0.5;  // the same end moved twice: the other weighs less
    own = End{height_, excess};
    last_too_hard_ = excess > 0;
    if (other && std::abs(own->height - other->height) < resolution_) {
      // The pressure jumps here, as where a particle is caught: the higher side it is, where the surface does not press too hard.
      last_ = true;
      if (excess < 0) return true;
      height_ = other->height;
    } else if (other) {
      const double share = own->excess / (own->excess - other->excess);
      height_ += std::clamp(share, 0.05, 0.95) * (other->height - height_);
    } else {
      height_ = std::max(lowest_, height_ + (excess > 0 ? stride_ : -stride_));
      stride_ *= 2;
    }
    return false;
  }

 private:
  struct End {
    double height, excess;
  };
  double lowest_ = 0, height_ = 0, stride_ = 0, resolution_ = 0, entry_ = 0;
  std::optional<End> below_, above_;
  bool last_too_hard_ = false, last_ = false;
};

}  // namespace pigment::assembly
