#pragma once
// The arithmetic of one pair and one particle, for what takes them one at a time; solve/pair_product.cpp has it four at a time.
#include "solve/pair_system.h"

namespace pigment::solve {

template <int D>
inline void add_particle(const ParticleTerm& p, const double* x, double* y) {
  if constexpr (D == 6) {
    // W x z = (W_y, -W_x), z x U = (-U_y, U_x)
    y[0] = p.across * x[0] + p.coupling * x[4];
    y[1] = p.across * x[1] - p.coupling * x[3];
    y[2] = p.along * x[2];
    y[3] = p.spin_across * x[3] - p.coupling * x[1];
    y[4] = p.spin_across * x[4] + p.coupling * x[0];
    y[5] = p.spin_along * x[5];
  } else {
    y[0] = p.across * x[0];
    y[1] = p.across * x[1];
    y[2] = p.along * x[2];
  }
}

template <int D>
inline void add_squeeze_pair(const SqueezePair& p, const double* xi, const double* xj, double* yi, double* yj) {
  const double f = p.squeeze * (p.n[0] * (xi[0] - xj[0]) + p.n[1] * (xi[1] - xj[1]) + p.n[2] * (xi[2] - xj[2]));
  for (int d = 0; d < 3; ++d) {
    yi[d] += f * p.n[d];
    yj[d] -= f * p.n[d];
  }
}

template <int D>
inline void add_full_pair(const FullPair& p, const double* xi, const double* xj, double* yi, double* yj) {
  const double n0 = p.n[0], n1 = p.n[1], n2 = p.n[2];
  const double v0 = xi[0] - xj[0], v1 = xi[1] - xj[1], v2 = xi[2] - xj[2];
  const double vn = n0 * v0 + n1 * v1 + n2 * v2;
  // n x (u_i - u_j)
  double s0 = n1 * v2 - n2 * v1, s1 = n2 * v0 - n0 * v2, s2 = n0 * v1 - n1 * v0;
  if constexpr (D == 6) {
    // n x (m x n) = m - (n.m) n with m = l_i w_i + l_j w_j
    const double m0 = p.l_i * xi[3] + p.l_j * xj[3], m1 = p.l_i * xi[4] + p.l_j * xj[4], m2 = p.l_i * xi[5] + p.l_j * xj[5];
    const double mn = n0 * m0 + n1 * m1 + n2 * m2;
    s0 += m0 - mn * n0;
    s1 += m1 - mn * n1;
    s2 += m2 - mn * n2;
    const double w0 = xi[3] - xj[3], w1 = xi[4] - xj[4], w2 = xi[5] - xj[5];
    const double wn = n0 * w0 + n1 * w1 + n2 * w2;
    const double q0 = w0 - wn * n0, q1 = w1 - wn * n1, q2 = w2 - wn * n2;
    const double g0 = p.a * s0 + p.b * q0, g1 = p.a * s1 + p.b * q1, g2 = p.a * s2 + p.b * q2;
    const double tn = p.twist * wn;
    const double t0 = p.b * s0 + p.c * q0 + tn * n0, t1 = p.b * s1 + p.c * q1 + tn * n1, t2 = p.b * s2 + p.c * q2 + tn * n2;
    const double fn = p.squeeze * vn;
    const double f0 = fn * n0 + g1 * n2 - g2 * n1, f1 = fn * n1 + g2 * n0 - g0 * n2, f2 = fn * n2 + g0 * n1 - g1 * n0;
    yi[0] += f0;
    yi[1] += f1;
    yi[2] += f2;
    yi[3] += p.l_i * g0 + t0;
    yi[4] += p.l_i * g1 + t1;
    yi[5] += p.l_i * g2 + t2;
    yj[0] -= f0;
    yj[1] -= f1;
    yj[2] -= f2;
    yj[3] += p.l_j * g0 - t0;
    yj[4] += p.l_j * g1 - t1;
    yj[5] += p.l_j * g2 - t2;
  } else {
    const double g0 = p.a * s0, g1 = p.a * s1, g2 = p.a * s2;
    const double fn = p.squeeze * vn;
    const double f0 = fn * n0 + g1 * n2 - g2 * n1, f1 = fn * n1 + g2 * n0 - g0 * n2, f2 = fn * n2 + g0 * n1 - g1 * n0;
    yi[0] += f0;
    yi[1] += f1;
    yi[2] += f2;
    yj[0] -= f0;
    yj[1] -= f1;
    yj[2] -= f2;
  }
}

}  // namespace pigment::solve
