#include "base/random.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace pigment {

std::array<std::uint64_t, 4> random_words(RandomKey key, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  // The seed stands in the key, not in the counter, so that two seeds never share a sequence.
  const r123::Philox4x64::key_type k = {{key.seed, static_cast<std::uint64_t>(key.stream)}};
  const r123::Philox4x64::ctr_type counter = {{a, b, c, 0}};
  const auto words = r123::Philox4x64{}(counter, k);
  return {words[0], words[1], words[2], words[3]};
}

std::array<double, 4> random_uniforms(RandomKey key, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  const auto words = random_words(key, a, b, c);
  std::array<double, 4> u{};
  // 52 bits and a half: strictly inside (0, 1), symmetric about 1/2.
  for (int i = 0; i < 4; ++i) u[i] = (static_cast<double>(words[i] >> 12) + 0.5) * 0x1p-52;
  return u;
}

std::array<double, 4> random_normals(RandomKey key, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  const auto u = random_uniforms(key, a, b, c);
  const double r0 = std::sqrt(-2 * std::log(u[0])), r1 = std::sqrt(-2 * std::log(u[2]));
  const double t0 = 2 * std::numbers::pi * u[1], t1 = 2 * std::numbers::pi * u[3];
  return {r0 * std::cos(t0), r0 * std::sin(t0), r1 * std::cos(t1), r1 * std::sin(t1)};
}

double random_normal(RandomKey key, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  const auto u = random_uniforms(key, a, b, c);
  return std::sqrt(-2 * std::log(u[0])) * std::cos(2 * std::numbers::pi * u[1]);
}

}  // namespace pigment
