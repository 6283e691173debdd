#include "stepping/stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "neighbours/neighbour_list.h"
#include "solve/adaptive_solver.h"
#include "stepping/step_control.h"

namespace pigment::stepping {

namespace {

constexpr double shortest_step = 1e-9;  // ms
constexpr int most_refinements = 25;

}  // namespace

struct Stepper::Data {
  const Problem& problem;
  std::vector<std::int32_t> order;
  neighbours::NeighbourList list;
  std::unique_ptr<assembly::StepAssembly> assembly;
  solve::PairSystem system;
  solve::AdaptiveSolver solver;
  long saved_factor = 0;  // revision of the factor that the state holds
  std::vector<double> rate, previous_rate;

  explicit Data(const Problem& p) : problem(p) {}

  Liquid liquid_at_time(double t) const {
    return liquid_at(problem.interactions.liquid,
                     problem.dewatering.temperature_at(t, problem.interactions.liquid.temperature));
  }
  double height(double t) const {
    if (!problem.interactions.free_surface || problem.dewatering.time.empty()) return problem.cell.height;
    return problem.cell.height - problem.dewatering.absorbed_at(t) - problem.dewatering.evaporated_at(t);
  }
  assembly::Film film(double t0, double t1) const {
    assembly::Film f;
    f.height_begin = height(t0);
    f.height_end = height(t1);
    if (!problem.dewatering.time.empty()) {
      f.absorption = problem.dewatering.mean_absorption_flux(t0, t1);
      f.evaporation = problem.dewatering.mean_evaporation_flux(t0, t1);
    }
    return f;
  }
  void make_list(const Vec3Array& reference, const Liquid& liquid) {
    neighbours::PairRange range = assembly::pair_range(problem.interactions, liquid);
    // A wider skin lists more pairs and lasts longer. Noise shakes every particle at every step and spends it sooner.
    const double smallest = *std::min_element(problem.particles.radius.begin(), problem.particles.radius.end());
    range.skin = std::max(0.02, (problem.interactions.brownian ? 0.8 : 0.4) * smallest);
    list = neighbours::make_neighbour_list(problem.cell, reference, problem.particles.radius, range);
    assembly = std::make_unique<assembly::StepAssembly>(problem.interactions, problem.particles, problem.cell, list);
  }
  std::size_t unknowns() const { return problem.interactions.rotation() ? 6 : 3; }

  // Engine order <- file order.
  std::vector<double> gathered(const Vec3Array& u, const Vec3Array& w) const {
    const std::size_t D = unknowns();
    std::vector<double> x(list.order.size() * D);
    for (std::size_t k = 0; k < list.order.size(); ++k) {
      for (int d = 0; d < 3; ++d) x[k * D + d] = u[list.order[k]][d];
      if (D == 6)
        for (int d = 0; d < 3; ++d) x[k * D + 3 + d] = w[list.order[k]][d];
    }
    return x;
  }

  // One random unit vector a particle and step: (a)-(e) of section 3.3.3 in [sand2010].
  // Differs from [sand2010]: step (d) there reads x = sqrt(r cos t); x = r cos t is meant.
  Vec3Array brownian_force(std::int64_t step, double dt, const Liquid& liquid) const {
    const std::size_t n = problem.particles.size();
    const double k = problem.calibration ? problem.calibration->value_at(liquid.temperature, dt)
                                         : brownian_constant(liquid.viscosity, liquid.thermal_energy(), dt);
    const RandomKey key{problem.seed, Stream::BrownianForce};
    Vec3Array force(n);
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i) {
      const auto u = random_uniforms(key, static_cast<std::uint64_t>(step), static_cast<std::uint64_t>(problem.particles.id[i]));
      const double z = 2 * u[0] - 1, t = 2 * std::numbers::pi * u[1], r = std::sqrt(1 - z * z);
      force[i] = k * std::sqrt(problem.particles.radius[i]) * Vec3(r * std::cos(t), r * std::sin(t), z);  // (25)
    }
    return force;
  }

  // Root mean square over near pairs of dt/2 |change of gap rate| over (gap + scale).
  double error_estimate(const std::vector<double>& solution, const RunState& state, double dt, double scale) {
    if (state.last_step <= 0) return 0;
    assembly->gap_velocities(solution, rate);
    assembly->gap_velocities(gathered(state.velocity, state.angular_velocity), previous_rate);
    const std::vector<double>& gap = assembly->gaps();
    const double mean_step = 0.5 * (dt + state.last_step);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t p = 0; p < rate.size(); ++p) {
      const auto pair = assembly->pair(p);
      const double smaller = std::min(problem.particles.radius[list.order[pair.i]], problem.particles.radius[list.order[pair.j]]);
      if (gap[p] > std::max(20 * scale, 0.4 * smaller)) continue;
      const double error = 0.5 * dt * dt * (rate[p] - previous_rate[p]) / mean_step / (std::max(gap[p], 0.0) + scale);
      sum += error * error;
      ++count;
    }
    return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
  }

  [[noreturn]] void give_up(const RunState& state, double dt, const solve::SolveReport& solve, const assembly::GapCheck& check) const {
    std::string what = fmt::format("step {} at t = {:.6g} s failed with dt = {:.3g} s", state.step, state.time * 1e-3, dt * 1e-3);
    if (!solve.message.empty()) what += "; the solver: " + solve.message;
    if (assembly->pair_count() > 0 && check.worst_pair < assembly->pair_count()) {
      const auto pair = assembly->pair(check.worst_pair);
      const std::int32_t i = list.order[pair.i], j = list.order[pair.j];
      const auto& particles = problem.particles;
      what += fmt::format("; worst pair: ids {} and {}, radii {:.4g} and {:.4g} um, gap {:.3g} nm at the step's end, colloidal force {:.3g} pN",
                          particles.id[i], particles.id[j], particles.radius[i], particles.radius[j], check.smallest_gap * 1e3,
                          assembly->pair_force(check.worst_pair));
    }
    what += fmt::format("; try stepping.time_step below {:.1g} s or a smaller stepping.tolerance", dt * 1e-4);
    throw NumericsError(what);
  }
};

Stepper::Stepper(const Problem& problem, const RunState& state) : data_(std::make_unique<Data>(problem)) {
  data_->make_list(state.list_reference, liquid_at(problem.interactions.liquid, state.list_temperature));
  data_->solver.restore_factor(state.solver_factor, data_->assembly->topology());
}
Stepper::~Stepper() = default;

double Stepper::height_at(double time) const { return data_->height(time); }

double Stepper::first_step(const Problem& p) {
  if (p.stepping.time_step) return *p.stepping.time_step;
  const Liquid liquid = liquid_at(p.interactions.liquid, p.interactions.liquid.temperature);
  if (p.interactions.brownian) return brownian_step(p.particles, liquid, gap_scale(p.interactions, liquid));
  return 1e-3;
}

StepReport Stepper::advance(RunState& state, double longest) {
  Data& d = *data_;
  const Problem& problem = d.problem;
  const bool fixed = problem.stepping.time_step.has_value(), noisy = problem.interactions.brownian.has_value();
  const bool implicit = problem.stepping.integrator == SteppingParameters::Integrator::LinearlyImplicit;
  const Liquid liquid = d.liquid_at_time(state.time);
  const double scale = gap_scale(problem.interactions, liquid);
  if (d.list.is_spent(state.position)) {
    state.list_reference = state.position;
    state.list_temperature = liquid.temperature;
    d.make_list(state.list_reference, liquid);
    d.solver.forget_factor();
  }
  double dt = std::min(state.preferred_step, longest);
  if (dt < longest && dt > 0.5 * longest) dt = 0.5 * longest;  // two even steps rather than a sliver at the end
  StepReport report;
  // Noise makes the last velocities a worse guess than none.
  std::vector<double> guess;
  if (!noisy) guess = d.gathered(state.velocity, state.angular_velocity);
  if (!noisy && state.last_step > 0) {
    const std::vector<double> before = d.gathered(state.previous_velocity, state.previous_angular_velocity);
    for (std::size_t q = 0; q < guess.size(); ++q) guess[q] += guess[q] - before[q];
  }
  // One step's noise moves particles by nanometres either way: a thousandth of it is far below its own weak error.
  const solve::ConjugateGradientOptions options{problem.stepping.solver_tolerance.value_or(noisy ? 1e-3 : 1e-4), 5000};
  for (;; ++report.rejected) {
    const assembly::Film film = d.film(state.time, state.time + dt);
    const Vec3Array force = noisy ? d.brownian_force(state.step, dt, liquid) : Vec3Array{};
    d.assembly->begin(state.position, film, liquid, dt, implicit, force, state.protrusion);
    std::vector<double> solution = guess;
    solve::SolveReport solve;
    assembly::GapCheck check;
    bool good = false;
    for (int pass = 0; pass < most_refinements; ++pass) {
      d.assembly->build(d.system);
      solve = d.solver.solve(d.system, solution, options);
      report.iterations += solve.iterations;
      ++report.solves;
      if (!solve.converged) break;
      check = d.assembly->refine(d.system, solution);
      if (!check.refine) {
        // Without lubrication nothing keeps spheres apart but their forces, and a scene may have none.
        good = !check.crossed || !problem.interactions.lubrication();
        break;
      }
    }
    const double estimate = good && !fixed && !noisy ? d.error_estimate(solution, state, dt, scale) / problem.stepping.tolerance : 0;
    // A step whose error is far above what was asked for is taken again, shorter.
    if (good && estimate < 4) {
      report.step = dt;
      report.error = estimate;
      report.smallest_gap = check.smallest_gap;
      report.pressures = d.assembly->boundary_pressures(solution);
      report.height = film.height_end;
      const std::size_t D = d.unknowns();
      std::swap(state.previous_velocity, state.velocity);
      std::swap(state.previous_angular_velocity, state.angular_velocity);
      for (std::size_t k = 0; k < d.list.order.size(); ++k) {
        const std::int32_t i = d.list.order[k];
        state.velocity[i] = Vec3(solution[k * D], solution[k * D + 1], solution[k * D + 2]);
        if (D == 6) state.angular_velocity[i] = Vec3(solution[k * D + 3], solution[k * D + 4], solution[k * D + 5]);
        state.position[i] += dt * state.velocity[i];
      }
      state.protrusion = d.assembly->protrusions();
      if (d.solver.revision() != d.saved_factor) {
        state.solver_factor = d.solver.packed_factor();
        d.saved_factor = d.solver.revision();
      }
      state.last_step = dt;
      state.time += dt;
      ++state.step;
      if (!fixed && !noisy) {
        // A step cut short to meet an output time says nothing against the longer one.
        const double wanted = next_step(dt, estimate);
        state.preferred_step = dt < state.preferred_step ? std::max(wanted, std::min(state.preferred_step, 4 * wanted)) : wanted;
      }
      return report;
    }
    const double shorter = good ? std::max(0.3, 0.9 / std::sqrt(estimate)) * dt : 0.5 * dt;
    // An explicit step of a length that the scene insists on is a matter for its user.
    if (shorter < shortest_step || (fixed && !implicit)) d.give_up(state, dt, solve, check);
    dt = shorter;
    if (!fixed && !noisy) state.preferred_step = dt;
    if (!noisy) guess = d.gathered(state.velocity, state.angular_velocity);
  }
}

RunState initial_state(const Problem& problem, const Vec3Array& position) {
  RunState s;
  const std::size_t n = position.size();
  s.position = s.list_reference = s.frame_position = position;
  s.velocity = s.angular_velocity = s.previous_velocity = s.previous_angular_velocity = Vec3Array(n, Vec3::Zero());
  s.protrusion.assign(n, 0.0);
  s.frame_height = problem.cell.height;
  s.preferred_step = Stepper::first_step(problem);
  s.list_temperature = problem.dewatering.temperature_at(0, problem.interactions.liquid.temperature);
  return s;
}

}  // namespace pigment::stepping
