#include "solve/adaptive_solver.h"

#include <algorithm>

namespace pigment::solve {

namespace {

// Iterations of block Jacobi before a network is tried whose cost is not known yet.
constexpr int least_patience = 60, particles_per_iteration = 80;
// A network fits no longer where more than `most_changed` of its stiff pairs are stiffer or softer by `times_changed` than it has them, each
// of which costs an iteration or so, or where a solve takes more than `stale` iterations.
constexpr int most_changed = 3, stale = 25;
constexpr double times_changed = 3;
// A pair's part in an iteration of block Jacobi takes the time of so many of the factor's multiply-adds, its order and the solves with it
// included: in a jam of 7,070 particles with 91,000 pairs 0.4 ms beside 45 ms for 1.7e9 of them, in an uncharged layer of 4,700 with
// 42,500 pairs 0.24 ms beside 15 ms for 4.2e8 (two threads).
constexpr double work_of_pair = 160;
// The network's norm is nearly that of the error's energy, which block Jacobi's does not see: at the same tolerance an uncharged layer's
// solves left 0.1 % of the energy norm with the one and 3 % with the other.
constexpr double network_tolerance = 10;

// The looser the solve, the fewer pairs a network needs, and it is its factor that takes time. In a jam of 7,070 charged particles, solved to
// 1e-3: 1.5 iterations and 37 ms a factor with the pairs that are 10 times as stiff as their drag, 5.5 and 13 ms with those of 1000 times.
// In an uncharged layer, to 3e-5, 300 and 1000 times took a fifth more passes of Newton's method than 10 (four runs each).
double stiff_over_drag(double tolerance) { return std::clamp(1e9 * tolerance * tolerance, 10.0, 1000.0); }

}  // namespace

SolveReport AdaptiveSolver::solve(const PairSystem& system, std::vector<double>& x, const ConjugateGradientOptions& options) {
  ConjugateGradientOptions with_network = options, first = options;
  with_network.tolerance *= network_tolerance;
  const bool outgrown = network_.ready() && network_.changed(system, times_changed) > most_changed;
  if (outgrown && !stiff_) network_.forget();
  if (stiff_ && (outgrown || (!network_.ready() && !refused_))) make(system, options.tolerance);
  const bool had_network = network_.ready();
  if (had_network) first = with_network;
  const int patience =
      network_cost_ > 0 ? network_cost_ : std::max(least_patience, static_cast<int>(system.topology->particles()) / particles_per_iteration);
  first.max_iterations = refused_ ? options.max_iterations : std::min(options.max_iterations, had_network ? stale : patience);
  SolveReport report = conjugate_gradients(system, x, first, had_network ? &network_ : nullptr);
  if (!had_network) {
    ++jacobi_solves_;
    jacobi_iterations_ += report.iterations;
    jacobi_failures_ += !report.converged;
  }
  if (report.converged || first.max_iterations == options.max_iterations) return report;
  const int before = report.iterations;
  // Whatever the unfinished solve left is a fair guess, unless it is not finite.
  if (!(report.residual < 1e300)) x.clear();
  make(system, options.tolerance);
  if (!had_network && network_.ready())
    stiff_ = (jacobi_failures_ > 1 && 2 * jacobi_failures_ > jacobi_solves_) ||
             jacobi_iterations_ > network_cost_ * jacobi_solves_;
  report = network_.ready() ? conjugate_gradients(system, x, with_network, &network_) : conjugate_gradients(system, x, options);
  report.iterations += before;
  return report;
}

void AdaptiveSolver::make(const PairSystem& system, double tolerance) {
  refused_ = !network_.factorize(system, stiff_over_drag(tolerance)).empty();
  if (!refused_) network_cost_ = 1 + static_cast<int>(network_.work() / (work_of_pair * static_cast<double>(system.topology->pairs())));
}

}  // namespace pigment::solve
