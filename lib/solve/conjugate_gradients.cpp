#include "solve/conjugate_gradients.h"

#include <cmath>

#include "solve/pair_kernel.h"

namespace pigment::solve {

namespace {

// Cholesky factor of each D x D block, lower triangle row by row, with reciprocal diagonal.
template <int D>
struct BlockJacobi {
  static constexpr int entries = D * (D + 1) / 2;
  std::vector<double> factor;

  explicit BlockJacobi(const PairSystem& system) {
    std::vector<double> blocks = diagonal_blocks(system);
    const std::size_t n = blocks.size() / (D * D);
    factor.resize(n * entries);
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < n; ++k) {
      double* a = &blocks[k * D * D];
      if (!system.held.empty() && system.held[k])
        for (int d = 0; d < D; ++d) a[2 * D + d] = a[d * D + 2] = d == 2 ? 1 : 0;
      double* l = &factor[k * entries];
      for (int r = 0; r < D; ++r)
        for (int c = 0; c <= r; ++c) {
          double sum = a[r * D + c];
          for (int q = 0; q < c; ++q) sum -= l[r * (r + 1) / 2 + q] * l[c * (c + 1) / 2 + q];
          l[r * (r + 1) / 2 + c] = r == c ? 1 / std::sqrt(sum) : sum * l[c * (c + 1) / 2 + c];
        }
    }
  }
  void solve(std::size_t k, const double* r, double* z) const {
    const double* l = &factor[k * entries];
    double y[D];
    for (int i = 0; i < D; ++i) {
      double sum = r[i];
      for (int q = 0; q < i; ++q) sum -= l[i * (i + 1) / 2 + q] * y[q];
      y[i] = sum * l[i * (i + 1) / 2 + i];
    }
    for (int i = D - 1; i >= 0; --i) {
      double sum = y[i];
      for (int q = i + 1; q < D; ++q) sum -= l[q * (q + 1) / 2 + i] * z[q];
      z[i] = sum * l[i * (i + 1) / 2 + i];
    }
  }
};

double sum_of(const std::vector<double>& partial) {
  double sum = 0;
  for (double v : partial) sum += v;
  return sum;
}

template <int D>
SolveReport solve(const PairSystem& system, std::vector<double>& x, const ConjugateGradientOptions& options) {
  const PairTopology& topology = *system.topology;
  const std::size_t n = topology.particles(), size = n * D;
  const int count = topology.chunks().count();
  const std::vector<double>& b = system.right_hand_side;
  // Held particles: their velocities are given, and what they contribute to the other rows joins b.
  const bool held = !system.held.empty();
  bool guess = x.size() == size;
  if (!guess) x.assign(size, 0.0);
  std::vector<double> given;
  if (held) {
    guess = true;
    given.assign(size, 0.0);
    for (std::size_t k = 0; k < n; ++k)
      if (system.held[k]) x[k * D + 2] = given[k * D + 2] = system.held_velocity[k];
  }
  const BlockJacobi<D> preconditioner(system);
  std::vector<double> r(size), z(size), p(size), ap((n + topology.halo_count()) * D);
  std::vector<double> scale(held ? ap.size() : 0);
  const bool flows = !system.mean_flow.empty();
  MeanFlowSums sums(system.mean_flow, count);
  std::vector<double> partial_bb(count), partial_rz(count), partial_pap(count);
  SolveReport report;
  double rz = 0, bb = 0, target = 0;
  bool done = false;
#pragma omp parallel
  {
    if (guess) {
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) apply_chunk<D>(system, c, x.data(), ap.data(), sums);
      if (flows) {
#pragma omp single
        sums.combine();
      }
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) gather_chunk<D>(system, c, ap.data(), sums);
    }
    if (held) {
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) apply_chunk<D>(system, c, given.data(), scale.data(), sums);
      if (flows) {
#pragma omp single
        sums.combine();
      }
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) gather_chunk<D>(system, c, scale.data(), sums);
    }
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) {
      double own_bb = 0, own_rz = 0;
      for (int k = topology.chunks().begin[c]; k < topology.chunks().begin[c + 1]; ++k) {
        double s[D], zs[D];
        for (int d = 0; d < D; ++d) s[d] = b[k * D + d] - (held ? scale[k * D + d] : 0.0);
        if (held && system.held[k]) s[2] = 0;
        preconditioner.solve(k, s, zs);
        for (int d = 0; d < D; ++d) {
          own_bb += s[d] * zs[d];
          r[k * D + d] = b[k * D + d] - (guess ? ap[k * D + d] : 0.0);
        }
        if (held && system.held[k]) r[k * D + 2] = 0;
        preconditioner.solve(k, &r[k * D], &z[k * D]);
        for (int d = 0; d < D; ++d) {
          own_rz += r[k * D + d] * z[k * D + d];
          p[k * D + d] = z[k * D + d];
        }
      }
      partial_bb[c] = own_bb;
      partial_rz[c] = own_rz;
    }
#pragma omp single
    {
      bb = sum_of(partial_bb);
      rz = sum_of(partial_rz);
      target = options.tolerance * options.tolerance * bb;
      done = !(rz > target);
    }
    while (!done) {
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) apply_chunk<D>(system, c, p.data(), ap.data(), sums);
      if (flows) {
#pragma omp single
        sums.combine();
      }
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) {
        gather_chunk<D>(system, c, ap.data(), sums);
        mask_held<D>(system, c, ap.data());
        double own = 0;
        for (int q = topology.chunks().begin[c] * D; q < topology.chunks().begin[c + 1] * D; ++q) own += p[q] * ap[q];
        partial_pap[c] = own;
      }
      const double alpha = rz / sum_of(partial_pap);
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) {
        double own = 0;
        for (int k = topology.chunks().begin[c]; k < topology.chunks().begin[c + 1]; ++k) {
          for (int d = 0; d < D; ++d) {
            x[k * D + d] += alpha * p[k * D + d];
            r[k * D + d] -= alpha * ap[k * D + d];
          }
          preconditioner.solve(k, &r[k * D], &z[k * D]);
          for (int d = 0; d < D; ++d) own += r[k * D + d] * z[k * D + d];
        }
        partial_rz[c] = own;
      }
      const double next = sum_of(partial_rz), beta = next / rz;
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c)
        for (int q = topology.chunks().begin[c] * D; q < topology.chunks().begin[c + 1] * D; ++q) p[q] = z[q] + beta * p[q];
#pragma omp single
      {
        rz = next;
        ++report.iterations;
        done = !(rz > target) || report.iterations >= options.max_iterations;  // a NaN also ends the loop
      }
    }
  }
  report.residual = bb > 0 ? std::sqrt(rz / bb) : 0;
  report.converged = std::isfinite(rz) && rz <= target;
  if (!report.converged)
    report.message = std::isfinite(rz) ? "no convergence in " + std::to_string(report.iterations) + " iterations"
                                       : "the residual is not a finite number";
  return report;
}

// The residual is judged in the factor's norm. Plain loops: the factor's own solve is what takes the time.
SolveReport solve_with_factor(const PairSystem& system, std::vector<double>& x, const ConjugateGradientOptions& options,
                              CholmodFactor& factor) {
  const std::size_t size = system.right_hand_side.size();
  const std::size_t n = system.topology->particles(), D = size / n;
  std::vector<double> r = system.right_hand_side, s = r, z, p, ap;
  if (x.size() != size) x.assign(size, 0.0);
  const auto mask = [&](std::vector<double>& v) {
    if (!system.held.empty())
      for (std::size_t k = 0; k < n; ++k)
        if (system.held[k]) v[k * D + 2] = 0;
  };
  if (!system.held.empty()) {
    std::vector<double> given(size, 0.0);
    for (std::size_t k = 0; k < n; ++k)
      if (system.held[k]) x[k * D + 2] = given[k * D + 2] = system.held_velocity[k];
    apply(system, given, ap);
    for (std::size_t q = 0; q < size; ++q) s[q] -= ap[q];
    mask(s);
  }
  const auto dot = [size](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t q = 0; q < size; ++q) sum += a[q] * b[q];
    return sum;
  };
  factor.solve(s, z);
  const double scale = dot(s, z), target = options.tolerance * options.tolerance * scale;
  apply(system, x, ap);
  for (std::size_t q = 0; q < size; ++q) r[q] -= ap[q];
  mask(r);
  factor.solve(r, z);
  mask(z);
  double rz = dot(r, z);
  p = z;
  SolveReport report;
  while (rz > target && report.iterations < options.max_iterations) {
    apply(system, p, ap);
    mask(ap);
    const double alpha = rz / dot(p, ap);
    for (std::size_t q = 0; q < size; ++q) {
      x[q] += alpha * p[q];
      r[q] -= alpha * ap[q];
    }
    factor.solve(r, z);
    mask(z);
    const double next = dot(r, z), beta = next / rz;
    for (std::size_t q = 0; q < size; ++q) p[q] = z[q] + beta * p[q];
    rz = next;
    ++report.iterations;
  }
  report.residual = scale > 0 ? std::sqrt(std::max(rz, 0.0) / scale) : 0;
  report.converged = std::isfinite(rz) && rz <= target;
  if (!report.converged)
    report.message = std::isfinite(rz) ? "no convergence in " + std::to_string(report.iterations) + " iterations"
                                       : "the residual is not a finite number";
  return report;
}

}  // namespace

SolveReport conjugate_gradients(const PairSystem& system, std::vector<double>& x, const ConjugateGradientOptions& options,
                                CholmodFactor* factor) {
  if (factor && factor->ready()) return solve_with_factor(system, x, options, *factor);
  return system.rotation ? solve<6>(system, x, options) : solve<3>(system, x, options);
}

}  // namespace pigment::solve
