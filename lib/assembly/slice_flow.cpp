#include "assembly/slice_flow.h"

#include <algorithm>
#include <cmath>

#include "model/particles.h"
#include "model/sphere_slice.h"
#include "resistance/boundary_resistance.h"
#include "resistance/hindered_drag.h"

namespace pigment::assembly {

namespace {

// Spheres that overlap, as in a packing made by hand, may fill a slice: some room is left for the liquid.
constexpr double least_liquid = 0.05;

}  // namespace

SliceFlow::SliceFlow(const std::vector<double>& radius, double area, double height, const HeightField* substrate)
    : radius_(radius), area_(area), substrate_(substrate) {
  double cubes = 0, squares = 0;
  for (double a : radius) {
    cubes += a * a * a;
    squares += a * a;
  }
  sauter_radius_ = cubes / squares;
  slices_ = std::max(1, static_cast<int>(std::lround(height / (2 * sauter_radius_))));
  thickness_ = height / slices_;
}

void SliceFlow::place(const std::vector<Vec3>& position, double surface, double viscosity, double absorption) {
  const std::size_t n = radius_.size();
  const double thickness = surface > 0 ? surface / slices_ : thickness_;
  absorption_ = absorption;
  thickness_now_ = thickness;
  // Which part of each particle lies in which slice; slice 0 begins at z = 0.
  struct Part {
    long slice;
    double volume;
  };
  std::vector<Part> parts;
  std::vector<std::size_t> begin{0};
  long lowest = 0, highest = slices_ - 1;
  for (std::size_t k = 0; k < n; ++k) {
    const double a = radius_[k], z = position[k].z();
    auto first = static_cast<long>(std::floor((z - a) / thickness)), last = static_cast<long>(std::floor((z + a) / thickness));
    if (surface > 0) {
      first = std::max(first, 0L);
      last = std::min(last, static_cast<long>(slices_) - 1);
    }
    for (long s = first; s <= last; ++s) {
      const double volume = sphere_slice_volume(a, z, static_cast<double>(s) * thickness, static_cast<double>(s + 1) * thickness);
      if (volume > 0) parts.push_back({s, volume});
    }
    lowest = std::min(lowest, first);
    highest = std::max(highest, last);
    begin.push_back(parts.size());
  }
  const auto slices = static_cast<std::size_t>(highest - lowest + 1);
  const auto space_below = [&](double z) { return substrate_ && z > 0 ? substrate_->space_below(z) : z; };
  space_.resize(slices);
  for (std::size_t s = 0; s < slices; ++s) {
    const double bottom = static_cast<double>(static_cast<long>(s) + lowest) * thickness;
    space_[s] = area_ * (substrate_ ? space_below(bottom + thickness) - space_below(bottom) : thickness);
  }
  // Solids, and sum of a^3 over sum of a^2, each particle by its share of volume.
  std::vector<double> squares(slices, 0.0), cubes(slices, 0.0);
  solids_.assign(slices, 0.0);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t at = begin[k]; at < begin[k + 1]; ++at) {
      const auto s = static_cast<std::size_t>(parts[at].slice - lowest);
      solids_[s] += parts[at].volume / space_[s];
      cubes[s] += parts[at].volume;
      squares[s] += parts[at].volume / radius_[k];
    }
  liquid_.resize(slices);
  for (std::size_t s = 0; s < slices; ++s) liquid_[s] = std::max(1 - solids_[s], least_liquid);
  term_.begin = begin;
  term_.share.resize(parts.size());
  term_.slice_drag.assign(slices, 0.0);
  drag_.assign(n, 0.0);
  force_.assign(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const double stokes = viscosity * resistance::stokes_drag(radius_[k]);
    double inside = 0;
    for (std::size_t at = begin[k]; at < begin[k + 1]; ++at) inside += parts[at].volume;
    for (std::size_t at = begin[k]; at < begin[k + 1]; ++at) {
      const auto s = static_cast<std::size_t>(parts[at].slice - lowest);
      const double weight = parts[at].volume / inside, ratio = radius_[k] * squares[s] / cubes[s];
      const double b = weight * stokes * resistance::hindered_drag_factor(1 - liquid_[s], ratio);
      term_.share[at] = {static_cast<std::int32_t>(s), b, parts[at].volume / (space_[s] * liquid_[s])};
      term_.slice_drag[s] += b;
      drag_[k] += b;
    }
    // A particle that has left through the surface: no slice holds any of it.
    if (begin[k] == begin[k + 1]) drag_[k] = stokes;
  }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t at = begin[k]; at < begin[k + 1]; ++at) {
      const solve::MeanFlow::Share& share = term_.share[at];
      force_[k] -= absorption / liquid_[share.slice] * (share.drag + share.displaced * term_.slice_drag[share.slice]);
    }
}

std::vector<SliceState> SliceFlow::states(const std::vector<double>& velocity, std::size_t D) const {
  std::vector<SliceState> result(solids_.size());
  std::vector<double> displaced(solids_.size(), 0.0), drag_times_velocity(solids_.size(), 0.0), share_sum(solids_.size(), 0.0);
  for (std::size_t k = 0; k < radius_.size(); ++k)
    for (std::size_t at = term_.begin[k]; at < term_.begin[k + 1]; ++at) {
      const solve::MeanFlow::Share& share = term_.share[at];
      const double u = velocity[k * D + 2];
      displaced[share.slice] += share.displaced * u;
      drag_times_velocity[share.slice] += share.drag * u;
      share_sum[share.slice] += share.displaced;
    }
  for (std::size_t s = 0; s < result.size(); ++s) {
    SliceState& state = result[s];
    state.solids_fraction = solids_[s];
    state.solids_flux = displaced[s] * liquid_[s];
    state.liquid_velocity = (-absorption_ - state.solids_flux) / liquid_[s];
    // Drag, and the pressure term of what it displaces: what the liquid loses to the particles.
    const double drag = term_.slice_drag[s] * state.liquid_velocity - drag_times_velocity[s];
    state.pressure_drop = drag * (1 + share_sum[s]) / (substrate_ ? space_[s] / thickness_now_ : area_);
  }
  return result;
}

}  // namespace pigment::assembly
