#pragma once
// Four doubles at a time, by the compiler's vector extension: two SSE2 operations or one AVX one, with the same bits either way
// (a fused multiply-add only where it is asked for, and then a call where the processor has none). Particles' vectors are kept in strides of 4 or 8 so that one load brings a velocity.
#include <cstring>

namespace pigment::solve {

inline constexpr int lanes = 4;
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));

#define PIGMENT_INLINE inline __attribute__((always_inline))
// A function compiled twice: for any x86-64, and for processors with AVX2 and FMA, which came together.
#if defined(__x86_64__)
#define PIGMENT_WIDE __attribute__((target("avx2,fma")))
#define PIGMENT_HAS_WIDE 1
#else
#define PIGMENT_WIDE
#define PIGMENT_HAS_WIDE 0
#endif

// Whether this processor runs the AVX2 versions.
inline bool wide_processor() {
#if PIGMENT_HAS_WIDE
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return wide;
#else
  return false;
#endif
}

PIGMENT_INLINE void load(Lanes& v, const double* at) { std::memcpy(&v, at, sizeof v); }
PIGMENT_INLINE void store(double* at, const Lanes& v) { std::memcpy(at, &v, sizeof v); }
// A vector of either precision: four doubles, or eight numbers of single precision.
template <typename T>
inline constexpr int lanes_of = static_cast<int>(lanes * sizeof(double) / sizeof(T));
typedef float EightLanes __attribute__((vector_size(lanes * sizeof(double))));
template <typename T>
struct VectorOf;
template <>
struct VectorOf<double> {
  typedef Lanes type;
};
template <>
struct VectorOf<float> {
  typedef EightLanes type;
};
PIGMENT_INLINE void load(EightLanes& v, const float* at) { std::memcpy(&v, at, sizeof v); }
PIGMENT_INLINE void store(float* at, const EightLanes& v) { std::memcpy(at, &v, sizeof v); }
// Four numbers of single precision.
typedef float SingleLanes __attribute__((vector_size(lanes * sizeof(float))));
PIGMENT_INLINE void load_single(Lanes& v, const float* at) {
  SingleLanes single;
  std::memcpy(&single, at, sizeof single);
  v = __builtin_convertvector(single, Lanes);
}
PIGMENT_INLINE void store_single(float* at, const Lanes& v) {
  const SingleLanes single = __builtin_convertvector(v, SingleLanes);
  std::memcpy(at, &single, sizeof single);
}
PIGMENT_INLINE void add_to(double* at, const Lanes& v) {
  Lanes sum;
  load(sum, at);
  sum += v;
  store(at, sum);
}
// sum - a * b in one rounding.
PIGMENT_INLINE void subtract_fused(Lanes& sum, const Lanes& a, double b) {
  sum = Lanes{__builtin_fma(-a[0], b, sum[0]), __builtin_fma(-a[1], b, sum[1]), __builtin_fma(-a[2], b, sum[2]), __builtin_fma(-a[3], b, sum[3])};
}
PIGMENT_INLINE void subtract_fused(EightLanes& sum, const EightLanes& a, float b) {
  sum = EightLanes{__builtin_fmaf(-a[0], b, sum[0]), __builtin_fmaf(-a[1], b, sum[1]), __builtin_fmaf(-a[2], b, sum[2]), __builtin_fmaf(-a[3], b, sum[3]),
                   __builtin_fmaf(-a[4], b, sum[4]), __builtin_fmaf(-a[5], b, sum[5]), __builtin_fmaf(-a[6], b, sum[6]), __builtin_fmaf(-a[7], b, sum[7])};
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
