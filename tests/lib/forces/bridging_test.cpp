// Bridging attraction against quadratures that share nothing with its closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "forces/pair_law.h"

using namespace pigment;
using namespace pigment::forces;
using std::numbers::pi;

namespace {

constexpr double s = 0.01, w = 10;  // um; pN/um: 0.01 mN/m

std::unique_ptr<PreparedPairLaw> bridging() {
  for (const PairLawEntry& entry : pair_laws())
    if (entry.name == "bridging") {
      auto document =
          config::Document::from_text("colloidal: {bridging: {chain_size: 10 nm, adhesion_energy: 0.01 mN/m}}");
      config::Node colloidal = document.root().block("colloidal");
      return entry.read(colloidal.block("bridging"), colloidal)->prepare(liquid_at({}, 298.15));
    }
  return nullptr;
}

}  // namespace

// Equal spheres of 1 um, R = 0.25 um: 2 pi R w = 15.7 pN at contact; at one chain size exp(-3/2) of it.
TEST(Bridging, ForceByHand) {
  const auto law = bridging();
  EXPECT_NEAR(law->evaluate({0, 0.5, 0.5, 0, 0}).force, -15.70796327, 1e-7);
  EXPECT_NEAR(law->evaluate({0.01, 0.5, 0.5, 0, 0}).force, -15.70796327 * 0.22313016, 1e-6);
}

// Derjaguin's approximation itself: the energy of two spheres is that of flat rings facing each other at gap h + r^2/(2R).
TEST(Bridging, EnergyIsThatOfFlatRings) {
  const auto law = bridging();
  for (const auto& [a, b] : {std::pair{0.5, 0.5}, {0.1, 1.0}, {0.25, std::numeric_limits<double>::infinity()}}) {
    const double R = std::isinf(b) ? a : a * b / (a + b);
    for (double h : {0.0, 0.003, 0.01, 0.02}) {
      double energy = 0;
      const int n = 20000;
      const double reach = 8 * s, dt = reach / n;  // over the gap t = h + r^2/(2R): 2 pi r dr = 2 pi R dt; midpoints
      for (int k = 0; k < n; ++k) {
        const double t = h + (k + 0.5) * dt;
        energy -= w * std::exp(-1.5 * t * t / (s * s)) * 2 * pi * R * dt;
      }
      EXPECT_NEAR(law->evaluate({h, a, b, 0, 0}).energy, energy, 1e-6 * std::abs(energy)) << a << " " << b << " " << h;
    }
  }
}

TEST(Bridging, FadesBeforeItsCutoff) {
  const auto law = bridging();
  const double contact = law->evaluate({0, 0.5, 0.5, 0, 0}).force;
  EXPECT_LT(law->evaluate({0.75 * law->cutoff_gap(), 0.5, 0.5, 0, 0}).force / contact, 2e-4);
  EXPECT_GT(law->cutoff_gap(), 0.03);
}
