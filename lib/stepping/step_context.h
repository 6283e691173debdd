#pragma once
// What the integrators share: the layer's surroundings in time, its neighbour list, and the solution of one linear or Newton
// step from given positions.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "assembly/step_assembly.h"
#include "assembly/thermal_force.h"
#include "solve/adaptive_solver.h"
#include "stepping/problem.h"
#include "stepping/run_state.h"

namespace pigment::stepping {

// From where a step goes, and how far.
struct StepStart {
  const Vec3Array& position;              // file order, um
  const std::vector<double>& protrusion;  // guess for the free surface, file order, um
  double time = 0;                        // ms
  double step = 0;                        // ms
  assembly::NoiseInterval noise;          // of the step: names its random numbers
  double surface_height = 0, surface_velocity = 0;  // of a pressure-limited surface at the beginning, um and um/ms
  // Of a two-step method: with it the solution is the velocity at the step's end, which leads there from two_step->from in `span`, ms.
  const assembly::TwoStep* two_step = nullptr;
  double last_step = 0, span = 0;
};

// Velocities of one solve and what they say of the step.
struct StepSolution {
  bool good = false;                   // converged, and no gap that was open came out closed
  std::vector<double> velocity;        // engine order, D a particle
  std::vector<double> protrusion;      // guess for the next step, file order
  assembly::BoundaryPressures pressures;
  assembly::GapCheck check;
  solve::SolveReport solve;
  int iterations = 0, solves = 0;
};

class StepContext {
 public:
  StepContext(const Problem&, const RunState&);

  const Problem& problem() const { return problem_; }
  Liquid liquid_at_time(double time) const;
  double height_at(double time) const;  // um; the cell's own height where there is no free surface
  // Where the surface stands after a step that ends at `time`: the dewatering's height, or above it where it is pressure-limited.
  double surface_height(const StepSolution& solution, double time) const {
    return problem_.interactions.pressure_limited() ? solution.check.surface_height : height_at(time);
  }
  // Makes the neighbour list anew where the state's positions have spent it, and records in the state what it was made from.
  void refresh_list(RunState&);

  // One solve of R U = F (explicit), (R + dt K) U = F (linearly implicit), or this repeated until every gap came out near what
  // the system was linearised about (Newton). guess: velocities to start the solver from, engine order; empty: none.
  StepSolution solve(const StepStart&, assembly::Treatment, std::vector<double> guess);
  // Velocities of the last step, extrapolated: the guess for the next one. Empty with Brownian motion, whose last velocities
  // are worse than none.
  std::vector<double> extrapolated_velocity(const RunState&) const;

  std::size_t unknowns() const { return problem_.interactions.rotation() ? 6 : 3; }
  std::vector<double> in_engine_order(const Vec3Array& velocity, const Vec3Array& angular) const;
  void in_file_order(const std::vector<double>& solution, Vec3Array& velocity, Vec3Array& angular) const;
  // Gap of every listed pair at these positions (file order), um.
  std::vector<double> gaps(const Vec3Array& position) const;
  // The scene's Debye length at the liquid's temperature then, um (gap_scale).
  double gap_scale_at(double time) const;
  // A listed pair's particles, file order.
  std::pair<std::int32_t, std::int32_t> pair(std::size_t p) const { return {list_.order[list_.pairs[p].i], list_.order[list_.pairs[p].j]}; }
  // The height z of a particle, brought back between the surface (or the height safe_z, where that is above it) and a fifth of
  // the gap that safe_z leaves to the substrate.
  static constexpr double nearest_share = 0.2;
  // The share of a pair's gap that extrapolating may leave: where forces are steepest, within a tenth of the Debye length of contact,
  // most of it. A bond pressed to a fifth of its length pushes a thousand times as hard as anything that acts on it.
  double nearest_share_at(double gap) const { return gap < 0.1 * gap_scale_ ? 0.9 : nearest_share; }
  double height_within(std::size_t particle, double z, double safe_z, double surface) const;
  // Whether a particle that `safe` leaves outside a rough substrate is nearer to it at `position` than a fifth of that gap.
  bool too_near_substrate(std::size_t particle, const Vec3& position, const Vec3& safe) const;
  // Whether two spheres that are apart at `begin` overlap at `end`: lubrication lets none through that the list has, and it has all that
  // touch while nobody moves by half its reach.
  bool overlaps_unseen(const Vec3Array& begin, const Vec3Array& end) const;
  // Makes the list anew within a step; the next step makes its own.
  void list_at(const Vec3Array& position, double time);
  // Root mean square, over the pairs that are near each other at the step's beginning, of a difference of gaps in units of
  // gap + Debye length, of which one counts as 0.3 at most.
  double gap_error(const std::vector<double>& gap_begin, const std::vector<double>& difference) const;
  // Rate of change of every listed pair's gap, at the normals of the step solved last, um/ms.
  std::vector<double> gap_rates(const std::vector<double>& solution) const;
  const std::vector<double>& memory_of_last_step() const { return assembly_->memory(); }
  const std::vector<double>& gaps_of_last_step() const { return assembly_->gaps(); }

  // What the solver knows at the beginning of a step, and at the last one's end (solve/adaptive_solver.h).
  void remember(solve::SolverMemory memory) { memory_ = memory; }
  solve::SolverMemory memory() const { return solver_.memory(); }

  // Why a step of this length failed: step, time, pair, radii, gap, force and a step that would do.
  std::string describe_failure(const RunState&, double dt, const StepSolution&) const;

 private:
  assembly::Film film(const StepStart&) const;
  void make_list(const Vec3Array& reference, const Liquid&);
  Vec3Array brownian_force(std::int64_t step, double dt, const Liquid&) const;

  const Problem& problem_;
  neighbours::NeighbourList list_;
  std::unique_ptr<assembly::StepAssembly> assembly_;
  std::vector<std::int64_t> id_;  // engine order
  solve::PairSystem system_;
  solve::AdaptiveSolver solver_;
  solve::SolverMemory memory_;
  bool listed_within_step_ = false;
  double gap_scale_ = 0;  // um, at the temperature of the step solved last
};

}  // namespace pigment::stepping
