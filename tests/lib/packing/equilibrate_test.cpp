#include "packing/equilibrate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "neighbours/pair_search.h"

namespace pigment::packing {
namespace {

TEST(Equilibrate, GivesTheContactValueOfCarnahanAndStarling) {
  // Equal hard spheres far from the planes: how many pairs are within delta of contact follows from the pair
  // correlation at contact, (1 - phi/2)/(1 - phi)^3 [carnahan1969], and its slope there, -4.5 phi (1 + phi)/
  // ((1 - phi)(1 + phi/2)) of it a diameter (Percus-Yevick). The start, a simple cubic lattice, has no such
  // pair.
  const double delta = 0.02, spacing = 1.2;  // um; diameter 1 um, volume fraction 0.30
  const Slab slab{7 * spacing, 0, 20 * spacing};
  Vec3Array centre;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 7; ++y)
      for (int z = 0; z < 20; ++z) centre.emplace_back(spacing * Vec3(x + 0.5, y + 0.5, z + 0.5));
  const std::vector<double> radius(centre.size(), 0.5);
  equilibrate(slab, radius, centre, 300, 1);

  const double low = 4,
               high = 20;  // four diameters away from the planes their layering has died out at this density
  double pairs = 0, inside = 0;
  const int snapshots = 40;
  for (int s = 0; s < snapshots; ++s) {
    equilibrate(slab, radius, centre, 10, 100 + s);
    const auto counts = [&](std::int32_t i) {
      return centre[i].z() > low && centre[i].z() < high ? 1.0 : 0.0;
    };
    for (std::size_t i = 0; i < centre.size(); ++i) inside += counts(static_cast<std::int32_t>(i));
    for (const auto& p : neighbours::find_pairs(slab.cell(), centre, radius, {0, 0, delta}))
      pairs += 0.5 * counts(p.i) + 0.5 * counts(p.j);
  }
  const double density = inside / snapshots / (slab.width * slab.width * (high - low)),
               phi = density * std::numbers::pi / 6;
  const double contact = (1 - phi / 2) / std::pow(1 - phi, 3);
  const double slope = -4.5 * phi * (1 + phi) / ((1 - phi) * (1 + phi / 2));
  const double shell = 4.0 / 3 * std::numbers::pi * (std::pow(1 + delta, 3) - 1);
  const double measured = 2 * pairs / inside / (density * shell);
  // Some 4,400 pairs counted: 1.5 % of scatter, somewhat more for what snapshots share; four times that.
  EXPECT_NEAR(measured / (contact * (1 + slope * delta / 2)), 1, 0.07);
}

TEST(Equilibrate, SpreadsASingleSphereEvenly) {
  // One sphere between two planes: its height becomes uniform, whatever the start. Mean 0, variance 1/12 of
  // the room squared; 400 independent runs, tolerance four standard errors (false alarm 1e-4).
  double sum = 0, sum2 = 0;
  const int runs = 400;
  for (int run = 0; run < runs; ++run) {
    Vec3Array centre{{1, 1, 0.55}};
    equilibrate({3, 0, 1.5}, {0.5}, centre, 600, static_cast<std::uint64_t>(run));
    const double u = (centre[0].z() - 0.5) / 0.5;
    EXPECT_GE(u, 0);
    EXPECT_LE(u, 1);
    sum += u, sum2 += (u - 0.5) * (u - 0.5);
  }
  EXPECT_NEAR(sum / runs, 0.5, 4 * std::sqrt(1.0 / 12 / runs));
  EXPECT_NEAR(sum2 / runs, 1.0 / 12, 4 * std::sqrt(1.0 / 180 / runs));
}

TEST(Equilibrate, DoesNothingInNoSweeps) {
  Vec3Array centre{{1, 1, 1}};
  equilibrate({3, 0, 3}, {0.5}, centre, 0, 1);
  EXPECT_EQ(centre[0], Vec3(1, 1, 1));
}

}  // namespace
}  // namespace pigment::packing
