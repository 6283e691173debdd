#pragma once
// Many independent pairs of spheres in one box, bound by depletion attraction against electrostatic repulsion, and the
// stationary statistics of their gap: the exact one, and those of two schemes that are known to be wrong.
#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <vector>

#include "resistance/scene_resistance.h"
#include "support/one_layer.h"

namespace pigment::test {

struct GapStatistics {
  double mean = 0, deviation = 0;       // um
  double mean_error = 0, deviation_error = 0;  // standard errors, from the means over independent pairs
};

struct ThermalPairs {
  stepping::Problem problem;
  Vec3Array position;
  double radius_a, radius_b;

  // count pairs on a grid so wide that they never meet; gaps as given.
  ThermalPairs(const std::string& colloidal, double a, double b, int count, double first_gap) : radius_a(a), radius_b(b) {
    problem = empty_problem();
    problem.stepping = {};
    auto document = config::Document::from_text("colloidal: " + colloidal);
    problem.interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
    problem.interactions.brownian.emplace();
    problem.interactions.brownian->model = forces::BrownianParameters::Model::FluctuationDissipation;
    const int side = static_cast<int>(std::ceil(std::cbrt(count)));
    const double spacing = 10 * std::max(a, b);
    problem.cell = {side * spacing, side * spacing, side * spacing};
    for (int k = 0; k < count; ++k) {
      const Vec3 at = spacing * Vec3(k % side + 0.5, k / side % side + 0.5, k / (side * side) + 0.5);
      const auto u = random_uniforms({1, Stream::Tests}, static_cast<std::uint64_t>(k));
      const double z = 2 * u[0] - 1, phi = 2 * 3.14159265358979 * u[1], r = std::sqrt(1 - z * z);
      add_particle(problem, position, a, at);
      add_particle(problem, position, b, at + (a + b + first_gap) * Vec3(r * std::cos(phi), r * std::sin(phi), z));
    }
  }

  Liquid liquid() const { return liquid_at(problem.interactions.liquid, problem.interactions.liquid.temperature); }

  double energy(double gap) const {
    double sum = 0;
    const forces::PairGeometry g{gap, radius_a, radius_b, -25, -25};
    for (const auto& [name, law] : problem.interactions.colloidal) sum += law->prepare(liquid())->switched(g).energy;
    return sum;
  }

  // Relative motion of the two along and across the line of centres, per unit of force on the one and of its opposite on the
  // other: mobilities, and the diffusivities over kT of white noise with the strength of isolated drag (k_brown).
  struct Relative {
    double along, across, k_brown_along, k_brown_across;
  };
  Relative relative(double gap) const {
    const double mu = liquid().viscosity, a = radius_a, b = radius_b;
    const auto k = resistance::pair_term(problem.interactions.hydrodynamics, a, b, gap);
    const auto o = resistance::operator_scalars(k, a, b);
    const double drag_a = resistance::stokes_drag(a), drag_b = resistance::stokes_drag(b);
    // Unknowns: the two velocities along the line; the two velocities across it and the two rotations that go with them.
    Eigen::Matrix2d along = Eigen::Vector2d(drag_a, drag_b).asDiagonal();
    along += o.squeeze * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
    Eigen::Matrix4d across = Eigen::Vector4d(drag_a, drag_b, resistance::stokes_torque(a), resistance::stokes_torque(b)).asDiagonal();
    Eigen::Matrix<double, 2, 4> slip;  // at the middle of the gap, and the difference of rotations
    slip << 1, -1, a + gap / 2, b + gap / 2, 0, 0, 1, -1;
    across += slip.transpose() * (Eigen::Matrix2d() << o.a, o.b, o.b, o.c).finished() * slip;
    const Eigen::Vector2d u = along.inverse() * Eigen::Vector2d(1, -1) / mu;
    const Eigen::Vector4d v = across.inverse() * Eigen::Vector4d(1, -1, 0, 0) / mu;
    return {u[0] - u[1], v[0] - v[1], mu * (drag_a * u[0] * u[0] + drag_b * u[1] * u[1]), mu * (drag_a * v[0] * v[0] + drag_b * v[1] * v[1])};
  }

  struct Range {
    double from, to;
  };
  // Mean and standard deviation of the gaps in a range whose density's logarithm is given on a grid.
  template <typename LogDensity>
  static GapStatistics moments(Range range, const LogDensity& log_density) {
    constexpr int n = 4000;
    const double width = (range.to - range.from) / n;
    std::vector<double> value(n);
    double top = -1e300;
    for (int k = 0; k < n; ++k) top = std::max(top, value[k] = log_density(range.from + width * (k + 0.5)));
    double w0 = 0, w1 = 0, w2 = 0;
    for (int k = 0; k < n; ++k) {
      const double h = range.from + width * (k + 0.5), w = std::exp(value[k] - top);
      w0 += w;
      w1 += w * h;
      w2 += w * h * h;
    }
    return {w1 / w0, std::sqrt(w2 / w0 - w1 * w1 / (w0 * w0)), 0, 0};
  }
  // Boltzmann: (a + b + h)^2 exp(-U/kT).
  GapStatistics exact(Range limit) const {
    return moments(limit, [&](double h) { return 2 * std::log(radius_a + radius_b + h) - energy(h) / liquid().thermal_energy(); });
  }
  // Ito's dr = M F dt + noise of diffusivities D along and D' across the line, without the drift div D: the distance has the
  // drift M F + 2 D'/r, and the stationary density is exp(integral of that over D)/D.
  GapStatistics ito(Range limit, bool k_brown) const {
    const double kT = liquid().thermal_energy();
    double sum = 0, last_gap = 0, last_slope = 0;
    return moments(limit, [&](double h) {  // called with rising h
      const Relative m = relative(h);
      const double d = kT * (k_brown ? m.k_brown_along : m.along), across = kT * (k_brown ? m.k_brown_across : m.across);
      const double step = 1e-6, force = -(energy(h + step) - energy(h - step)) / (2 * step);
      const double slope = (m.along * force + 2 * across / (radius_a + radius_b + h)) / d;
      if (last_gap > 0) sum += 0.5 * (slope + last_slope) * (h - last_gap);
      last_gap = h;
      last_slope = slope;
      return sum - std::log(d);
    });
  }
  GapStatistics without_drift(Range limit) const { return ito(limit, false); }
  GapStatistics of_k_brown(Range limit) const { return ito(limit, true); }

  std::vector<double> gaps(const stepping::RunState& state) const {
    std::vector<double> gap;
    for (std::size_t k = 0; k + 1 < state.position.size(); k += 2)
      gap.push_back((state.position[k + 1] - state.position[k]).norm() - radius_a - radius_b);
    return gap;
  }

  // Runs to `settle` ms, then samples every `every` ms until `until`.
  GapStatistics run(double settle, double until, double every) const {
    stepping::RunState state = stepping::initial_state(problem, position);
    stepping::Stepper stepper(problem, state);
    std::vector<double> sum(position.size() / 2, 0.0), square = sum;
    int samples = 0;
    for (double next = settle; next <= until; next += every) {
      while (state.time < next - 1e-9) stepper.advance(state, next - state.time);
      const std::vector<double> gap = gaps(state);
      for (std::size_t k = 0; k < gap.size(); ++k) {
        sum[k] += gap[k];
        square[k] += gap[k] * gap[k];
      }
      ++samples;
    }
    const double n = static_cast<double>(sum.size());
    GapStatistics s;
    double mean_square = 0;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      s.mean += sum[k] / samples / n;
      mean_square += square[k] / samples / n;
    }
    const double variance = mean_square - s.mean * s.mean;
    s.deviation = std::sqrt(variance);
    double of_mean = 0, of_variance = 0;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const double m = sum[k] / samples - s.mean;
      const double v = square[k] / samples - 2 * s.mean * sum[k] / samples + s.mean * s.mean - variance;
      of_mean += m * m;
      of_variance += v * v;
    }
    s.mean_error = std::sqrt(of_mean / (n * (n - 1)));
    s.deviation_error = std::sqrt(of_variance / (n * (n - 1))) / (2 * s.deviation);
    return s;
  }
};

}  // namespace pigment::test
