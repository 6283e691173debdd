#include "analysis/local_solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "base/random.h"
#include "model/sphere_slice.h"

namespace pigment::analysis {
namespace {

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

TEST(LocalSolids, OfACubicLatticeAreThatOfACube) {
  Snapshot frame;
  frame.cell = {4, 4, 3};
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 3; ++z) frame.position.push_back({x + 0.3 - 20, y + 0.2 + 8, z + 0.5});
  const LocalSolids l = local_solids(frame, std::vector<double>(48, 0.4));
  for (std::size_t i = 0; i < 48; ++i) {
    EXPECT_NEAR(l.cell_volume[i], 1, 1e-9);  // Voro++ merges corners closer than some 1e-11
    EXPECT_NEAR(l.solids_fraction[i], 4.0 / 3 * std::numbers::pi * std::pow(0.4, 3), 1e-9);
    // Four beside it, and those above and below but for the outer planes.
    EXPECT_GE(l.cell_neighbours[i], frame.position[i].z() == 1.5 ? 6 : 5);
  }
}

TEST(LocalSolids, DivideTheSpaceBetweenUnequalSpheresByTheirTangents) {
  // Two spheres of 1 and 2 um, 4 um apart: points of equal power, d1^2 - 1 = d2^2 - 4, lie on the plane 13/8 um from the
  // small one. Far from everything else, in a box that is 6 um high, one above the other.
  Snapshot frame;
  frame.cell = {5, 5, 7};
  frame.position = {{1, 1, 1.2}, {1, 1, 5.2}};
  const LocalSolids l = local_solids(frame, {1, 2});
  EXPECT_NEAR(l.cell_volume[0], 25 * (1.2 + 13.0 / 8), 1e-9);
  EXPECT_NEAR(l.cell_volume[1], 25 * (7 - 1.2 - 13.0 / 8), 1e-9);
  EXPECT_NEAR(l.solids_fraction[1] * l.cell_volume[1], sphere_slice_volume(2, 5.2, 0, 7), 1e-9);  // 0.2 um stand out
  EXPECT_EQ(l.cell_neighbours[0], 1);
  EXPECT_EQ(l.cell_neighbours[1], 1);
}

TEST(LocalSolids, OfSpheresAtRandomFillTheLayerAndAddUpToItsSolids) {
  // Unequal spheres put in where there is room, some across the surface, one wholly above it.
  Snapshot frame;
  frame.cell = {6, 5, 8};
  std::vector<double> radius{0.3};
  frame.position = {{1, 1, 8.4}};
  for (std::size_t k = 0; k < 4000; ++k) {
    const auto u = random_uniforms({71, Stream::Tests}, k);
    const double a = 0.1 * std::pow(8, u[3]);
    const Vec3 p{6 * u[0], 5 * u[1], a + u[2] * (8 - 0.9 * a)};
    bool free = true;
    for (std::size_t i = 0; i < radius.size(); ++i)
      free = free && frame.cell.minimum_image(p - frame.position[i]).norm() > a + radius[i];
    if (!free) continue;
    frame.position.push_back(p + Vec3(12, -5, 0));
    radius.push_back(a);
  }
  ASSERT_GT(radius.size(), 300u);
  const LocalSolids l = local_solids(frame, radius);
  EXPECT_NEAR(sum(l.cell_volume) / (6 * 5 * 8), 1, 1e-9);
  double inside = 0, found = 0;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    inside += sphere_slice_volume(radius[i], frame.position[i].z(), 0, 8);
    found += l.solids_fraction[i] * l.cell_volume[i];
    EXPECT_LE(l.solids_fraction[i], 1) << i;  // no sphere leaves its cell
  }
  EXPECT_NEAR(found / inside, 1, 1e-12);
  EXPECT_EQ(l.solids_fraction[0], 0);  // above the surface there is no solid of it
}

TEST(LocalSolids, OfOneSphereAreThoseOfTheLayer) {
  Snapshot frame;
  frame.cell = {2, 2, 2};
  frame.position = {{1, 1, 1}};
  const LocalSolids l = local_solids(frame, {0.5});
  EXPECT_NEAR(l.cell_volume[0], 8, 1e-9);
  EXPECT_TRUE(local_solids({0, {2, 2, 2}, {}}, {}).cell_volume.empty());
}

// Touching spheres of 1 um on a cubic lattice, 6 high where x < 5 and 3 high elsewhere, below a lattice of twice the
// spacing that is an eighth as dense.
Snapshot planted_cake() {
  Snapshot frame;
  frame.cell = {10, 6, 14};
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 6; ++y) {
      const int high = x < 5 ? 6 : 3;
      for (int z = 0; z < high; ++z) frame.position.push_back({x + 0.5 + 10, y + 0.5 - 6, z + 0.5});
      if (x % 2 == 0 && y % 2 == 0)
        for (int z = high + 1; z < 14; z += 2) frame.position.push_back({x + 0.5, y + 0.5, z + 0.5});
    }
  return frame;
}

TEST(LocalCake, IsThatOfAPlantedOne) {
  const Snapshot frame = planted_cake();
  const std::vector<double> radius(frame.position.size(), 0.5);
  const LocalSolids local = local_solids(frame, radius);
  const ColumnGrid columns{10, 6};  // axes through the middles
  const LocalCake cake = local_cake(frame, radius, local, 0.4, 1, columns);
  ASSERT_EQ(cake.height.size(), 60u);
  const auto mean_where = [&](std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t x = first; x <= last; ++x)
      for (std::size_t y = 0; y < 6; ++y) sum += cake.height[6 * x + y] / static_cast<double>(6 * (last - first + 1));
    return sum;
  };
  // Away from the step, which is at x = 5 and x = 0; the last layer or two have the dilute part beside them.
  EXPECT_LE(mean_where(2, 2), 6);
  EXPECT_GE(mean_where(2, 2), 4.9);
  EXPECT_NEAR(mean_where(2, 2) - mean_where(7, 7), 3, 1e-9);  // the same bias on both sides
  EXPECT_GT(cake.roughness, 0.8);
  EXPECT_NEAR(cake.mean_height, 0.5 * (mean_where(0, 4) + mean_where(5, 9)), 1e-9);
  // Denser than any: no cake. Its spheres fill pi/6 = 0.52.
  EXPECT_EQ(local_cake(frame, radius, local, 0.6, 1, columns).mean_height, 0);
}

TEST(LocalCake, DoesNotCountWhatIsDenseElsewhere) {
  // The same upside down: dense below the surface only, nothing hangs together with the substrate.
  Snapshot frame = planted_cake();
  for (Vec3& p : frame.position) p.z() = frame.cell.height - p.z();
  const std::vector<double> radius(frame.position.size(), 0.5);
  const LocalSolids local = local_solids(frame, radius);
  EXPECT_EQ(local_cake(frame, radius, local, 0.4, 1, {10, 6}).mean_height, 0);
}

TEST(LocalSolids, SurroundingIsTheCellAndThoseBesideIt) {
  // Two spheres alone: each one's surrounding is the whole layer.
  Snapshot frame;
  frame.cell = {5, 5, 7};
  frame.position = {{1, 1, 1.2}, {1, 1, 4.5}};
  const LocalSolids l = local_solids(frame, {1, 2});
  const double solids = 4.0 / 3 * std::numbers::pi * (1 + 8) / (5 * 5 * 7);
  EXPECT_NEAR(l.surrounding_fraction[0], solids, 1e-9);
  EXPECT_NEAR(l.surrounding_fraction[1], solids, 1e-9);
  EXPECT_EQ(l.neighbour, (std::vector<std::int32_t>{1, 0}));
}

}  // namespace
}  // namespace pigment::analysis
