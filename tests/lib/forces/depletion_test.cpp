// Depletion against volumes found by quadrature, independent of the closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "forces/pair_law.h"

using namespace pigment;
using namespace pigment::forces;
using std::numbers::pi;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pressure = 1e4, r = 0.005;  // pN/um^2, um

std::unique_ptr<PreparedPairLaw> depletion() {
  for (const PairLawEntry& entry : pair_laws())
    if (entry.name == "depletion") {
      auto document = config::Document::from_text("colloidal: {depletion: {depletant_radius: 5 nm, osmotic_pressure: 10 kPa}}");
      config::Node colloidal = document.root().block("colloidal");
      return entry.read(colloidal.block("depletion"), colloidal)->prepare(liquid_at({}, 298.15));
    }
  return nullptr;
}

// Volume common to the sphere of radius a + r about 0 and that of b + r about D = a + b + h (or the half space beyond
// a + h - r): pi times the integral of the smaller of the two squared cross-sections, midpoint rule, over where both are.
double common_volume(double a, double b, double h) {
  const double from = a + h - r, to = a + r, D = a + b + h;
  if (from >= to) return 0;
  const int n = 200000;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double x = from + (to - from) * (k + 0.5) / n;
    const double first = (a + r) * (a + r) - x * x;
    const double second = std::isinf(b) ? infinity : (b + r) * (b + r) - (D - x) * (D - x);
    sum += std::max(0.0, std::min(first, second));
  }
  return pi * sum * (to - from) / n;
}

}  // namespace

TEST(Depletion, EnergyIsPressureTimesTheCommonVolume) {
  const auto law = depletion();
  for (const auto& [a, b] : {std::pair{0.5, 0.5}, {0.1, 1.0}, {0.01, 1.0}, {0.25, infinity}, {infinity, 0.25}})
    for (double h : {0.0, 0.001, 0.005, 0.009}) {
      const double volume = common_volume(std::min(a, b), std::max(a, b), h);
      // The midpoint rule at 2e5 points has errors of 1e-9 of the volume, where the cross-sections meet in a corner.
      EXPECT_NEAR(law->evaluate({h, a, b, 0, 0}).energy, -pressure * volume, 1e-7 * pressure * volume) << a << " " << b << " " << h;
    }
}

TEST(Depletion, ForceAtContactByHand) {
  // Equal spheres: the circle at contact has rho^2 = (a + r)^2 - a^2 = 2525 nm^2; 10 kPa on it is 79.3 pN.
  const PairTerm contact = depletion()->evaluate({0, 0.25, 0.25, 0, 0});
  EXPECT_NEAR(contact.force, -1e4 * pi * (0.255 * 0.255 - 0.25 * 0.25), 1e-9);
  EXPECT_NEAR(contact.force, -79.3, 0.05);
  // The plane: rho^2 = (a + r)^2 - (a - r)^2 = 4 a r.
  EXPECT_NEAR(depletion()->evaluate({0, 0.25, infinity, 0, 0}).force, -1e4 * pi * 4 * 0.25 * 0.005, 1e-9);
}

TEST(Depletion, EndsWhereNoDepletantIsLeftOut) {
  const auto law = depletion();
  EXPECT_EQ(law->evaluate({0.01, 0.5, 0.5, 0, 0}).force, 0);
  EXPECT_EQ(law->evaluate({0.02, 0.5, 0.5, 0, 0}).energy, 0);
  // What the engine uses is the law itself up to there.
  const PairGeometry just_inside{0.00999, 0.5, 0.5, 0, 0};
  EXPECT_LT(law->switched(just_inside).force, 0);
  EXPECT_EQ(law->switched(just_inside).force, law->evaluate(just_inside).force);
}

TEST(Depletion, ALargeSphereIsThePlane) {
  const auto law = depletion();
  const PairTerm large = law->evaluate({0.002, 0.3, 3e5, 0, 0}), plane = law->evaluate({0.002, 0.3, infinity, 0, 0});
  EXPECT_NEAR(large.energy, plane.energy, 1e-5 * std::abs(plane.energy));  // to a/b = 1e-6
  EXPECT_NEAR(large.force, plane.force, 1e-5 * std::abs(plane.force));
  EXPECT_NEAR(large.stiffness, plane.stiffness, 1e-5 * std::abs(plane.stiffness));
}

TEST(Depletion, AttractsInOverlapWithoutEnd) {
  const auto law = depletion();
  double last = law->evaluate({0, 0.5, 0.5, 0, 0}).force;
  for (double h : {-0.001, -0.01, -0.1}) {
    const double force = law->evaluate({h, 0.5, 0.5, 0, 0}).force;
    EXPECT_TRUE(std::isfinite(force));
    EXPECT_LT(force, last);  // constant stiffness: what stops the particles is Born or steric repulsion
    last = force;
  }
}
