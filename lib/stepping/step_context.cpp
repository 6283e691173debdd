#include "stepping/step_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "neighbours/neighbour_list.h"
#include "stepping/step_control.h"

namespace pigment::stepping {

namespace {
// Beside them a pressure-limited surface looks for its height, and the rest follows each time.
constexpr int most_refinements = 25, most_with_search = 60, long_refinement = 3;
// A step whose gaps came out this much off what its forces were linearised about, of the error that it may make, is done. What is left of the
// forces is of second order in that. Among bonds, where it is of first order in time as the step is, all of it: the last bonds to settle there
// are a few of thousands (an uncharged layer of 4,700 particles: 1,359 passes with a half, 1,102 with all).
constexpr double near_share = 0.5, near_share_among_bonds = 1;
// Bonds that are still thrown about by more than their length after so many passes seldom settle in twice as many: a shorter step is
// the quicker way.
constexpr int hopeless = 10;
// A bond that came out this many times its length off, and further with every pass, is torn open; what it held needs shorter steps.
constexpr double runaway = 8;
// An error of one gap counts as no more than this: what changes its course so much within a step has snapped open or shut, which shorter
// steps follow no better. In a jam of 7,070 particles one snap in 30,000 pairs counted as much as all the rest, and made steps a third shorter.
constexpr double snap = 0.3;
}

StepContext::StepContext(const Problem& problem, const RunState& state) : problem_(problem) {
  make_list(state.list_reference, liquid_at(problem.interactions.liquid, state.list_temperature));
}

Liquid StepContext::liquid_at_time(double t) const {
  return liquid_at(problem_.interactions.liquid,
                   problem_.dewatering.temperature_at(t, problem_.interactions.liquid.temperature));
}

double StepContext::gap_scale_at(double time) const { return gap_scale(problem_.interactions, liquid_at_time(time)); }

double StepContext::height_at(double t) const {
  if (!problem_.interactions.free_surface || problem_.dewatering.time.empty()) return problem_.cell.height;
  return problem_.cell.height - problem_.dewatering.absorbed_at(t) - problem_.dewatering.evaporated_at(t);
}

assembly::Film StepContext::film(const StepStart& start) const {
  const double begin = start.time, end = start.time + start.step;
  assembly::Film f;
  f.height_begin = height_at(begin);
  f.height_end = height_at(end);
  if (problem_.interactions.pressure_limited()) {
    f.height_begin = start.surface_height;
    if (start.two_step) f.height_begin += start.two_step->share * start.last_step * start.surface_velocity;
    f.height_guess = start.surface_height + start.step * start.surface_velocity;
  }
  if (!problem_.dewatering.time.empty()) {
    f.absorption = problem_.dewatering.mean_absorption_flux(begin, end);
    f.evaporation = problem_.dewatering.mean_evaporation_flux(begin, end);
    if (start.two_step) {
      // The same formula for the liquid as for the particles in it.
      const double share = start.two_step->share, before = begin - start.last_step;
      f.absorption = (f.absorption * start.step - share * problem_.dewatering.mean_absorption_flux(before, begin) * start.last_step) / start.span;
      f.evaporation = (f.evaporation * start.step - share * problem_.dewatering.mean_evaporation_flux(before, begin) * start.last_step) / start.span;
    }
  }
  return f;
}

void StepContext::make_list(const Vec3Array& reference, const Liquid& liquid) {
  neighbours::PairRange range = assembly::pair_range(problem_.interactions, liquid);
  const double smallest = *std::min_element(problem_.particles.radius.begin(), problem_.particles.radius.end());
  // Pairs that noise may bring together within one step, six standard deviations of a relative displacement apart, are listed before it:
  // unseen, they would pass into each other. Steps that are chosen here are far too short for that.
  if (problem_.interactions.brownian && problem_.stepping.time_step && range.limit(smallest, smallest) > 0) {
    const double diffusivity = liquid.thermal_energy() / (6 * std::numbers::pi * liquid.viscosity * smallest);
    const double reach = 6 * std::sqrt(4 * diffusivity * *problem_.stepping.time_step);
    range.at_least = std::max(range.at_least, std::min(reach, 0.25 * std::min(problem_.cell.width_x, problem_.cell.width_y)));
  }
  // A wider skin lists more pairs and lasts longer: from half the smallest radius to more than one the sum hardly changes.
  range.skin = std::max(0.02, 0.8 * smallest);
  // First without the old ones: both together would be what takes most room in a run.
  assembly_.reset();
  list_ = {};
  list_ = neighbours::make_neighbour_list(problem_.cell, reference, problem_.particles.radius, range);
  assembly_ = std::make_unique<assembly::StepAssembly>(problem_.interactions, problem_.particles, problem_.cell, list_);
  id_.resize(list_.order.size());
  for (std::size_t k = 0; k < id_.size(); ++k) id_[k] = problem_.particles.id[list_.order[k]];
}

void StepContext::refresh_list(RunState& state) {
  if (!listed_within_step_ && !list_.is_spent(state.position)) return;
  listed_within_step_ = false;
  const Liquid liquid = liquid_at_time(state.time);
  state.list_reference = state.position;
  state.list_temperature = liquid.temperature;
  make_list(state.list_reference, liquid);
}

std::vector<double> StepContext::in_engine_order(const Vec3Array& u, const Vec3Array& w) const {
  const std::size_t D = unknowns();
  std::vector<double> x(list_.order.size() * D);
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < list_.order.size(); ++k) {
    for (int d = 0; d < 3; ++d) x[k * D + d] = u[list_.order[k]][d];
    if (D == 6)
      for (int d = 0; d < 3; ++d) x[k * D + 3 + d] = w[list_.order[k]][d];
  }
  return x;
}

void StepContext::in_file_order(const std::vector<double>& x, Vec3Array& u, Vec3Array& w) const {
  const std::size_t D = unknowns(), n = list_.order.size();
  u.resize(n);
  w.assign(n, Vec3::Zero());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < n; ++k) {
    const std::int32_t i = list_.order[k];
    u[i] = Vec3(x[k * D], x[k * D + 1], x[k * D + 2]);
    if (D == 6) w[i] = Vec3(x[k * D + 3], x[k * D + 4], x[k * D + 5]);
  }
}

std::vector<double> StepContext::extrapolated_velocity(const RunState& state) const {
  if (problem_.interactions.brownian) return {};
  std::vector<double> guess = in_engine_order(state.velocity, state.angular_velocity);
  if (state.last_step > 0) {
    const std::vector<double> before = in_engine_order(state.previous_velocity, state.previous_angular_velocity);
    for (std::size_t q = 0; q < guess.size(); ++q) guess[q] += guess[q] - before[q];
  }
  return guess;
}

std::vector<double> StepContext::gaps(const Vec3Array& position) const {
  std::vector<double> gap(list_.pairs.size());
  const auto& radius = problem_.particles.radius;
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < gap.size(); ++p) {
    const std::int32_t i = list_.order[list_.pairs[p].i], j = list_.order[list_.pairs[p].j];
    gap[p] = problem_.cell.minimum_image(position[j] - position[i]).norm() - radius[i] - radius[j];
  }
  return gap;
}

double StepContext::height_within(std::size_t k, double z, double safe_z, double surface) const {
  const auto& interactions = problem_.interactions;
  const double a = problem_.particles.radius[k];
  if (interactions.free_surface) z = std::min(z, std::max(safe_z, surface - a - interactions.free_surface->roughness));
  if (interactions.substrate && !interactions.height_field && safe_z > a) z = std::max(z, a + nearest_share * (safe_z - a));
  return z;
}

bool StepContext::too_near_substrate(std::size_t k, const Vec3& position, const Vec3& safe) const {
  const auto& interactions = problem_.interactions;
  if (!interactions.substrate || !interactions.height_field || position == safe) return false;
  const double a = problem_.particles.radius[k], gap = assembly_->rough_gap(safe, a);
  return gap > 0 && std::isfinite(gap) && assembly_->rough_gap(position, a) < nearest_share * gap;
}

// The state keeps the positions of the list before, from which some particle has moved further than a skin: whoever resumes makes
// the next step's list at the same positions.
void StepContext::list_at(const Vec3Array& position, double time) {
  make_list(position, liquid_at_time(time));
  listed_within_step_ = true;
}

bool StepContext::overlaps_unseen(const Vec3Array& begin, const Vec3Array& end) const {
  if (!problem_.interactions.lubrication()) return false;
  const auto& radius = problem_.particles.radius;
  double farthest = 0;
  for (std::size_t k = 0; k < begin.size(); ++k) farthest = std::max(farthest, (end[k] - list_.reference[k]).squaredNorm());
  const double smallest = *std::min_element(radius.begin(), radius.end());
  const double seen = std::min(smallest, 0.5 * list_.range.limit(smallest, smallest));
  if (farthest < seen * seen) return false;
  const auto gap = [&](const Vec3Array& position, std::int32_t i, std::int32_t j) {
    return problem_.cell.minimum_image(position[j] - position[i]).norm() - radius[i] - radius[j];
  };
  for (const auto& [i, j] : neighbours::find_pairs(problem_.cell, end, radius, {0, 1e-6, 0}))
    if (gap(end, i, j) <= 0 && gap(begin, i, j) > 0) return true;
  return false;
}

double StepContext::gap_error(const std::vector<double>& gap, const std::vector<double>& difference) const {
  const double scale = gap_scale_;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t p = 0; p < gap.size(); ++p) {
    const std::int32_t i = list_.order[list_.pairs[p].i], j = list_.order[list_.pairs[p].j];
    const double smaller = std::min(problem_.particles.radius[i], problem_.particles.radius[j]);
    if (gap[p] > std::max(20 * scale, 0.4 * smaller)) continue;
    const double error = std::min(std::abs(difference[p]) / (std::max(gap[p], 0.0) + scale), snap);
    sum += error * error;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

std::vector<double> StepContext::gap_rates(const std::vector<double>& solution) const {
  std::vector<double> rate;
  assembly_->gap_velocities(solution, rate);
  return rate;
}

// One random unit vector a particle and step: (a)-(e) of section 3.3.3 in [sand2010].
// Differs from [sand2010]: step (d) there reads x = sqrt(r cos t); x = r cos t is meant.
Vec3Array StepContext::brownian_force(std::int64_t step, double dt, const Liquid& liquid) const {
  const std::size_t n = problem_.particles.size();
  const double k = problem_.calibration ? problem_.calibration->value_at(liquid.temperature, dt)
                                        : brownian_constant(liquid.viscosity, liquid.thermal_energy(), dt);
  const RandomKey key{problem_.seed, Stream::BrownianForce};
  Vec3Array force(n);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    const auto u = random_uniforms(key, static_cast<std::uint64_t>(step), static_cast<std::uint64_t>(problem_.particles.id[i]));
    const double z = 2 * u[0] - 1, t = 2 * std::numbers::pi * u[1], r = std::sqrt(1 - z * z);
    force[i] = k * std::sqrt(problem_.particles.radius[i]) * Vec3(r * std::cos(t), r * std::sin(t), z);  // (25)
  }
  return force;
}

StepSolution StepContext::solve(const StepStart& start, assembly::Treatment treatment, std::vector<double> guess) {
  const bool noisy = problem_.interactions.brownian.has_value();
  const Liquid liquid = liquid_at_time(start.time);
  gap_scale_ = gap_scale(problem_.interactions, liquid);
  const bool thermal = noisy && problem_.interactions.brownian->model == forces::BrownianParameters::Model::FluctuationDissipation;
  const Vec3Array force = noisy && !thermal ? brownian_force(start.noise.step, start.step, liquid) : Vec3Array{};
  solver_.begin_step(memory_);
  solve::ConjugateGradientOptions options{solver_tolerance(problem_.stepping, noisy, treatment == assembly::Treatment::ConvexSplitting), 5000};
  assembly_->begin(start.position, film(start), liquid, start.two_step ? start.span : start.step, treatment, force, start.protrusion, start.two_step);
  if (thermal) {
    assembly_->build_resistance(system_);
    assembly_->set_random_force(
        assembly::thermal_force(system_, id_, problem_.seed, start.noise, std::sqrt(2 * liquid.thermal_energy() / start.step)));
  }
  // The first pass of a path average only says where half-way is. Newton's method gains nothing from looser solves: what they leave moves
  // the loosest particles, and with them gaps that were right (HLL, 30 um: 955 passes with early ones up to 20 times looser, 681 without).
  const bool sketch = treatment == assembly::Treatment::PathAverage;
  StepSolution s;
  s.velocity = std::move(guess);
  if (!s.velocity.empty()) assembly_->foretell(s.velocity);
  const int most = problem_.interactions.pressure_limited() ? most_with_search : most_refinements;
  double farthest = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < most; ++pass) {
    assembly_->build(system_);
    solve::ConjugateGradientOptions now = options;
    if (sketch && pass == 0) now.tolerance = std::max(now.tolerance, std::min(10 * now.tolerance, 0.1));
    s.solve = solver_.solve(system_, s.velocity, now);
    if (s.solves == 0) options.largest_scale = s.solve.scale;
    s.iterations += s.solve.iterations;
    ++s.solves;
    if (!s.solve.converged) return s;
    s.check = assembly_->refine(system_, s.velocity, gap_scale_, problem_.stepping.tolerance);
    // Bonds that open and close within the step may have no solution that one linear system has too.
    const double miss = std::sqrt(s.check.miss / static_cast<double>(id_.size()));
    const double left = (treatment == assembly::Treatment::ConvexSplitting ? near_share_among_bonds : near_share) * problem_.stepping.tolerance;
    const bool near = pass >= long_refinement && !problem_.interactions.pressure_limited() && s.check.only_pairs && !s.check.crossed && !s.check.deep && miss < left;
    const bool unsettled = pass >= hopeless && (s.check.crossed || s.check.farthest > 1), torn = pass >= 3 && s.check.farthest > std::max(runaway, farthest);
    if (treatment == assembly::Treatment::ConvexSplitting && (unsettled || torn)) return s;
    farthest = s.check.farthest;
    if (s.check.refine && !near) continue;
    // Without lubrication nothing keeps spheres apart but their forces, and a scene may have none.
    s.good = !s.check.crossed || !problem_.interactions.lubrication();
    break;
  }
  if (!s.good) return s;
  s.pressures = assembly_->boundary_pressures(s.velocity);
  s.protrusion = assembly_->protrusions();
  return s;
}

std::string StepContext::describe_failure(const RunState& state, double dt, const StepSolution& s) const {
  std::string what = fmt::format("step {} at t = {:.6g} s failed with dt = {:.3g} s", state.step, state.time * 1e-3, dt * 1e-3);
  if (!s.solve.message.empty()) what += "; the solver: " + s.solve.message;
  if (assembly_->pair_count() > 0 && s.check.worst_pair < assembly_->pair_count()) {
    const auto pair = assembly_->pair(s.check.worst_pair);
    const std::int32_t i = list_.order[pair.i], j = list_.order[pair.j];
    const auto& particles = problem_.particles;
    what += fmt::format("; worst pair: ids {} and {}, radii {:.4g} and {:.4g} um, gap {:.3g} nm at the step's end, colloidal force {:.3g} pN",
                        particles.id[i], particles.id[j], particles.radius[i], particles.radius[j], s.check.smallest_gap * 1e3,
                        assembly_->pair_force(s.check.worst_pair));
  }
  return what + fmt::format("; try stepping.time_step below {:.1g} s or a smaller stepping.tolerance", dt * 1e-4);
}

}  // namespace pigment::stepping
