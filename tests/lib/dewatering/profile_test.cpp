#include "dewatering/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace pigment::dewatering {
namespace {

// A coating of 65 wt-% with solids of 2700 and a liquid of 1000 kg/m3; viscosity 1 mPa s.
Coating coating(double thickness = 25) {
  return {volume_fraction_of(0.65, 2.7e-3, 1e-3), thickness, 2.7e-3, {298.15, 1.0, 78.4, 1e-3}};
}

constexpr double g_per_m2_s = 1e-6;  // engine mass flux: 1 kg/m2/s = 1e-3 pN ms/um^3

DewateringParameters parameters(Strategy strategy) {
  DewateringParameters p;
  p.strategy = strategy;
  p.duration = 600;
  p.absorption = AbsorptionParameters{1e-6, 0.68, 50000, 0};
  p.evaporation = EvaporationParameters{40 * g_per_m2_s, 8 * g_per_m2_s};
  return p;
}

const Strategy all_strategies[] = {Strategy::HighLowLow, Strategy::LowLowHigh, Strategy::Absorption,
                                   Strategy::Evaporation};

TEST(Darcy, RateIsThatOfTheFiltrationLaw) {
  // By hand: 2 * 1e-18 m2 * (50 + 30 kPa) / 1 mPa s * (0.68 - 0.4) / 0.4 = 1.12e-10 m2/s = 0.112 um2/ms.
  EXPECT_NEAR(darcy_rate({1e-6, 0.68, 50000, 30000}, 0.4, 1.0), 0.112, 1e-15);
}

// The law solves Darcy's equation for the cake it builds: dV/dt = k P / (mu L), phi_f L = phi (L + V).
TEST(Darcy, AbsorbedSolvesTheCakeEquation) {
  const AbsorptionParameters p{2e-6, 0.7, 40000, 10000};
  const double phi = 0.45, viscosity = 0.9, t = 123, dt = 1e-3;
  const double rate = darcy_rate(p, phi, viscosity);
  const double volume = std::sqrt(rate * t), cake = phi * volume / (p.cake_solids - phi);
  const double slope = (std::sqrt(rate * (t + dt)) - std::sqrt(rate * (t - dt))) / (2 * dt);
  // A central difference of the square root errs by (dt/t)^2 / 8, 1e-11.
  EXPECT_NEAR(slope, p.permeability * 50000 / (viscosity * cake), 1e-9 * slope);
}

TEST(Dewatering, TwentyFiveMicrometresLoseTenOfWater) {
  const double final = volume_fraction_of(0.85, 2.7e-3, 1e-3);
  // (1-0.65)/0.65 and (1-0.85)/0.85 kg of water a kg of solids; the dry coat is 25 um * 0.4075 * 2700 kg/m3.
  const double dry = 25e-6 * coating().volume_fraction * 2700;  // kg/m2
  const double by_mass = dry * (0.35 / 0.65 - 0.15 / 0.85) / 1000 * 1e6;
  EXPECT_NEAR(liquid_to_remove(25, coating().volume_fraction, final), by_mass, 1e-12 * 25);
  EXPECT_NEAR(by_mass, 9.96, 0.005);  // as printed, three digits
}

TEST(Dewatering, AbsorptionFollowsTheSquareRootOfTime) {
  const auto p = parameters(Strategy::Absorption);
  const Profile profile = make_profile(p, coating());
  const double rate = darcy_rate(*p.absorption, coating().volume_fraction, 1.0);
  const double total = std::sqrt(rate * 600);
  EXPECT_EQ(profile.scale, 1);
  EXPECT_NEAR(profile.removed, total, 1e-12 * total);
  for (double t = 1e-9; t < 600; t *= 1.37)
    EXPECT_NEAR(profile.curve.absorbed_at(t), std::sqrt(rate * t), 1e-6 * total) << t;  // the stated error of a chord
  EXPECT_EQ(profile.curve.evaporated_at(600), 0);
}

TEST(Dewatering, FluxAtTheStartIsFiniteAndTheMeanOfTheFirstInterval) {
  const DewateringCurve curve = make_profile(parameters(Strategy::Absorption), coating()).curve;
  EXPECT_EQ(curve.absorption_flux[0], curve.absorbed[1] / curve.time[1]);
  for (double flux : curve.absorption_flux) EXPECT_TRUE(std::isfinite(flux) && flux > 0);
}

TEST(Dewatering, SectionsLastAThirdEach) {
  const DewateringCurve hll = make_profile(parameters(Strategy::HighLowLow), coating()).curve;
  const DewateringCurve llh = make_profile(parameters(Strategy::LowLowHigh), coating()).curve;
  const DewateringCurve eva = make_profile(parameters(Strategy::Evaporation), coating()).curve;
  const double high = 0.04, low = 0.008;  // um/ms: 1 g/m2/s of water is 1 um/s
  // Exact at the sections' ends and, being straight, between: rounding only.
  EXPECT_NEAR(hll.evaporated_at(100), 100 * high, 1e-12);
  EXPECT_NEAR(hll.evaporated_at(200), 200 * high, 1e-12);
  EXPECT_NEAR(hll.evaporated_at(600), 200 * high + 400 * low, 1e-12);
  EXPECT_NEAR(llh.evaporated_at(400), 400 * low, 1e-12);
  EXPECT_NEAR(llh.evaporated_at(500), 400 * low + 100 * high, 1e-12);
  EXPECT_NEAR(eva.evaporated_at(450), 450 * high, 1e-12);
  EXPECT_EQ(eva.absorbed_at(600), 0);
  EXPECT_NEAR(hll.mean_evaporation_flux(250, 350), low, 1e-15);
}

// Without the cumulative curves, as another reader may take the file: straight lines between the fluxes.
TEST(Dewatering, FluxesIntegrateToTheCumulativeCurves) {
  for (Strategy strategy : all_strategies) {
    DewateringCurve curve = make_profile(parameters(strategy), coating()).curve;
    const double absorbed = curve.absorbed_at(600), evaporated = curve.evaporated_at(600);
    curve.absorbed.clear();
    curve.evaporated.clear();
    // Trapezia of 1/(2 sqrt(t)) on points (k/n)^4 err by 2/k/n^2 each, 2 ln(n)/n^2 = 1.4e-5 in all with n = 1000; a jump
    // of fluxes is spread over 1e-9 of the duration.
    EXPECT_NEAR(curve.absorbed_at(600), absorbed, 2e-5 * absorbed);
    EXPECT_NEAR(curve.evaporated_at(600), evaporated, 1e-8 * evaporated);
  }
}

TEST(Dewatering, TimesRiseFromZeroToTheDuration) {
  for (Strategy strategy : all_strategies) {
    const DewateringCurve curve = make_profile(parameters(strategy), coating()).curve;
    EXPECT_EQ(curve.time.front(), 0);
    EXPECT_EQ(curve.time.back(), 600);
    for (std::size_t i = 1; i < curve.time.size(); ++i) EXPECT_LT(curve.time[i - 1], curve.time[i]);
  }
}

TEST(Dewatering, EveryStrategyRemovesTheSameLiquid) {
  for (Strategy strategy : all_strategies) {
    auto p = parameters(strategy);
    p.final_solids = SolidsContent{0.85, true};
    const Profile plain = make_profile(parameters(strategy), coating()), profile = make_profile(p, coating());
    const double lost = profile.curve.absorbed_at(600) + profile.curve.evaporated_at(600);
    const double final = coating().volume_fraction * 25 / (25 - lost);
    EXPECT_NEAR(mass_fraction_of(final, 2.7e-3, 1e-3), 0.85, 1e-12);
    EXPECT_NEAR(profile.removed, lost, 1e-12 * lost);
    // One factor on both fluxes.
    EXPECT_NEAR(profile.curve.absorbed_at(300), profile.scale * plain.curve.absorbed_at(300), 1e-12 * lost);
    EXPECT_NEAR(profile.curve.evaporated_at(300), profile.scale * plain.curve.evaporated_at(300), 1e-12 * lost);
  }
}

TEST(Dewatering, ReferenceThicknessSetsOneProfileForAllLayers) {
  auto p = parameters(Strategy::HighLowLow);
  p.final_solids = SolidsContent{0.85, true};
  p.reference_thickness = 25;
  const Profile thin = make_profile(p, coating(10)), thick = make_profile(p, coating(30));
  EXPECT_EQ(thin.scale, thick.scale);
  EXPECT_EQ(thin.curve.absorbed, thick.curve.absorbed);
}

TEST(Dewatering, NothingToScaleIsRefused) {
  auto p = parameters(Strategy::Evaporation);
  p.evaporation = EvaporationParameters{0, 0};
  EXPECT_EQ(make_profile(p, coating()).removed, 0);  // as written: nothing leaves
  p.final_solids = SolidsContent{0.85, true};
  EXPECT_THROW(make_profile(p, coating()), InputError);
}

}  // namespace
}  // namespace pigment::dewatering
