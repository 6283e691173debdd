#include "assembly/thermal_force.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "assembly/step_assembly.h"

using namespace pigment;
using Eigen::MatrixXd;

namespace {

// Eight unequal spheres near each other and near the substrate and the free surface, and their resistance.
struct Cluster {
  assembly::Interactions interactions;
  Particles particles;
  Cell cell{10, 10, 4};
  Vec3Array position;
  neighbours::NeighbourList list;
  std::unique_ptr<assembly::StepAssembly> step;
  solve::PairSystem system;
  std::vector<std::int64_t> id;

  explicit Cluster(bool rotation, bool hindered = false) {
    if (hindered) interactions.hydrodynamics.drag = resistance::HydrodynamicsParameters::Drag::Hindered;
    interactions.hydrodynamics.rotation = rotation;
    interactions.substrate.emplace();
    interactions.free_surface.emplace();
    interactions.surface_potential = {-25};
    auto document = config::Document::from_text("colloidal: {electrostatic: {debye_length: 5 nm}}");
    interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
    const std::vector<std::pair<double, Vec3>> spheres = {
        {1, {5, 5, 1.01}}, {0.5, {6.2, 5.9, 1.2}}, {0.3, {5.9, 4.4, 1.75}}, {1, {5.3, 5.1, 3.1}}, {0.25, {6.1, 5.2, 2.0}},
        {0.4, {9.9, 5, 2}}, {0.5, {0.9, 5, 2.05}}, {0.2, {3.8, 5, 3.795}}};
    for (const auto& [a, x] : spheres) {
      particles.id.push_back(static_cast<std::int64_t>(10 + 7 * position.size() % 8));
      particles.radius.push_back(a);
      particles.mass.push_back(0);
      particles.species.push_back(0);
      position.push_back(x);
    }
    const Liquid liquid = liquid_at(interactions.liquid, 298.15);
    neighbours::PairRange range = assembly::pair_range(interactions, liquid);
    range.skin = 0.1;
    list = neighbours::make_neighbour_list(cell, position, particles.radius, range);
    step = std::make_unique<assembly::StepAssembly>(interactions, particles, cell, list);
    step->begin(position, {4, 4, 4, 0, 0}, liquid, 0.01, assembly::Treatment::PathAverage, {}, std::vector<double>(position.size(), 0.0));
    step->build_resistance(system);
    for (std::int32_t i : list.order) id.push_back(particles.id[i]);
  }
  std::size_t size() const { return position.size() * static_cast<std::size_t>(system.unknowns_per_particle()); }
  MatrixXd resistance() const {
    MatrixXd r(size(), size());
    for (std::size_t q = 0; q < size(); ++q) {
      std::vector<double> x(size(), 0.0), y;
      x[q] = 1;
      solve::apply(system, x, y);
      for (std::size_t p = 0; p < size(); ++p) r(p, q) = y[p];
    }
    return r;
  }
};

}  // namespace

// Exact: the outer products of all modes sum to R. 1e-13 of the largest entry is rounding.
TEST(ThermalForce, ModesSumToTheResistance) {
  for (const auto& [rotation, hindered] : {std::pair(true, false), {false, false}, {true, true}}) {
    const Cluster layer(rotation, hindered);
    const std::size_t n = layer.size(), D = static_cast<std::size_t>(layer.system.unknowns_per_particle());
    MatrixXd sum = MatrixXd::Zero(n, n);
    const auto add = [&](const std::vector<double>& f) {
      const auto v = Eigen::Map<const Eigen::VectorXd>(f.data(), static_cast<Eigen::Index>(n));
      sum += v * v.transpose();
    };
    std::size_t full = 0;
    for (std::size_t k = 0; k < layer.system.particle.size(); ++k)
      for (int m = 0; m < assembly::modes_of_particle; ++m) {
        double x[assembly::modes_of_particle] = {};
        x[m] = 1;
        std::vector<double> f(n, 0.0);
        assembly::add_particle_modes(assembly::without_flow(layer.system.particle[k], layer.system.mean_flow, k), rotation, x, &f[k * D]);
        add(f);
      }
    for (const auto& chunk : layer.system.full)
      for (const solve::FullPair& p : chunk)
        for (int m = 0; m < assembly::modes_of_pair; ++m) {
          double x[assembly::modes_of_pair] = {};
          x[m] = 1;
          std::vector<double> f(n, 0.0);
          assembly::add_pair_modes(p, rotation, full % 2 == 0, x, &f[p.i * D], &f[p.j * D]);
          add(f);
          if (m == 0) ++full;
        }
    for (const auto& chunk : layer.system.squeeze)
      for (const solve::SqueezePair& p : chunk) {
        std::vector<double> f(n, 0.0);
        for (int d = 0; d < 3; ++d) {
          f[p.i * D + d] = std::sqrt(p.squeeze) * p.n[d];
          f[p.j * D + d] = -f[p.i * D + d];
        }
        add(f);
      }
    EXPECT_GE(full, 4u);
    EXPECT_EQ(layer.system.mean_flow.empty(), !hindered);
    for (std::size_t at = 0; at < layer.system.mean_flow.share.size(); ++at) {
      std::vector<double> x(layer.system.mean_flow.share.size(), 0.0), f(n, 0.0);
      x[at] = 1;
      assembly::add_flow_modes(layer.system.mean_flow, D, x, f.data());
      add(f);
    }
    const MatrixXd r = layer.resistance();
    EXPECT_LT((sum - r).cwiseAbs().maxCoeff(), 1e-13 * r.cwiseAbs().maxCoeff()) << "rotation " << rotation;
  }
}

// The sample covariance of n draws of a Gaussian of covariance C errs by sqrt((C_pq^2 + C_pp C_qq)/n) in an entry. Over all entries
// (1,176 with rotation) the largest of so many normal deviates exceeds 4.9 with a probability of 0.1 %.
TEST(ThermalForce, SampleCovarianceIsTwoKTResistanceOverTheStep) {
  for (const auto& [rotation, hindered] : {std::pair(true, false), {false, false}, {true, true}}) {
    const Cluster layer(rotation, hindered);
    const Eigen::Index n = static_cast<Eigen::Index>(layer.size());
    const int draws = 20000;
    const double kT = 0.0041164, dt = 0.01;
    MatrixXd sum = MatrixXd::Zero(n, n);
    for (int s = 0; s < draws; ++s) {
      const std::vector<double> f = assembly::thermal_force(layer.system, layer.id, 3, {s}, std::sqrt(2 * kT / dt));
      const auto v = Eigen::Map<const Eigen::VectorXd>(f.data(), n);
      sum.selfadjointView<Eigen::Lower>().rankUpdate(v);
    }
    const MatrixXd c = 2 * kT / dt * layer.resistance();
    double worst = 0;
    for (Eigen::Index p = 0; p < n; ++p)
      for (Eigen::Index q = 0; q <= p; ++q) {
        const double error = std::sqrt((c(p, q) * c(p, q) + c(p, p) * c(q, q)) / draws);
        worst = std::max(worst, std::abs(sum(p, q) / draws - c(p, q)) / error);
      }
    EXPECT_LT(worst, 4.9) << "rotation " << rotation;
  }
}

TEST(ThermalForce, IsTheSameAtAnyThreadCount) {
  const Cluster layer(true);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = assembly::thermal_force(layer.system, layer.id, 3, {7}, 1);
  omp_set_num_threads(3);
  const auto three = assembly::thermal_force(layer.system, layer.id, 3, {7}, 1);
  omp_set_num_threads(threads);
  EXPECT_EQ(one, three);
  EXPECT_NE(one, assembly::thermal_force(layer.system, layer.id, 4, {7}, 1));
  EXPECT_NE(one, assembly::thermal_force(layer.system, layer.id, 3, {8}, 1));
}

// Which of a pair is called i is the list's affair: with its ids, radii, levers and normal turned round the pair has the same force.
TEST(ThermalForce, OfAPairDoesNotDependOnItsOrder) {
  const solve::FullPair p{0, 1, 1, {0.6, 0, 0.8}, 0.51, 0.26, 3, 0.2, 0.9, 0.4, 0.5};
  const solve::FullPair q{0, 1, 1, {-0.6, 0, -0.8}, 0.26, 0.51, 3, 0.2, 0.9, -0.4, 0.5};
  const double x[8] = {0.3, -1.1, 0.7, 0.2, -0.5, 1.3, -0.4, 0.9};
  double pi[6] = {}, pj[6] = {}, qi[6] = {}, qj[6] = {};
  assembly::add_pair_modes(p, true, false, x, pi, pj);
  assembly::add_pair_modes(q, true, true, x, qi, qj);
  for (int d = 0; d < 6; ++d) {
    EXPECT_NEAR(pi[d], qj[d], 1e-15) << d;
    EXPECT_NEAR(pj[d], qi[d], 1e-15) << d;
  }
}

// The increments of the parts of a step add up to the step's: sqrt(length) times its normals, at every level.
TEST(ThermalForce, PartsOfAStepAreOnePath) {
  const RandomKey key{5, Stream::ThermalPair};
  const auto increment = [&](int level, std::uint64_t part, int k) {
    return std::pow(0.5, 0.5 * level) * assembly::path_normals(key, {9, level, part}, 1, 2)[k];
  };
  for (int level = 0; level < 6; ++level)
    for (std::uint64_t part = 0; part < (std::uint64_t{1} << level); ++part)
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(increment(level + 1, 2 * part, k) + increment(level + 1, 2 * part + 1, k), increment(level, part, k), 1e-14);
  // One normal drawn alone is the first of four.
  for (std::uint64_t part : {0, 5, 31}) EXPECT_EQ(assembly::path_normal(key, {9, 5, part}, 1, 2), assembly::path_normals(key, {9, 5, part}, 1, 2)[0]);
  // and are independent normals: 4 x 1024 of the tenth level, mean square 1 within 4 standard errors (false alarm 6e-5).
  double square = 0, neighbours = 0;
  for (std::uint64_t part = 0; part < 1024; ++part)
    for (int k = 0; k < 4; ++k) {
      const double x = assembly::path_normals(key, {9, 10, part}, 1, 2)[k];
      square += x * x;
      neighbours += x * assembly::path_normals(key, {9, 10, (part + 1) % 1024}, 1, 2)[k];
    }
  EXPECT_NEAR(square / 4096, 1, 4 * std::sqrt(2.0 / 4096));
  EXPECT_NEAR(neighbours / 4096, 0, 4 * std::sqrt(1.0 / 4096));
}
