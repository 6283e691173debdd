#include "solve/adaptive_solver.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace pigment::solve {

namespace {

// The operations of a factorisation grow with the square of the number of particles n, those of a block-Jacobi iteration with n: of 7,100
// particles the one takes 4 s, the other 0.5 ms. As many iterations as there are particles, and 500 at least, are lost at worst before
// the factor is tried; so many with the factor before it is made anew.
constexpr int least_patience = 500, refactor = 25;
// The factor leaves the mean flow out, whose share of the spectrum, between one and 1/(1 - phi)^2, takes some 20 iterations.
constexpr int refactor_beside_mean_flow = 60;
// Beyond this many unknowns the factor's fill outgrows memory and its time that of any number of iterations.
constexpr std::size_t most_unknowns = 150000;

template <typename T>
void put(std::vector<std::int64_t>& out, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  out.push_back(static_cast<std::int64_t>(values.size()));
  const std::size_t words = (values.size() * sizeof(T) + 7) / 8, at = out.size();
  out.resize(at + words, 0);
  if (!values.empty()) std::memcpy(out.data() + at, static_cast<const void*>(values.data()), values.size() * sizeof(T));
}
template <typename T>
std::size_t take(const std::vector<std::int64_t>& in, std::size_t at, std::vector<T>& values) {
  values.resize(static_cast<std::size_t>(in.at(at++)));
  if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), in.data() + at, values.size() * sizeof(T));
  return at + (values.size() * sizeof(T) + 7) / 8;
}

std::vector<std::int64_t> pack(const PairSystem& system) {
  std::vector<std::int64_t> out{system.rotation ? 1 : 0};
  put(out, system.held);
  put(out, system.particle);
  std::vector<OwnBlock> own;
  for (const auto& chunk : system.own) own.insert(own.end(), chunk.begin(), chunk.end());
  put(out, own);
  for (const auto& chunk : system.full) put(out, std::vector<FullPair>(chunk.begin(), chunk.end()));
  for (const auto& chunk : system.squeeze) put(out, std::vector<SqueezePair>(chunk.begin(), chunk.end()));
  return out;
}

PairSystem unpack(const std::vector<std::int64_t>& in, const PairTopology& topology) {
  PairSystem system;
  system.topology = &topology;
  system.rotation = in.at(0) != 0;
  system.full.resize(topology.chunks().count());
  system.squeeze.resize(topology.chunks().count());
  std::size_t at = take(in, 1, system.held);
  at = take(in, at, system.particle);
  std::vector<OwnBlock> own;
  at = take(in, at, own);
  if (!own.empty()) system.own.resize(topology.chunks().count());
  for (std::size_t q = 0, c = 0; q < own.size(); ++q) {
    while (own[q].particle >= topology.chunks().begin[c + 1]) ++c;
    system.own[c].push_back(own[q]);
  }
  for (auto& chunk : system.full) {
    std::vector<FullPair> pairs;
    at = take(in, at, pairs);
    for (const FullPair& p : pairs) chunk.push_back(p);
  }
  for (auto& chunk : system.squeeze) {
    std::vector<SqueezePair> pairs;
    at = take(in, at, pairs);
    for (const SqueezePair& p : pairs) chunk.push_back(p);
  }
  return system;
}

}  // namespace

void AdaptiveSolver::forget_factor() {
  if (!factor_.ready()) return;
  factor_ = CholmodFactor();
  packed_.clear();
  ++revision_;
}

void AdaptiveSolver::restore_factor(const std::vector<std::int64_t>& packed, const PairTopology& topology) {
  forget_factor();
  if (packed.empty()) return;
  if (factor_.factorize(unpack(packed, topology)).empty()) packed_ = packed;
}

SolveReport AdaptiveSolver::solve(const PairSystem& system, std::vector<double>& x, const ConjugateGradientOptions& options) {
  const bool small = system.right_hand_side.size() <= most_unknowns;
  ConjugateGradientOptions limited = options;
  const int patience = std::max(least_patience, static_cast<int>(system.topology->particles()));
  const int again = system.mean_flow.empty() ? refactor : refactor_beside_mean_flow;
  limited.max_iterations = !small ? options.max_iterations : std::min(options.max_iterations, factor_.ready() ? again : patience);
  SolveReport report = conjugate_gradients(system, x, limited, factor_.ready() ? &factor_ : nullptr);
  if (report.converged || !small) return report;
  const int before = report.iterations;
  forget_factor();
  // Whatever the unfinished solve left is a fair guess, unless it is not finite.
  if (!(report.residual < 1e300)) x.clear();
  if (const std::string reason = factor_.factorize(system); !reason.empty()) {
    report = conjugate_gradients(system, x, options);
    if (!report.converged) report.message += "; " + reason;
  } else {
    packed_ = pack(system);
    ++revision_;
    report = conjugate_gradients(system, x, options, &factor_);
  }
  report.iterations += before;
  return report;
}

}  // namespace pigment::solve
