// The DLVO curves of Fig. 2 of [sand2010] against values computed independently (bisection on the closed forms at 30 digits):
// two 1 um spheres, 25 degC, relative permittivity 80, A = 1e-21 J, lambda = 100 nm.
#include <gtest/gtest.h>

#include <cmath>

#include "forces/pair_law.h"

using namespace pigment;
using namespace pigment::forces;

namespace {

// Table 3 of [sand2010]: relative permittivity 80.
Liquid table_3() {
  LiquidParameters liquid;
  liquid.relative_permittivity = 80;
  return liquid_at(liquid, 298.15);
}

std::unique_ptr<PreparedPairLaw> law(const std::string& name, const std::string& block) {
  for (const PairLawEntry& entry : pair_laws())
    if (entry.name == name) {
      auto document = config::Document::from_text("colloidal: {" + name + ": " + block + "}");
      config::Node colloidal = document.root().block("colloidal");
      return entry.read(colloidal.block(name), colloidal)->prepare(table_3());
    }
  return nullptr;
}
const double kT = liquid_at({}, 298.15).thermal_energy();

struct Extremum {
  double gap, energy;  // um, kT
};
// Highest (sign +1) or lowest (-1) energy of the sum on a fine grid.
Extremum extremum(const std::vector<const PreparedPairLaw*>& laws, double potential, double from, double to, int sign) {
  Extremum best{from, -sign * 1e300};
  for (double h = from; h < to; h += (to - from) / 20000) {
    double energy = 0;
    for (const auto* l : laws) energy += l->evaluate({h, 0.5, 0.5, potential, potential}).energy / kT;
    if (sign * energy > sign * best.energy) best = {h, energy};
  }
  return best;
}

}  // namespace

TEST(Dlvo, SecondaryMinimumAndBarrierAt25mV) {
  const auto e = law("electrostatic", "{debye_length: 5 nm}"), w = law("van_der_waals", "{}");
  const Extremum minimum = extremum({e.get(), w.get()}, -25, 0.03, 0.12, -1), barrier = extremum({e.get(), w.get()}, -25, 0.0002, 0.01, +1);
  EXPECT_NEAR(minimum.gap, 0.0567, 0.0002);
  EXPECT_NEAR(minimum.energy, -0.020, 0.001);
  EXPECT_NEAR(barrier.gap, 0.00056, 0.00001);
  EXPECT_NEAR(barrier.energy, 199, 1);
}

TEST(Dlvo, BarriersGrowWithThePotential) {
  const auto e = law("electrostatic", "{debye_length: 10 nm}"), w = law("van_der_waals", "{}");
  const double expected[][2] = {{3, 1.1}, {5, 5}, {10, 28}, {25, 209}};
  for (const auto& [potential, barrier] : expected)
    EXPECT_NEAR(extremum({e.get(), w.get()}, potential, 0.0002, 0.05, +1).energy, barrier, 0.03 * barrier + 0.05) << potential;
}

// Without retardation (london wavelength large) the primary minimum is known in closed form.
TEST(Dlvo, BornGivesAFinitePrimaryMinimum) {
  const auto w = law("van_der_waals", "{london_wavelength: 1 m}"), b = law("born", "{collision_diameter: 0.5 nm}");
  const Extremum minimum = extremum({w.get(), b.get()}, 0, 0.0002, 0.001, -1);
  const double gap = 0.0005 / std::pow(30, 1.0 / 6);
  EXPECT_NEAR(minimum.gap, gap, 1e-7);
  EXPECT_NEAR(minimum.energy * kT, -6.0 / 7 * 1e-3 * 0.25 / (6 * gap), 1e-5);  // -(6/7) A R/(6 h)
}

TEST(Electrostatic, UnequalPotentialsMeetTheEqualForm) {
  const auto e = law("electrostatic", "{debye_length: 5 nm}");
  for (double h : {0.002, 0.01, 0.03}) {
    const PairTerm equal = e->evaluate({h, 0.4, 0.9, -25, -25}), nearly = e->evaluate({h, 0.4, 0.9, -25, -25 * (1 + 1e-9)});
    EXPECT_NEAR(equal.energy, nearly.energy, 1e-8 * equal.energy);
    EXPECT_NEAR(equal.force, nearly.force, 1e-8 * equal.force);
  }
  // At constant potential, surfaces of the same sign and different potential attract near contact.
  EXPECT_LT(e->evaluate({0.0002, 0.4, 0.9, -10, -50}).force, 0);
  EXPECT_GT(e->evaluate({0.01, 0.4, 0.9, -10, -50}).force, 0);
}

TEST(Electrostatic, DebyeLengthFromTheElectrolyte) {
  // 3.290e9 sqrt(c) 1/m at eps 78.4, 25 degC, c in mol/l [sand2010] (18): at 10 mol/m3, 1/kappa = 3.04 nm; the cutoff is 20 of it.
  const auto e = law("electrostatic", "{electrolyte: {valence: 1, concentration: 10 mol/m3}}");
  EXPECT_NEAR(e->cutoff_gap() / 20 * 1e3, 1 / (3.290e9 * std::sqrt(0.01)) * 1e9 * std::sqrt(80 / 78.4), 0.01);
}

TEST(Steric, RepelsEverywhereAndEndsAtTwoLayers) {
  const auto s = law("steric", "{layer_thickness: 5 nm, k1: 1e6 N/m2, k2: 1e6 N/m2}");
  for (double h = 0.0001; h < 0.00999; h += 0.0001) EXPECT_GT(s->evaluate({h, 0.5, 0.5, 0, 0}).force, 0);
  EXPECT_EQ(s->evaluate({0.0101, 0.5, 0.5, 0, 0}).force, 0);
  // (21) at h = delta: K1 2R delta, from both sides.
  EXPECT_NEAR(s->evaluate({0.005, 0.5, 0.5, 0, 0}).force, 1e6 * 0.5 * 0.005, 1e-9);
}
