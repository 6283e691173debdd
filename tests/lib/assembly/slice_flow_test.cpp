#include "assembly/slice_flow.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "assembly/step_assembly.h"
#include "model/sphere_slice.h"
#include "resistance/hindered_drag.h"
#include "solve/conjugate_gradients.h"

using namespace pigment;
using assembly::SliceFlow;

namespace {

constexpr double pi = 3.14159265358979323846;

// Spheres of radii 0.2 to 0.6 um at random, overlapping as they may: the liquid's flow knows of volumes alone.
struct Bed {
  std::vector<double> radius;
  std::vector<Vec3> position;
  double area, height;

  Bed(int n, double area_, double height_, double lowest, double highest, unsigned seed) : area(area_), height(height_) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> size(0.2, 0.6), place(0, 1);
    for (int k = 0; k < n; ++k) {
      radius.push_back(size(random));
      const double a = radius.back(), width = std::sqrt(area);
      position.emplace_back(width * place(random), width * place(random), lowest + a + (highest - lowest - 2 * a) * place(random));
    }
  }
  double solids() const {
    double sum = 0;
    for (double a : radius) sum += Particles::sphere_volume(a);
    return sum / (area * height);
  }
};

// Cubic columns of touching layers: every slice of one diameter holds one whole layer.
void add_lattice(Vec3Array& position, int across, int layers, double spacing, double diameter) {
  for (int z = 0; z < layers; ++z)
    for (int x = 0; x < across; ++x)
      for (int y = 0; y < across; ++y) position.emplace_back(x * spacing, y * spacing, (z + 0.5) * diameter);
}

std::vector<double> random_velocities(std::size_t n, std::size_t D, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> u(n * D);
  for (double& x : u) x = normal(random);
  return u;
}

// Term and diagonal as a dense matrix of vertical velocities.
Eigen::MatrixXd dense(const SliceFlow& flow, std::size_t n) {
  Eigen::MatrixXd m(n, n);
  solve::MeanFlowSums sums(flow.term(), 1);
  for (std::size_t q = 0; q < n; ++q) {
    std::vector<double> x(3 * n, 0.0), y(3 * n, 0.0);
    x[3 * q + 2] = 1;
    solve::sum_mean_flow<3>(flow.term(), 0, 0, static_cast<int>(n), x.data(), sums);
    sums.combine();
    solve::add_mean_flow<3>(flow.term(), 0, static_cast<int>(n), sums, y.data());
    for (std::size_t k = 0; k < n; ++k) m(k, q) = y[3 * k + 2] + (k == q ? flow.drag(k) : 0);
  }
  return m;
}

}  // namespace

// One slice: a bed at rest feels q through it as the source says, (1 - phi) y + phi y^2 times F(phi), interstitial velocity
// q/(1 - phi). To rounding: the formula that the dissipation must come out at.
TEST(SliceFlow, FixedBedFeelsTheSourcesForce) {
  const Bed bed(18, 9, 1.2, 0, 1.2, 5);
  std::vector<double> one(bed.radius);
  SliceFlow flow(one, bed.area, 1.0);  // thickness: about one diameter, so one slice
  const double mu = 0.9, q = 0.03, phi = bed.solids(), liquid = 1 - phi;
  ASSERT_GT(phi, 0.4);
  ASSERT_LT(phi, 0.65);
  flow.place(bed.position, bed.height, mu, q);
  double cubes = 0, squares = 0, sum = 0;
  for (double a : bed.radius) {
    cubes += a * a * a;
    squares += a * a;
  }
  const double F = 10 * phi / (liquid * liquid) + liquid * liquid * (1 + 1.5 * std::sqrt(phi));
  for (std::size_t k = 0; k < bed.radius.size(); ++k) {
    const double y = bed.radius[k] * squares / cubes;
    const double expected = -6 * pi * mu * bed.radius[k] * (liquid * y + phi * y * y) * F * q / liquid;
    EXPECT_NEAR(flow.force(k), expected, 1e-12 * std::abs(expected));
    sum += flow.force(k);
  }
  const auto states = flow.states(std::vector<double>(3 * bed.radius.size(), 0.0), 3);
  ASSERT_EQ(states.size(), 1u);
  EXPECT_NEAR(states[0].solids_fraction, phi, 1e-13);
  EXPECT_NEAR(states[0].pressure_drop, sum / bed.area, 1e-12 * std::abs(sum) / bed.area);
  // Carman and Kozeny [carman1937] for a bed of several sizes: d^2 of the mean over the surface. They lack the second term of F.
  const double d = 2 * cubes / squares, kozeny = 180 * mu * q * phi * phi / (std::pow(liquid, 3) * d * d) * bed.height;
  EXPECT_NEAR(-states[0].pressure_drop / kozeny, F / (10 * phi / (liquid * liquid)), 1e-12);
  EXPECT_NEAR(-states[0].pressure_drop / kozeny, 1, 0.05);
}

TEST(SliceFlow, MatrixIsSymmetricAndPositiveDefinite) {
  for (double surface : {0.0, 5.6}) {  // none; one that some stand out of
    const Bed bed(90, 9, 6, 0, 6, 7);
    SliceFlow flow(bed.radius, bed.area, bed.height);
    flow.place(bed.position, surface, 1, 0.01);
    const Eigen::MatrixXd m = dense(flow, bed.radius.size());
    EXPECT_LT((m - m.transpose()).cwiseAbs().maxCoeff(), 1e-14 * m.cwiseAbs().maxCoeff());
    // Not below what particles would dissipate without the backflow by more than a factor of ten: well away from singular.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(m);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), 0.05 * m.diagonal().minCoeff());
  }
}

// phi <U> + (1 - phi) u = -q in every slice, phi <U> found anew: how fast the solids below a plane, averaged over the planes of
// the slice, grow when the particles move; central differences over 1e-5 um.
TEST(SliceFlow, VolumeIsConserved) {
  const Bed bed(90, 9, 6, 0, 6, 11);
  SliceFlow flow(bed.radius, bed.area, bed.height);
  const double q = 0.02;
  flow.place(bed.position, 0, 1, q);
  const std::vector<double> u = random_velocities(bed.radius.size(), 6, 3);
  const auto states = flow.states(u, 6);
  const double thickness = bed.height / static_cast<double>(states.size());
  double largest = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const double low = static_cast<double>(s) * thickness, step = 1e-5;
    const auto below = [&](double shift) {
      double volume = 0;
      for (std::size_t k = 0; k < bed.radius.size(); ++k) {
        const double z = bed.position[k].z() + shift * u[6 * k + 2];
        for (int p = 0; p < 4000; ++p) volume += sphere_volume_below(bed.radius[k], z, low + (p + 0.5) / 4000 * thickness) / 4000;
      }
      return volume / bed.area;
    };
    const double flux = -(below(step) - below(-step)) / (2 * step);
    EXPECT_NEAR(states[s].solids_flux, flux, 1e-6);  // the midpoint rule's and the differences' error
    const double total = states[s].solids_flux + (1 - states[s].solids_fraction) * states[s].liquid_velocity;
    EXPECT_NEAR(total, -q, 1e-14);
    largest = std::max(largest, std::abs(flux));
  }
  EXPECT_GT(largest, 0.1);
}

// The work of the drag is what the slip dissipates: sum b (U - u)^2, u from the slices' states; and the forces of all particles
// are what the liquid's pressure loses.
TEST(SliceFlow, DissipatesBySlip) {
  const Bed bed(90, 9, 6, 0, 6, 13);
  SliceFlow flow(bed.radius, bed.area, bed.height);
  flow.place(bed.position, 0, 1, 0);
  const std::size_t n = bed.radius.size();
  const std::vector<double> u = random_velocities(n, 3, 5);
  const auto states = flow.states(u, 3);
  const Eigen::MatrixXd m = dense(flow, n);
  Eigen::VectorXd z(n);
  for (std::size_t k = 0; k < n; ++k) z[k] = u[3 * k + 2];
  double dissipated = 0, drop = 0;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t at = flow.term().begin[k]; at < flow.term().begin[k + 1]; ++at) {
      const auto& share = flow.term().share[at];
      dissipated += share.drag * std::pow(z[k] - states[share.slice].liquid_velocity, 2);
    }
  for (const auto& s : states) drop += s.pressure_drop;
  EXPECT_NEAR(z.dot(m * z), dissipated, 1e-12 * dissipated);
  EXPECT_NEAR(drop * bed.area, -(m * z).sum(), 1e-11 * (m * z).cwiseAbs().sum());
}

// Equal spheres under their weight in a closed cell: phi U + (1 - phi) u = 0, so U over the Stokes speed is (1 - phi)/F(phi). The
// solver's own tolerance.
TEST(SliceFlow, SuspensionSettlesAtTheSourcesSpeed) {
  for (double spacing : {1.1, 1.5, 3.0}) {
    assembly::Interactions in;
    in.surface_potential = {0};
    in.liquid.viscosity = 0.8;
    in.hydrodynamics.model = resistance::HydrodynamicsParameters::Model::Drag;
    in.hydrodynamics.drag = resistance::HydrodynamicsParameters::Drag::Hindered;
    in.gravity.emplace();
    const double a = 0.5;
    Vec3Array position;
    add_lattice(position, 4, 8, spacing, 2 * a);
    const std::size_t n = position.size();
    Particles particles{std::vector<double>(n, a), std::vector<double>(n, 2.7e-3 * Particles::sphere_volume(a)), std::vector<int>(n, 0), {}};
    const Cell cell{4 * spacing, 4 * spacing, 8.0};
    const Liquid liquid = liquid_at(in.liquid, 298.15);
    const auto list = neighbours::make_neighbour_list(cell, position, particles.radius, assembly::pair_range(in, liquid));
    assembly::StepAssembly step(in, particles, cell, list);
    step.begin(position, {}, liquid, 0.01, assembly::Treatment::Newton, {}, std::vector<double>(n, 0.0));
    solve::PairSystem system;
    step.build(system);
    std::vector<double> u;
    ASSERT_TRUE(solve::conjugate_gradients(system, u, {1e-12, 100}).converged);
    const double phi = pi / 6 * std::pow(2 * a, 2) / (spacing * spacing);
    const double stokes = 1.7e-3 * 9.81 * 2 * a * a / (9 * 0.8);
    const double F = resistance::bed_drag_factor(phi);
    for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(-u[3 * k + 2] / stokes, (1 - phi) / F, 1e-10);
    // The liquid bears the buoyant weight of all.
    const double weight = static_cast<double>(n) * 1.7e-3 * 9.81 * Particles::sphere_volume(a) / cell.area();
    EXPECT_NEAR(step.boundary_pressures(u).liquid, weight, 1e-10 * weight);
  }
}

// A particle alone in a wide cell is a Stokes sphere, but for the root of phi, 1e-16 here, in F; what stands out of the surface takes no part, what has left it keeps
// isolated drag; slices without particles do no harm.
TEST(SliceFlow, SparseLayers) {
  const std::vector<double> radius{0.5, 0.25, 0.3};
  SliceFlow flow(radius, 1e16, 20);
  flow.place({Vec3(0, 0, 3), Vec3(0, 0, 15), Vec3(0, 0, 20.4)}, 20, 1, 0.01);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(flow.drag(k), 6 * pi * radius[k], 1e-6 * radius[k]);
  EXPECT_NEAR(flow.force(0), -6 * pi * 0.5 * 0.01, 1e-6);
  EXPECT_EQ(flow.force(2), 0);
  // Without a surface the slices go on above the cell and below zero.
  flow.place({Vec3(0, 0, -3), Vec3(0, 0, 15), Vec3(0, 0, 40)}, 0, 1, 0.01);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(flow.force(k), -6 * pi * radius[k] * 0.01, 1e-6);
}
