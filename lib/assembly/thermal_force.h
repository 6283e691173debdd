#pragma once
// The random force that fluctuation and dissipation ask for: <F F^T> = 2 kT R/dt, R the whole resistance of the layer.
//
// R is a sum of modes that are positive semi-definite each: a particle's drag with what the boundaries add to it (a block of two
// for every direction that couples to a rotation), the squeeze, the twist, and the coupled shear and pump of every pair, and
// with hindered drag the slip of every particle against the liquid of each slice.
// The force is the sum of their square roots times independent normals, O(N), without factorising R ([ball1997]).
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "solve/pair_system.h"

namespace pigment::assembly {

// A step, or the part-th of 2^level equal parts of it. The numbers of the parts are those of one Brownian path: the parts of
// an interval add up to it (a Brownian bridge), so that a step taken again in shorter ones keeps its path.
struct NoiseInterval {
  std::int64_t step = 0;
  int level = 0;          // 0..20
  std::uint64_t part = 0;
};

// Four standard normals for this interval and the counters (b, c); and the first of them alone.
std::array<double, 4> path_normals(RandomKey, const NoiseInterval&, std::uint64_t b, std::uint64_t c);
double path_normal(RandomKey, const NoiseInterval&, std::uint64_t b, std::uint64_t c);

// resistance: R alone, no stiffness. id: of every particle, in the system's order. strength: sqrt(2 kT/dt), dt the length of
// the interval. Returns forces and, with rotation, torques, D a particle, in the system's order (pN, pN um).
// A pure function of seed, interval, and the ids of particles and pairs (a pair is listed once, by its nearest image; the order
// of the two does not matter), so that neither threads nor the order of the list nor a restart change a number.
std::vector<double> thermal_force(const solve::PairSystem& resistance, const std::vector<std::int64_t>& id, std::uint64_t seed,
                                  const NoiseInterval&, double strength);

// What the modes of one pair or one particle add for given normals; the tests sum their outer products.
constexpr int modes_of_pair = 8, modes_of_particle = 6;
void add_particle_modes(const solve::ParticleTerm&, bool rotation, const double (&normal)[modes_of_particle], double* force);
// `turned`: the second of the pair has the smaller id.
void add_pair_modes(const solve::FullPair&, bool rotation, bool turned, const double (&normal)[modes_of_pair], double* force_i,
                    double* force_j);

// One normal a share of the mean flow. The drag of the shares stands in the particles' `along` too: whoever adds both sets of
// modes takes it out there (without_flow).
solve::ParticleTerm without_flow(const solve::ParticleTerm&, const solve::MeanFlow&, std::size_t particle);
void add_flow_modes(const solve::MeanFlow&, std::size_t unknowns_per_particle, const std::vector<double>& normal, double* force);

}  // namespace pigment::assembly
