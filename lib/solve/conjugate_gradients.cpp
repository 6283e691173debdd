#include "solve/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/scratch.h"
#include "solve/block_jacobi.h"

namespace pigment::solve {

namespace {

double sum_of(const std::vector<double>& partial) {
  double sum = 0;
  for (double v : partial) sum += v;
  return sum;
}

// A bound on the error's energy e A e from one particle's residual r: A is at least the particles' own resistance. The preconditioned
// residual alone says little of a cluster of bonded particles: what moves it as a whole is small against the stiffness of its bonds.
template <int D>
double energy_bound(const ParticleTerm& t, const double* r) {
  double sum = (r[0] * r[0] + r[1] * r[1]) / t.across + r[2] * r[2] / t.along;
  if (D == 6) sum += (r[3] * r[3] + r[4] * r[4]) / t.spin_across + r[5] * r[5] / t.spin_along;
  return sum;
}
// A residual that the bonds take up among themselves counts in that bound and moves nothing: it may be so many times the error asked for.
constexpr double bound_over_tolerance = 30;

template <int D>
SolveReport solve(const PairSystem& system, std::vector<double>& x_out, const ConjugateGradientOptions& options, StiffNetwork* network) {
  constexpr int S = stride<D>;
  const PairTopology& topology = *system.topology;
  const std::size_t n = topology.particles(), size = n * D, padded = input_size<D>(topology);
  const int count = topology.chunks().count();
  // Held particles: their velocities are given, and what they contribute to the other rows joins b.
  const bool held = !system.held.empty();
  const bool guessed = x_out.size() == size, guess = guessed || held;
  std::optional<BlockJacobi<D>> jacobi;  // before the vectors: what it is made from takes their room
  if (!network) jacobi.emplace(system);
  Scratch x(padded), r(padded), z(padded), p(padded), ap(output_size<D>(topology));
  if (guessed) to_strided<D>(x_out, x.data());
  const bool flows = !system.mean_flow.empty();
  MeanFlowSums sums(system.mean_flow, count);
  std::vector<double> partial_bb(count), partial_rz(count), partial_pap(count), partial_energy(count), partial_bound(count);
  SolveReport report;
  double last_rz = 0, scale = 0;
  bool settled = false;
  const auto begin_of = [&](int c) { return topology.chunks().begin[c]; };
  // z = M^-1 r by all threads together, each chunk's part of r . z.
  const auto precondition = [&](std::vector<double>& partial) {
    if (network) {
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) network->eliminate(begin_of(c), begin_of(c + 1), r.data());
      network->solve();
    }
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c)
      partial[c] = network ? network->substitute(begin_of(c), begin_of(c + 1), system.held, r.data(), z.data()) : jacobi->solve(begin_of(c), begin_of(c + 1), r.data(), z.data());
  };
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) {
      // What stands beyond the last particle belongs to the last chunk.
      const std::size_t begin = static_cast<std::size_t>(begin_of(c)) * S, end = c + 1 < count ? static_cast<std::size_t>(begin_of(c + 1)) * S : padded;
      const std::size_t last = std::min(end, n * S);
      for (double* v : {r.data(), z.data(), p.data()}) std::fill(v + begin, v + end, 0.0);
      std::fill(x.data() + (guessed ? last : begin), x.data() + end, 0.0);
      std::fill(ap.data() + last, ap.data() + end, 0.0);
      for (auto k = static_cast<std::size_t>(begin_of(c)); held && k < static_cast<std::size_t>(begin_of(c + 1)); ++k)
        if (system.held[k]) x[k * S + 2] = p[k * S + 2] = system.held_velocity[k];
    }
    // Of the free rows: r = b - A given, whose size is the scale, and p = b - A x, the residual. p holds what is given before.
    for (const bool of_given : {true, false}) {
      const bool product = of_given ? held : guess;
      const double* in = of_given ? p.data() : x.data();
      double* left = of_given ? r.data() : p.data();
      if (product) {
#pragma omp for schedule(static)
        for (int c = 0; c < count; ++c) apply_chunk<D>(system, c, in, ap.data(), sums);
        if (flows) {
#pragma omp single
          sums.combine();
        }
#pragma omp for schedule(static)
        for (int c = 0; c < count; ++c) finish_chunk<D>(system, c, false, in, ap.data(), sums);
      }
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c)
        for (auto k = static_cast<std::size_t>(begin_of(c)); k < static_cast<std::size_t>(begin_of(c + 1)); ++k) {
          for (int d = 0; d < D; ++d) {
            const std::size_t q = k * S + place<D>(d);
            left[q] = system.right_hand_side[k * D + d] - (product ? ap[q] : 0.0);
          }
          if (held && system.held[k]) left[k * S + 2] = 0;
        }
    }
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) {
      const std::size_t begin = static_cast<std::size_t>(begin_of(c)) * S, end = static_cast<std::size_t>(begin_of(c + 1)) * S;
      double sum = 0;
      for (std::size_t q = begin; q < end; ++q) sum += x[q] * (r[q] + p[q]);
      partial_energy[c] = sum;
    }
    // Without a guess the residual is b itself.
    if (guess && network) {
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) {
        network->eliminate(begin_of(c), begin_of(c + 1), r.data(), 0);
        network->eliminate(begin_of(c), begin_of(c + 1), p.data(), 1);
      }
      network->solve(2);
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) {
        partial_bb[c] = network->substitute(begin_of(c), begin_of(c + 1), system.held, r.data(), z.data(), 0);
        partial_rz[c] = network->substitute(begin_of(c), begin_of(c + 1), system.held, p.data(), z.data(), 1);
        std::copy(p.data() + begin_of(c) * S, p.data() + begin_of(c + 1) * S, r.data() + begin_of(c) * S);
      }
    } else {
      precondition(partial_bb);
      if (guess) {
#pragma omp for schedule(static)
        for (int c = 0; c < count; ++c) std::copy(p.data() + begin_of(c) * S, p.data() + begin_of(c + 1) * S, r.data() + begin_of(c) * S);
        precondition(partial_rz);
      }
    }
#pragma omp for schedule(static)
    for (int c = 0; c < count; ++c) std::copy(z.data() + begin_of(c) * S, z.data() + begin_of(c + 1) * S, p.data() + begin_of(c) * S);
    // Every thread sums up for itself, in the same order: cheaper than to wait for one that does.
    const double all = sum_of(partial_bb), bb = std::min(all, options.largest_scale), target = options.tolerance * options.tolerance * bb;
    double rz = guess ? sum_of(partial_rz) : all;
    double energy = sum_of(partial_energy);  // x A x so far; what is missing is e A e
    bool done = !(rz > 0), agreed = false;
    int iterations = 0;
    while (!done) {
      if (rz <= target) {
#pragma omp for schedule(static)
        for (int c = 0; c < count; ++c) {
          double sum = 0;
          for (int k = begin_of(c); k < begin_of(c + 1); ++k) sum += energy_bound<D>(system.particle[k], &r[static_cast<std::size_t>(k) * S]);
          partial_bound[c] = sum;
        }
        const double most = bound_over_tolerance * options.tolerance;
        agreed = sum_of(partial_bound) <= most * most * energy;
        if (agreed) break;
      }
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) apply_chunk<D>(system, c, p.data(), ap.data(), sums);
      if (flows) {
#pragma omp single
        sums.combine();
      }
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c) partial_pap[c] = finish_chunk<D>(system, c, held, p.data(), ap.data(), sums);
      const double alpha = rz / sum_of(partial_pap);
      if (network) {
#pragma omp for schedule(static)
        for (int c = 0; c < count; ++c)
          for (std::size_t q = static_cast<std::size_t>(begin_of(c)) * S; q < static_cast<std::size_t>(begin_of(c + 1)) * S; ++q) {
            x[q] += alpha * p[q];
            r[q] -= alpha * ap[q];
          }
        precondition(partial_rz);
      } else {
#pragma omp for schedule(static)
        for (int c = 0; c < count; ++c)
          partial_rz[c] = jacobi->update(begin_of(c), begin_of(c + 1), alpha, p.data(), ap.data(), x.data(), r.data(), z.data());
      }
      const double next = sum_of(partial_rz), beta = next / rz;
#pragma omp for schedule(static)
      for (int c = 0; c < count; ++c)
        for (std::size_t q = static_cast<std::size_t>(begin_of(c)) * S; q < static_cast<std::size_t>(begin_of(c + 1)) * S; ++q) p[q] = z[q] + beta * p[q];
      energy += alpha * rz;
      rz = next;
      ++iterations;
      done = !(rz > 0) || iterations >= options.max_iterations;  // a NaN also ends the loop
    }
#pragma omp master
    {
      last_rz = rz;
      scale = bb;
      settled = agreed;
      report.iterations = iterations;
    }
  }
  x_out.resize(size);
  from_strided<D>(x.data(), x_out);
  report.scale = scale;
  report.residual = scale > 0 ? std::sqrt(last_rz / scale) : 0;
  report.converged = settled || (std::isfinite(last_rz) && last_rz <= 0);
  if (!report.converged)
    report.message = std::isfinite(last_rz) ? "no convergence in " + std::to_string(report.iterations) + " iterations"
                                       : "the residual is not a finite number";
  return report;
}

}  // namespace

SolveReport conjugate_gradients(const PairSystem& system, std::vector<double>& x, const ConjugateGradientOptions& options,
                                StiffNetwork* network) {
  return system.rotation ? solve<6>(system, x, options, network) : solve<3>(system, x, options, network);
}

}  // namespace pigment::solve
