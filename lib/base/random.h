#pragma once
// Random numbers without a generator state: a pure function of (seed, stream, counter), Philox4x64 of Random123
// (Salmon, Moraes, Dror & Shaw, SC11, 2011). Thread count, order of evaluation and restarts never change a number.
#include <array>
#include <cstdint>

namespace pigment {

// Every use of randomness has its stream; the key is (seed, stream). Never renumber: results would change.
enum class Stream : std::uint64_t {
  PackingSizes = 1,
  PackingPositions = 2,
  PackingMonteCarlo = 3,
  BrownianForce = 4,
  Calibration = 5,
  Tests = 6,
  PorePoints = 7,
  ThermalParticle = 8,
  ThermalPair = 9,
  ThermalShear = 10,
  ThermalFlow = 11,
};

struct RandomKey {
  std::uint64_t seed;
  Stream stream;
};

// Four independent 64-bit words for the counter (a, b, c).
std::array<std::uint64_t, 4> random_words(RandomKey, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0);
// Four uniforms in the open interval (0, 1).
std::array<double, 4> random_uniforms(RandomKey, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0);
// Four standard normals (Box-Muller on the above).
std::array<double, 4> random_normals(RandomKey, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0);
// The first of them.
double random_normal(RandomKey, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0);

}  // namespace pigment
