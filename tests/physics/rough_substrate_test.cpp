// Layers that dry on a rough substrate: no particle passes it, whatever presses; and without roughness it is the plane.
#include <gtest/gtest.h>

#include <cmath>

#include "model/layer_measures.h"
#include "packing/pack_layer.h"
#include "packing/statistics.h"
#include "stepping/consolidate.h"
#include "support/small_layer.h"

using namespace pigment;

namespace {

constexpr double final_solids = 0.78;  // by mass; such a layer jams at 82 to 83 %

packing::Recipe recipe_of(std::uint64_t seed) {
  SizeLaw law;
  law.mean = 0.6;
  law.standard_deviation = 0.3;
  law.median = 0.5367;
  law.geometric_standard_deviation = 1.604;
  law.min = 0.3;
  law.max = 0.9;
  packing::Recipe recipe = test::lognormal_recipe(3, 0.60, law);
  recipe.seed = seed;
  return recipe;
}

stepping::Problem problem_of(const packing::Packing& packed) {
  stepping::Problem problem = test::charged_layer(packed);
  problem.interactions.height_field = packed.layer.substrate;
  // Evenly in 20 ms from 60 to 78 wt%: of thickness times volume fraction phi of solids, the liquid that goes.
  const double phi = (0.6 / 2.7) / (0.6 / 2.7 + 0.4), dry = 3 * phi * 2.7;
  const double lost = dry * (0.4 / 0.6 - (1 - final_solids) / final_solids);
  problem.dewatering.time = {0, 20};
  problem.dewatering.absorption_flux = {lost / 40, lost / 40};
  problem.dewatering.evaporation_flux = {lost / 40, lost / 40};
  return problem;
}

// The distance from the surface on a fine grid: no foot is sought. At most this much above the true one.
constexpr double grid = 0.004;
double distance_on_grid(const HeightField& field, const Vec3& p, double reach) {
  double least = 1e9;
  const int n = static_cast<int>(reach / grid) + 1;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j) {
      const double x = p.x() + i * grid, y = p.y() + j * grid;
      least = std::min(least, (Vec3(x, y, field.height(x, y)) - p).squaredNorm());
    }
  return std::sqrt(least);
}

}  // namespace

TEST(RoughSubstrate, PressedParticlesNeverPassIt) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    packing::Recipe recipe = recipe_of(seed);
    recipe.substrate = height_map({0.8, 1.25, {}});
    const packing::Packing packed = packing::pack_layer(recipe);
    const HeightField& field = *packed.layer.substrate;
    // Packed into the valleys too, at the solids asked for, nothing nearer than the minimum gap.
    const packing::SmallestGaps gaps = packing::smallest_gaps(packed.layer);
    EXPECT_GE(gaps.substrate, 0.002);
    EXPECT_GE(gaps.particles, 0.002);
    EXPECT_NEAR(packing::solids_of(packed.layer, 1e-3).mass_fraction, 0.6, 1e-12);
    double lowest = 10;
    for (std::size_t k = 0; k < packed.layer.position.size(); ++k)
      lowest = std::min(lowest, packed.layer.position[k].z() - packed.layer.particles.radius[k]);
    EXPECT_LT(lowest, 0.5 * field.crest());

    const stepping::Problem problem = problem_of(packed);
    stepping::RunState state = stepping::initial_state(problem, packed.layer.position);
    double smallest = 10;
    std::vector<double> last;
    stepping::RunCallbacks callbacks;
    callbacks.on_frame = [&](const stepping::RunState& s, double, const std::vector<double>& observables) {
      last = observables;
      double frame_smallest = 10;
      for (std::size_t k = 0; k < s.position.size(); ++k) {
        const double a = problem.particles.radius[k];
        EXPECT_GT(s.position[k].z(), field.height(s.position[k].x(), s.position[k].y()));
        if (s.position[k].z() < field.crest() + a + 0.02)
          frame_smallest = std::min(frame_smallest, distance_on_grid(field, s.position[k], a + 0.02) - a);
      }
      // The grid's distance lies above the true one by grid^2/4 (1 + slope^2)(1/distance + curvature) at most: slope 1.4, curvature 5.
      if (frame_smallest < 0.02) {
        EXPECT_NEAR(observables.back(), frame_smallest, grid * grid / 4 * 3 * (1 / 0.15 + 5));
      }
      EXPECT_GT(observables.back(), 0);
      EXPECT_TRUE(neighbours::find_pairs(problem.cell, s.position, problem.particles.radius, {0, 0, 0}).empty());
      smallest = std::min(smallest, observables.back());
    };
    EXPECT_EQ(stepping::consolidate(problem, {2, 20}, state, callbacks), "until");
    EXPECT_LT(smallest, 0.02);                // some are pressed against it
    EXPECT_NEAR(last[3], final_solids, 1e-9);  // solids of what lies above the surface, liquid lost as imposed
    // The thickness over the mean height: what the scene asks for, less what has gone.
    EXPECT_NEAR(last[0], 3 - problem.dewatering.absorbed_at(20) - problem.dewatering.evaporated_at(20), 1e-9);
    EXPECT_GT(last[5], 0);  // the surface presses
  }
}

TEST(RoughSubstrate, VanishingRoughnessDriesAsOnThePlane) {
  const packing::Packing packed = packing::pack_layer(recipe_of(4));
  const auto run = [&](std::shared_ptr<const HeightField> field) {
    stepping::Problem problem = problem_of(packed);
    problem.interactions.height_field = std::move(field);
    problem.stepping.tolerance = 1e-3;
    problem.stepping.integrator = stepping::SteppingParameters::Integrator::Extrapolated;  // that of rough substrates, for both
    stepping::RunState state = stepping::initial_state(problem, packed.layer.position);
    stepping::RunCallbacks callbacks;
    callbacks.on_frame = [](const stepping::RunState&, double, const std::vector<double>&) {};
    stepping::consolidate(problem, {5, 5}, state, callbacks);
    return state.position;
  };
  const Vec3Array plane = run(nullptr), rough = run(std::make_shared<const HeightField>(height_map({1e-6, 1.25, {}}), packed.layer.cell));
  double largest = 0;
  for (std::size_t k = 0; k < plane.size(); ++k) largest = std::max(largest, (plane[k] - rough[k]).norm());
  // The surface differs by 1e-6 um; particles move by 0.2 um, and what they make of a difference grows by a few times on the way.
  EXPECT_LT(largest, 2e-5);
  EXPECT_GT((plane[0] - packed.layer.position[0]).norm(), 1e-2);
}
