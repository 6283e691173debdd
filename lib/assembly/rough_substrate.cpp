#include "assembly/rough_substrate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "assembly/gap_guess.h"
#include "assembly/step_force.h"
#include "forces/surface_spring.h"
#include "resistance/scene_resistance.h"
#include "resistance/source_forms.h"

namespace pigment::assembly {

namespace {

using resistance::BoundaryScalars;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int at(int row, int column) { return row * (row + 1) / 2 + column; }

BoundaryScalars scaled(BoundaryScalars w, double factor) {
  w.perpendicular *= factor;
  w.parallel *= factor;
  w.coupling *= factor;
  w.twist *= factor;
  w.rolling *= factor;
  return w;
}

}  // namespace

RoughSubstrate::RoughSubstrate(const Interactions& interactions, std::vector<double> radius, std::vector<double> potential)
    : interactions_(interactions), field_(*interactions.height_field), radius_(std::move(radius)), potential_(std::move(potential)),
      contacts_(radius_.size()), far_(radius_.size()) {}

RoughSubstrate::Contact RoughSubstrate::contact_at(int k, const HeightField::Foot& foot) const {
  const resistance::HydrodynamicsParameters& model = interactions_.hydrodynamics;
  const double a = radius_[k], gap = foot.distance - a;
  Contact c{foot, {gap, a, infinity, potential_[k], interactions_.substrate->surface_potential.value_or(potential_[k])}, gap, {}, 0, a, 1};
  // The gap opens as gap + (k1 x^2 + k2 y^2)/2. The pressure of a squeezed paraboloid adds up to 12 pi mu U/(h sqrt(k1 k2) (k1 + k2))
  // [cox1974], its forces to those of the plane times 1/(a sqrt(k1 k2)) [derjaguin1934]. In a hollow as round as the particle both
  // would be infinite; the contact is then no point, and these are held at what a hollow of 1.25 radii has.
  constexpr double flattest = 0.2;
  const double k1 = std::max(flattest, 1 + a * foot.curvature) / a, k2 = std::max(flattest, 1 + a * foot.least_curvature) / a;
  c.derjaguin = 1 / (a * std::sqrt(k1 * k2));
  if (!interactions_.lubrication()) return c;
  const double h = resistance::hydrodynamic_gap(gap, a);
  c.squeeze_weight = resistance::taper(h / a, model.taper.squeeze_begin, model.taper.squeeze_end);
  if (model.model == resistance::HydrodynamicsParameters::Model::Thesis && foot.curvature * a > 1) {
    const double b = resistance::corner_share * a;
    c.scalars = resistance::source_corner_increment(a, h, model.taper);  // tapered over its own, smaller, radius
    c.squeeze_weight = resistance::taper(h / b, model.taper.squeeze_begin, model.taper.squeeze_end);
    c.squeeze_radius = a * b / (a + b);
  } else {
    c.scalars = resistance::wall_term(model, a, gap);
    if (model.model == resistance::HydrodynamicsParameters::Model::Exact) {
      const double square = 2 / (std::sqrt(k1 * k2) * (k1 + k2));
      c.scalars.perpendicular += 6 * std::numbers::pi * (square - a * a) / h;
      c.squeeze_radius = std::sqrt(square);
    }
    c.scalars = scaled(c.scalars, c.squeeze_weight);
  }
  return c;
}

void RoughSubstrate::begin(const std::vector<Vec3>& position, const Laws& laws) {
  double cutoff = 0;
  for (const auto& law : laws) cutoff = std::max(cutoff, law->cutoff_gap());
  const resistance::LubricationTaper& taper = interactions_.hydrodynamics.taper;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < radius_.size(); ++k) {
    const double a = radius_[k];
    contacts_[k].clear();
    double nearest = infinity;
    for (const HeightField::Foot& foot : field_.feet(position[k], a + std::max(reach(a), cutoff))) {
      contacts_[k].push_back(contact_at(static_cast<int>(k), foot));
      nearest = std::min(nearest, foot.distance - a);
    }
    far_[k] = {};
    if (!interactions_.lubrication()) continue;
    const double share = 1 - resistance::taper(nearest / a, taper.squeeze_begin, taper.squeeze_end);
    // Where the plane at the mean height is nearer than the contacts' full range it is they that act.
    const double h = std::max(position[k].z() - field_.mean_height() - a, taper.squeeze_begin * a);
    if (share > 0) far_[k] = scaled(resistance::wall_term(interactions_.hydrodynamics, a, h), share);
  }
}

void RoughSubstrate::add_far(int k, double mu, double absorption, solve::ParticleTerm& t, double* f) const {
  const BoundaryScalars& w = far_[k];
  t.along += mu * w.perpendicular;
  t.across += mu * w.parallel;
  t.coupling += mu * w.coupling;
  t.spin_along += mu * w.twist;
  t.spin_across += mu * w.rolling;
  if (interactions_.substrate->suction == forces::SubstrateParameters::Suction::Uniform) f[2] -= mu * w.perpendicular * absorption;
}

RoughSubstrate::Sum RoughSubstrate::sum_of(int k, const Laws& laws, double mu, double dt, bool implicit, double absorption) const {
  Sum sum{};
  const bool uniform = interactions_.substrate->suction == forces::SubstrateParameters::Suction::Uniform;
  for (const Contact& c : contacts_[k]) {
    const Vec3& n = c.foot.normal;
    double perpendicular = mu * c.scalars.perpendicular, push = 0, stiffness = 0;
    const double guess = c.geometry.gap;
    if (c.squeeze_weight > 0 && guess != c.gap_begin && guess > 0 && c.gap_begin > 0) {
      const resistance::SqueezeStep step = resistance::squeeze_step(c.squeeze_radius, c.gap_begin, guess);
      perpendicular += mu * c.squeeze_weight * step.coefficient;
      push += mu * c.squeeze_weight * step.impulse / dt;
    }
    const double parallel = mu * c.scalars.parallel, coupling = mu * c.scalars.coupling;
    if (uniform)
      for (int d = 0; d < 3; ++d)
        sum.force[d] -= absorption * (parallel * (d == 2) + (perpendicular - parallel) * n[d] * n[2]);
    if (uniform) {  // the torque of the same: n x e_z
      sum.force[3] -= absorption * coupling * n[1];
      sum.force[4] += absorption * coupling * n[0];
    }
    if (interactions_.substrate->colloidal)
      for (const auto& law : laws) {
        const forces::PairTerm t = law->switched(c.geometry);
        push += c.derjaguin * t.force;
        stiffness += c.derjaguin * t.stiffness;
      }
    // The surface stops particles whatever the forces.
    if (guess < 0) {
      push -= forces::contact_stiffness * guess;
      stiffness += forces::contact_stiffness;
    }
    if (implicit) {
      stiffness = std::max(stiffness, 0.0);
      push += stiffness * (guess - c.gap_begin);
      perpendicular += dt * stiffness;
    }
    for (int r = 0; r < 3; ++r) {
      sum.force[r] += push * n[r];
      for (int q = 0; q <= r; ++q) {
        const double nn = n[r] * n[q], projection = (r == q ? 1.0 : 0.0) - nn;
        sum.block[at(r, q)] += perpendicular * nn + parallel * projection;
        sum.block[at(r + 3, q + 3)] += mu * (c.scalars.twist * nn + c.scalars.rolling * projection);
      }
    }
    // coupling (n x U): [0 -nz ny; nz 0 -nx; -ny nx 0]
    sum.block[at(3, 1)] -= coupling * n[2];
    sum.block[at(3, 2)] += coupling * n[1];
    sum.block[at(4, 0)] += coupling * n[2];
    sum.block[at(4, 2)] -= coupling * n[0];
    sum.block[at(5, 0)] -= coupling * n[1];
    sum.block[at(5, 1)] += coupling * n[0];
  }
  return sum;
}

void RoughSubstrate::add_near(int k, const Laws& laws, double mu, double dt, bool implicit, double absorption, int D, double* f,
                              std::vector<solve::OwnBlock>& blocks) const {
  if (contacts_[k].empty()) return;
  const Sum sum = sum_of(k, laws, mu, dt, implicit, absorption);
  for (int d = 0; d < D; ++d) f[d] += sum.force[d];
  solve::OwnBlock block{k, {}};
  std::copy_n(sum.block, D * (D + 1) / 2, block.entry);
  blocks.push_back(block);
}

double RoughSubstrate::force_along_z(int k, const Laws& laws, double mu, double dt, bool implicit, double absorption, int D, const double* u) const {
  const bool uniform = interactions_.substrate->suction == forces::SubstrateParameters::Suction::Uniform;
  double force = -mu * far_[k].perpendicular * (u[2] + (uniform ? absorption : 0));
  if (contacts_[k].empty()) return force;
  const Sum sum = sum_of(k, laws, mu, dt, implicit, absorption);
  force += sum.force[2];
  for (int d = 0; d < D; ++d) force -= sum.block[d <= 2 ? at(2, d) : at(d, 2)] * u[d];
  return force;
}

void RoughSubstrate::refine(int k, const Laws& laws, double mu, double dt, const Vec3& end, bool newton, bool& again, bool& crossed) {
  static const Laws none;
  bool was_open = true, near = false;
  for (Contact& c : contacts_[k]) {
    // A foot may vanish, and what is followed from it arrives at another: then the plane that it was tangent to goes on for the
    // step, and whatever it hides is found below.
    const HeightField::Foot foot = field_.follow(c.foot, end);
    const bool same = std::hypot(foot.x - c.foot.x, foot.y - c.foot.y) < 0.5 * field_.resolution();
    const Vec3 point(c.foot.x, c.foot.y, field_.height(c.foot.x, c.foot.y));
    const double gap = (same ? foot.distance : c.foot.normal.dot(end - point)) - radius_[k];
    double& guess = c.geometry.gap;
    was_open = was_open && c.gap_begin > 0;
    near = near || !same || gap < 0.5 * radius_[k];
    if (interactions_.lubrication() && c.gap_begin > 0) {
      if (gap <= 0 && !newton) crossed = true;
      if (newton && off_guess(gap, guess, guess != c.gap_begin)) {
        const double singular = mu * c.squeeze_weight * resistance::squeeze_constant(c.squeeze_radius) / dt;
        const StepForce force{interactions_.substrate->colloidal ? laws : none, c.geometry, c.gap_begin, c.gap_begin, singular,
                              mu * c.scalars.perpendicular / dt - singular / c.gap_begin, 0, c.derjaguin};
        guess = next_gap(gap, guess, force.tangent(gap), force);
        again = true;
      }
    } else if ((gap < 0) != (guess < 0)) {
      guess = gap;
      again = true;
    }
  }
  // A contact that was none at the beginning has no guess: the step is one too long.
  if (near && was_open && interactions_.lubrication() && this->gap(end, radius_[k]) <= 0) crossed = true;
}

double RoughSubstrate::gap(const Vec3& position, double radius) const {
  return field_.gap(position, radius, reach(radius));
}

}  // namespace pigment::assembly
