#pragma once
// Near-field resistance of two unequal spheres: five scalars in a frame-invariant basis.
//
// Pair i, j with gap h, n from i to j, reduced radius R = a_i a_j/(a_i + a_j), kap = (a_i - a_j)/(a_i + a_j), x = h/R.
// Relative motion at the mid-gap point P: v = u_i(P) - u_j(P), w = omega_i - omega_j; v_n = n.v, w_n = n.w,
// s = n x v, q = w - w_n n. The pair dissipates (per unit viscosity)
//   E = Kn v_n^2 + Kt w_n^2 + Ks |s|^2 + Kp |q + t s|^2 - 2 Ksp (q + t s).s,   t = kap/(2R)
//     = Kn v_n^2 + Kt w_n^2 + A |s|^2 + 2 B s.q + C |q|^2.
// Forces and torques are the derivatives of E/2: symmetric, positive semi-definite where A C >= B^2, and exactly zero
// for rigid motion. The squeeze, twist, shear and pump modes are those of section 3.2.2 of [sand2010]; the functions are
// a fit to exact two-sphere solutions (data/resistance/relative_K_basis.csv) that adds to isolated Stokes drag: within
// 0.01 % (squeeze), 0.07 % (shear and pump), 0.34 % (twist) of the exact relative resistance for gaps up to 0.1 of the
// smaller radius, at every size ratio and against a plane.

namespace pigment::resistance {

// Per unit viscosity; um (squeeze, shear), um^2 (shear_pump), um^3 (twist, pump).
struct PairScalars {
  double squeeze = 0;     // Kn
  double twist = 0;       // Kt
  double shear = 0;       // Ks
  double pump = 0;        // Kp
  double shear_pump = 0;  // Ksp, carries the sign of a_i - a_j
};

// The same in the basis (s, q): what the operator uses.
struct PairOperatorScalars {
  double squeeze = 0, twist = 0, a = 0, b = 0, c = 0;
};

// How far lubrication acts, in smaller radii: one up to `begin`, zero from `end` on, a C2 polynomial between. Beyond
// about half a radius the exact shear block is indefinite at equal size, hence its shorter taper.
struct LubricationTaper {
  double squeeze_begin = 0.5, squeeze_end = 1.5;
  double shear_begin = 0.2, shear_end = 0.4;
};
inline constexpr LubricationTaper no_taper{1e300, 2e300, 1e300, 2e300};
double taper(double gap_over_smaller_radius, double begin, double end);

// Lubrication theory ends where the surfaces do: overlapping surfaces keep the resistance of a millionth of the smaller
// radius.
double hydrodynamic_gap(double gap, double smaller_radius);

// Untapered scalars, gap > 0; either radius may be infinite (a plane; R is then the finite radius).
PairScalars pair_scalars(double radius_i, double radius_j, double gap);
// Tapered; zero beyond the taper.
PairScalars tapered_pair_scalars(double radius_i, double radius_j, double gap, const LubricationTaper&);
PairOperatorScalars operator_scalars(const PairScalars&, double radius_i, double radius_j);

// The impulse with which the leading singular part of the squeeze scalar, c/h with c = 6 pi R^2, resists a step from gap h0 to
// h1 is c ln(h0/h1), which no gap can cross. Newton's linearisation of it about a guess g of h1, for a step of length dt:
//   force = -(c/h0 + coefficient) dh/dt + impulse/dt,  coefficient = c (1/g - 1/h0),  impulse = c (ln(h0/g) + 1 - h0/g)
// (c/h0 stands in the scalar already; the force repels where positive). All gaps > 0; times the viscosity.
double squeeze_constant(double reduced_radius);  // c, um^2
struct SqueezeStep {
  double coefficient = 0;  // um
  double impulse = 0;      // um^2
};
SqueezeStep squeeze_step(double reduced_radius, double gap_begin, double gap_guess);
// The same where the scalar was taken at another gap than h0: 1/h0 in the force and in the coefficient is then that gap's.
SqueezeStep squeeze_step(double reduced_radius, double gap_begin, double gap_guess, double gap_at);

}  // namespace pigment::resistance
