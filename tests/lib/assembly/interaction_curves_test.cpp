#include "assembly/interaction_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/table.h"

using namespace pigment;
using namespace pigment::assembly;
using std::numbers::pi;

namespace {

constexpr double viscosity = 0.7;

Liquid thin() {
  LiquidParameters liquid;
  liquid.viscosity = viscosity;
  return liquid_at(liquid, 298.15);
}

Interactions wet() {
  Interactions in;
  in.substrate.emplace();
  return in;
}

Interactions with_laws(const std::string& block) {
  Interactions in = wet();
  auto document = config::Document::from_text("colloidal: " + block);
  in.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  document.check();
  return in;
}

Facing pair_of(double a, double b) { return {Partner::Sphere, a, b, -25, -25}; }
Facing wall_of(double a) { return {Partner::Wall, a, 0, -25, 0}; }
Facing surface_of(double a) { return {Partner::Surface, a, 0, -25, 0}; }

void expect_zero(const ResistanceScalars& k) {
  for (double value : {k.kn, k.kt, k.ks, k.kp, k.ksp}) EXPECT_EQ(value, 0);
}

}  // namespace

// Exact solutions; sphere a of radius 5, b of 1. The term's own functions have errors of 0.01 to 0.3 % of the
// term plus isolated drag; close to contact the term is the larger part.
TEST(InteractionCurves, PairTermIsTheExactOneTimesTheViscosity) {
  const auto table = test::read_table("relative_K_basis.csv");
  const InteractionEvaluator evaluator(wet(), thin());
  int rows = 0;
  for (std::size_t k = 0; k < table.at("lambda").size(); ++k) {
    const double lambda = table.at("lambda")[k], gap = table.at("gap_over_b")[k];
    if (lambda != 0.2 || gap > 1e-3) continue;
    ++rows;
    const double R = 5.0 / 6, b = 1, a = 5;
    const ResistanceScalars term = evaluator.resistance(pair_of(a, b), gap), swapped = evaluator.resistance(pair_of(b, a), gap);
    EXPECT_NEAR(term.kn / viscosity, table.at("Kn/(6piR)")[k] * 6 * pi * R, 1e-3 * term.kn / viscosity);
    EXPECT_NEAR(term.ks / viscosity, table.at("Ks/(2piR)")[k] * 2 * pi * R, 5e-3 * term.ks / viscosity);
    EXPECT_NEAR(term.kp / viscosity, table.at("Kp/(4.8piR^3)")[k] * 4.8 * pi * R * R * R, 5e-3 * term.kp / viscosity);
    const double exact_twist = table.at("Kt/(8piR^3)")[k] * 8 * pi * R * R * R, isolated_twist = 8 * pi * 125.0 / 126;
    EXPECT_NEAR(term.kt / viscosity, exact_twist, 3.5e-3 * (exact_twist + isolated_twist));
    EXPECT_NEAR(term.ksp / viscosity, table.at("Ksp/(piR^2)")[k] * pi * R * R, 5e-3 * std::sqrt(term.ks * term.kp) / viscosity);
    EXPECT_EQ(term.kn, swapped.kn);
    EXPECT_EQ(term.ksp, -swapped.ksp);
  }
  EXPECT_GT(rows, 10);
}

// Columns and signs of the tables: both hold for a boundary below the sphere.
TEST(InteractionCurves, BoundaryTermsAreTheExactIncrements) {
  const InteractionEvaluator evaluator(wet(), thin());
  const auto check = [&](const char* file, const char* parallel, const char* coupling, const char* rolling, Partner partner) {
    const auto table = test::read_table(file);
    const double a = 0.4, drag = 6 * pi * viscosity * a, torque = 8 * pi * viscosity * a * a * a;
    for (std::size_t k = 0; k < table.at("gap_over_a").size(); ++k) {
      const double x = table.at("gap_over_a")[k];
      const ResistanceScalars term = evaluator.resistance({partner, a, 0, 0, 0}, x * a);
      // 0.02 % of the whole resistance is what the functions claim.
      EXPECT_NEAR(1 + term.kn / drag, table.at("F_perp")[k], 2e-4 * table.at("F_perp")[k]) << x;
      EXPECT_NEAR(1 + term.ks / drag, table.at(parallel)[k], 2e-4 * table.at(parallel)[k]) << x;
      EXPECT_NEAR(1 + term.kp / torque, table.at(rolling)[k], 2e-4 * table.at(rolling)[k]) << x;
      EXPECT_NEAR(1 + term.kt / torque, table.at("T_twist")[k], 2e-4 * table.at("T_twist")[k]) << x;
      EXPECT_NEAR(term.ksp / (drag * a), table.at(coupling)[k], 2e-4 * std::sqrt(table.at(parallel)[k] * table.at(rolling)[k])) << x;
    }
  };
  check("wall_resistance.csv", "F_par(Ft*)", "F_rot(Fr*)", "T_rot(Tr*)", Partner::Wall);
  check("free_surface.csv", "F_par", "F_rot", "T_rot", Partner::Surface);
}

TEST(InteractionCurves, TaperEndsThePairTermUnlessLeftOut) {
  const InteractionEvaluator tapered(wet(), thin()), whole(wet(), thin(), Reach::Untapered);
  const Facing f = pair_of(1, 3);
  EXPECT_EQ(tapered.resistance(f, 0.2).ks, whole.resistance(f, 0.2).ks);
  EXPECT_LT(tapered.resistance(f, 0.3).ks, whole.resistance(f, 0.3).ks);
  EXPECT_EQ(tapered.resistance(f, 0.5).kn, whole.resistance(f, 0.5).kn);
  expect_zero(tapered.resistance(f, 1.5));
  EXPECT_GT(whole.resistance(f, 1.5).kn, 0);
}

TEST(InteractionCurves, OverlapKeepsTheResistanceOfAMillionth) {
  const InteractionEvaluator evaluator(wet(), thin());
  for (const Facing& f : {pair_of(1, 3), wall_of(1), surface_of(1)}) {
    EXPECT_EQ(evaluator.resistance(f, -0.1).kn, evaluator.resistance(f, 1e-6).kn);
    EXPECT_EQ(evaluator.resistance(f, 0).ksp, evaluator.resistance(f, 1e-6).ksp);
  }
}

TEST(InteractionCurves, WhatTheSceneDoesNotHaveIsZero) {
  Interactions in = with_laws("{van_der_waals: {}}");
  in.hydrodynamics.model = resistance::HydrodynamicsParameters::Model::Drag;
  for (const Facing& f : {pair_of(1, 3), wall_of(1), surface_of(1)}) expect_zero(InteractionEvaluator(in, thin()).resistance(f, 0.01));

  in = with_laws("{van_der_waals: {}}");
  in.substrate->colloidal = false;
  EXPECT_EQ(InteractionEvaluator(in, thin()).total(wall_of(1), 0.01).force, 0);
  EXPECT_GT(InteractionEvaluator(in, thin()).resistance(wall_of(1), 0.01).kn, 0);
  EXPECT_EQ(InteractionEvaluator(in, thin()).colloidal("born", pair_of(1, 1), 0.0003).force, 0);
  EXPECT_EQ(InteractionEvaluator(in, thin()).total(surface_of(1), 0.01).force, 0);

  in.substrate.reset();
  EXPECT_EQ(InteractionEvaluator(in, thin()).total(wall_of(1), 0.01).force, 0);
  expect_zero(InteractionEvaluator(in, thin()).resistance(wall_of(1), 0.01));
}

TEST(InteractionCurves, TheSurfaceOfASceneResistsFromItsRoughnessOn) {
  Interactions in = wet();
  in.free_surface.emplace();
  in.free_surface->roughness = 0.01;
  const InteractionEvaluator rough(in, thin()), smooth(wet(), thin());
  EXPECT_EQ(rough.resistance(surface_of(1), 0.001).kn, smooth.resistance(surface_of(1), 0.01).kn);
  EXPECT_EQ(rough.resistance(surface_of(1), 0.02).kn, smooth.resistance(surface_of(1), 0.02).kn);
}

// By hand: (19) at h = 10 nm, R = 0.25 um, A = 1e-21 J, lambda = 100 nm: A R lambda (lambda + 22.232 h)/(6 h^2 (lambda + 11.116 h)^2).
TEST(InteractionCurves, ForcesAgainstHandValues) {
  const InteractionEvaluator evaluator(with_laws("{van_der_waals: {}, electrostatic: {debye_length: 5 nm}}"), thin());
  const double h = 0.01, attraction = 1e-3 * 0.25 * 0.1 * (0.1 + 22.232 * h) / (6 * h * h * std::pow(0.1 + 11.116 * h, 2));
  const Facing f = pair_of(0.5, 0.5);
  EXPECT_NEAR(evaluator.colloidal("van_der_waals", f, h).force, -attraction, 1e-12);
  // (17): 4 pi eps R psi^2 kappa e/(1 + e), e = exp(-2), eps by the correlation for water.
  const double e = std::exp(-2.0), repulsion = 4 * pi * thin().permittivity() * 0.25 * 625 * 200 * e / (1 + e);
  EXPECT_NEAR(evaluator.colloidal("electrostatic", f, h).force, repulsion, 1e-10);
  EXPECT_NEAR(evaluator.total(f, h).force, repulsion - attraction, 1e-10);
  // The wall: R = a, twice that of two equal spheres, for every law that follows Derjaguin.
  EXPECT_NEAR(evaluator.total(wall_of(0.5), h).force, 2 * evaluator.total(f, h).force, 1e-10);
  // Beyond the cutoff of 200 nm the law itself, not what the engine makes of it.
  EXPECT_LT(evaluator.colloidal("van_der_waals", f, 0.3).force, 0);
}

TEST(InteractionCurves, CurvesHoldTheEvaluatorsValues) {
  const InteractionEvaluator evaluator(with_laws("{van_der_waals: {}, steric: {layer_thickness: 5 nm, k1: 1 kPa, k2: 1 kPa}}"), thin());
  const std::vector<double> gaps{0.001, 0.02};
  const InteractionCurves curves = interaction_curves(evaluator, {"van_der_waals", "steric"}, {pair_of(1, 1), wall_of(2)}, gaps);
  EXPECT_EQ(curves.resistance[1][0].kn, evaluator.resistance(wall_of(2), 0.001).kn);
  EXPECT_EQ(curves.colloidal.size(), 3u);
  EXPECT_EQ(curves.colloidal.at("steric")[0][0].energy, evaluator.colloidal("steric", pair_of(1, 1), 0.001).energy);
  EXPECT_EQ(curves.colloidal.at("total")[1][1].stiffness, evaluator.total(wall_of(2), 0.02).stiffness);
}

TEST(InteractionCurves, GapsRiseFromAHundredthOfANanometre) {
  const std::vector<double> gaps = curve_gaps();
  EXPECT_NEAR(gaps.front(), 1e-5, 1e-17);
  EXPECT_NEAR(gaps.back(), 10, 1e-12);
  for (std::size_t k = 1; k < gaps.size(); ++k) EXPECT_GT(gaps[k], gaps[k - 1]);
}
