#include "assembly/thermal_force.h"

#include <algorithm>
#include <cmath>

namespace pigment::assembly {

namespace {

// The l-th halving on the way from a step to this part of it: its counter, and whether the part lies in the second half.
struct Halving {
  std::uint64_t counter;
  bool second;
};
Halving halving(const NoiseInterval& interval, int l) {
  const std::uint64_t node = (std::uint64_t{1} << l) + (interval.part >> (interval.level - l));
  return {static_cast<std::uint64_t>(interval.step) | (node << 42), ((interval.part >> (interval.level - 1 - l)) & 1) != 0};
}

}  // namespace

// Half an interval's increment is half of the whole one, plus for the first and minus for the second half something independent
// of equal variance ([levy1940]): per root of the length, (x +- y)/sqrt 2.
std::array<double, 4> path_normals(RandomKey key, const NoiseInterval& interval, std::uint64_t b, std::uint64_t c) {
  std::array<double, 4> x = random_normals(key, static_cast<std::uint64_t>(interval.step), b, c);
  for (int l = 0; l < interval.level; ++l) {
    const auto [counter, second] = halving(interval, l);
    const std::array<double, 4> y = random_normals(key, counter, b, c);
    for (int k = 0; k < 4; ++k) x[k] = (second ? x[k] - y[k] : x[k] + y[k]) * std::sqrt(0.5);
  }
  return x;
}

double path_normal(RandomKey key, const NoiseInterval& interval, std::uint64_t b, std::uint64_t c) {
  double x = random_normal(key, static_cast<std::uint64_t>(interval.step), b, c);
  for (int l = 0; l < interval.level; ++l) {
    const auto [counter, second] = halving(interval, l);
    const double y = random_normal(key, counter, b, c);
    x = (second ? x - y : x + y) * std::sqrt(0.5);
  }
  return x;
}

void add_particle_modes(const solve::ParticleTerm& p, bool rotation, const double (&x)[modes_of_particle], double* f) {
  const double across = std::sqrt(p.across);
  f[0] += across * x[0];
  f[1] += across * x[1];
  f[2] += std::sqrt(p.along) * x[2];
  if (!rotation) return;
  // Rows (U_x, W_y): [across c; c spin]; (U_y, W_x): [across -c; -c spin] (solve/pair_system.h), by their Cholesky factors.
  const double c = p.coupling / across, spin = std::sqrt(std::max(0.0, p.spin_across - c * c));
  f[4] += c * x[0] + spin * x[4];
  f[3] += -c * x[1] + spin * x[3];
  f[5] += std::sqrt(p.spin_along) * x[5];
}

void add_pair_modes(const solve::FullPair& p, bool rotation, bool turned, const double (&x)[modes_of_pair], double* fi, double* fj) {
  const double* n = p.n;
  const double squeeze = std::sqrt(p.squeeze) * x[0];
  // g_s and g_q across n with covariance [a b; b c] (a c >= b^2 but for rounding); three normals projected are two.
  const double root = std::sqrt(p.a), mixed = p.a > 0 ? p.b / root : 0;
  // q changes sign with the order of the pair, s does not.
  const double rest = std::sqrt(std::max(0.0, p.c - mixed * mixed)) * (turned ? -1 : 1);
  const double xn = n[0] * x[2] + n[1] * x[3] + n[2] * x[4], yn = n[0] * x[5] + n[1] * x[6] + n[2] * x[7];
  double gs[3], gq[3];
  for (int d = 0; d < 3; ++d) {
    const double s = x[2 + d] - xn * n[d], q = x[5 + d] - yn * n[d];
    gs[d] = root * s;
    gq[d] = mixed * s + rest * q;
  }
  // Forces and torques of g as in the matrix-vector product.
  const double cross[3] = {gs[1] * n[2] - gs[2] * n[1], gs[2] * n[0] - gs[0] * n[2], gs[0] * n[1] - gs[1] * n[0]};
  for (int d = 0; d < 3; ++d) {
    const double f = squeeze * n[d] + cross[d];
    fi[d] += f;
    fj[d] -= f;
  }
  if (!rotation) return;
  const double twist = std::sqrt(p.twist) * x[1];
  for (int d = 0; d < 3; ++d) {
    const double t = twist * n[d] + gq[d];
    fi[3 + d] += p.l_i * gs[d] + t;
    fj[3 + d] += p.l_j * gs[d] - t;
  }
}

solve::ParticleTerm without_flow(const solve::ParticleTerm& term, const solve::MeanFlow& flow, std::size_t k) {
  solve::ParticleTerm rest = term;
  if (!flow.empty())
    for (std::size_t at = flow.begin[k]; at < flow.begin[k + 1]; ++at) rest.along -= flow.share[at].drag;
  rest.along = std::max(rest.along, 0.0);  // rounding, where drag is all there is
  return rest;
}

// The slip of particle k in slice s is U_k + sum_j c_js U_j (solve/mean_flow.h); its mode is sqrt(b_ks) times that row.
void add_flow_modes(const solve::MeanFlow& flow, std::size_t D, const std::vector<double>& normal, double* f) {
  std::vector<double> slice(flow.slices(), 0.0);
  for (std::size_t k = 0; k + 1 < flow.begin.size(); ++k)
    for (std::size_t at = flow.begin[k]; at < flow.begin[k + 1]; ++at) {
      const double own = std::sqrt(flow.share[at].drag) * normal[at];
      f[k * D + 2] += own;
      slice[flow.share[at].slice] += own;
    }
  for (std::size_t k = 0; k + 1 < flow.begin.size(); ++k)
    for (std::size_t at = flow.begin[k]; at < flow.begin[k + 1]; ++at) f[k * D + 2] += flow.share[at].displaced * slice[flow.share[at].slice];
}

namespace {

struct PairNormals {
  RandomKey near, shear;
  NoiseInterval interval;
  double squeeze(std::uint64_t low, std::uint64_t high) const { return path_normal(near, interval, low, high); }
  std::array<double, 4> first(std::uint64_t low, std::uint64_t high) const { return path_normals(near, interval, low, high); }
  std::array<double, 4> second(std::uint64_t low, std::uint64_t high) const { return path_normals(shear, interval, low, high); }
};

}  // namespace

std::vector<double> thermal_force(const solve::PairSystem& system, const std::vector<std::int64_t>& id, std::uint64_t seed,
                                  const NoiseInterval& interval, double strength) {
  const solve::PairTopology& topology = *system.topology;
  const std::size_t n = topology.particles(), D = static_cast<std::size_t>(system.unknowns_per_particle());
  const int chunks = topology.chunks().count();
  const RandomKey own{seed, Stream::ThermalParticle};
  const PairNormals pair{{seed, Stream::ThermalPair}, {seed, Stream::ThermalShear}, interval};
  std::vector<double> sum((topology.first_slot() + topology.halo_count()) * D, 0.0);
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (int c = 0; c < chunks; ++c) {
      for (int k = topology.chunks().begin[c]; k < topology.chunks().begin[c + 1]; ++k) {
        const auto u = static_cast<std::uint64_t>(id[k]);
        const auto a = path_normals(own, interval, u, 0);
        double x[modes_of_particle] = {a[0], a[1], a[2], a[3], 0, 0};
        if (system.rotation) {
          const auto b = path_normals(own, interval, u, 1);
          x[4] = b[0];
          x[5] = b[1];
        }
        add_particle_modes(without_flow(system.particle[k], system.mean_flow, k), system.rotation, x, &sum[static_cast<std::size_t>(k) * D]);
      }
      for (const solve::SqueezePair& p : system.squeeze[c]) {
        const auto [low, high] = std::minmax({static_cast<std::uint64_t>(id[p.i]), static_cast<std::uint64_t>(id[p.j])});
        const double f = std::sqrt(p.squeeze) * pair.squeeze(low, high);
        for (int d = 0; d < 3; ++d) {
          sum[static_cast<std::size_t>(p.i) * D + d] += f * p.n[d];
          sum[static_cast<std::size_t>(p.target) * D + d] -= f * p.n[d];
        }
      }
      for (const solve::FullPair& p : system.full[c]) {
        const auto [low, high] = std::minmax({static_cast<std::uint64_t>(id[p.i]), static_cast<std::uint64_t>(id[p.j])});
        const auto a = pair.first(low, high), b = pair.second(low, high);
        const double x[modes_of_pair] = {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]};
        add_pair_modes(p, system.rotation, id[p.j] < id[p.i], x, &sum[static_cast<std::size_t>(p.i) * D],
                       &sum[static_cast<std::size_t>(p.target) * D]);
      }
    }
#pragma omp for schedule(static)
    for (int c = 0; c < chunks; ++c)
      for (int k = topology.chunks().begin[c]; k < topology.chunks().begin[c + 1]; ++k)
        for (const std::int32_t* slot = topology.slots_begin(k); slot != topology.slots_end(k); ++slot)
          for (std::size_t d = 0; d < D; ++d) sum[k * D + d] += sum[(topology.first_slot() + *slot) * D + d];
  }
  sum.resize(n * D);
  if (const solve::MeanFlow& flow = system.mean_flow; !flow.empty()) {
    const RandomKey key{seed, Stream::ThermalFlow};
    std::vector<double> normal(flow.share.size());
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t at = flow.begin[k]; at < flow.begin[k + 1]; ++at)
        normal[at] = path_normal(key, interval, static_cast<std::uint64_t>(id[k]), static_cast<std::uint64_t>(flow.share[at].slice));
    add_flow_modes(flow, D, normal, sum.data());
  }
  for (double& f : sum) f *= strength;
  return sum;
}

}  // namespace pigment::assembly
