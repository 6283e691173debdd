#pragma once
// Four doubles at a time, by the compiler's vector extension: two SSE2 operations or one AVX one, with the same bits either way
// (no fused multiply-add). Particles' vectors are kept in strides of 4 or 8 so that one load brings a velocity.
#include <cstring>

namespace pigment::solve {

inline constexpr int lanes = 4;
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));

#define PIGMENT_INLINE inline __attribute__((always_inline))
// A function compiled twice: for any x86-64, and for processors with AVX2.
#if defined(__x86_64__)
#define PIGMENT_WIDE __attribute__((target("avx2")))
#define PIGMENT_HAS_WIDE 1
#else
#define PIGMENT_WIDE
#define PIGMENT_HAS_WIDE 0
#endif

// Whether this processor runs the AVX2 versions.
inline bool wide_processor() {
#if PIGMENT_HAS_WIDE
  static const bool wide = __builtin_cpu_supports("avx2");
  return wide;
#else
  return false;
#endif
}

PIGMENT_INLINE void load(Lanes& v, const double* at) { std::memcpy(&v, at, sizeof v); }
PIGMENT_INLINE void store(double* at, const Lanes& v) { std::memcpy(at, &v, sizeof v); }
PIGMENT_INLINE void add_to(double* at, const Lanes& v) {
  Lanes sum;
  load(sum, at);
  sum += v;
  store(at, sum);
}
// Rows become columns.
PIGMENT_INLINE void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}
PIGMENT_INLINE double sum_of(const Lanes& v) { return (v[0] + v[1]) + (v[2] + v[3]); }

}  // namespace pigment::solve
