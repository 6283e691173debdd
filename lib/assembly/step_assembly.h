#pragma once
// The linear system of one step: (R + dt K) U = F, built at positions x0 for a step of length dt.
//
// Every term that is stiff in a gap is taken at the end of the step, linearised about a guess of that gap: the force as
// f(h*) - k (h1 - h*), k its stiffness where it is positive, the singular squeeze resistance by Newton's linearisation of its
// impulse over the step, c ln(h0/h1) (resistance/pair_lubrication.h). The first guess is the gap at the beginning; a step in
// which some gap closes quickly, or the free surface catches or releases particles, is solved again with the gaps that came out
// (refine). The impulse diverges as h1 -> 0, so that no gap crosses zero.
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "assembly/gap_guess.h"
#include "assembly/interactions.h"
#include "assembly/pair_separation.h"
#include "assembly/rough_substrate.h"
#include "assembly/slice_flow.h"
#include "assembly/step_force.h"
#include "assembly/surface_search.h"
#include "model/particles.h"
#include "neighbours/neighbour_list.h"
#include "resistance/pair_lubrication.h"
#include "solve/pair_system.h"

namespace pigment::assembly {

// The surroundings of a step, constant or averaged over it. Velocities in um/ms, upwards positive.
struct Film {
  double height_begin = 0, height_end = 0;  // of the free surface, um; unused without one
  // Of a pressure-limited surface height_end is the lowest that it can stand at; it is sought from here.
  double height_guess = 0;
  double absorption = 0;                    // q: the liquid moves with -q e_z
  double evaporation = 0;                   // e
};

// Forces between layer and boundaries, pN/um^2 (force per area), upwards on the substrate's side counted as pressure.
struct BoundaryPressures {
  double surface = 0;    // what the free surface presses with: spring and hydrodynamic
  double substrate = 0;  // what the substrate carries: colloidal and hydrodynamic
  double liquid = 0;     // of the liquid at the bottom over that at the top: the drag on all particles
  int contacts = 0;      // particles held by the surface
};

struct GapCheck {
  bool refine = false;         // solve again
  bool crossed = false;        // some gap that was open came out closed
  bool only_pairs = true;      // nothing but open gaps of pairs asks for it
  bool counted = true;         // all that asks for it has its share in `linearisation`
  double miss = 0;             // sum of squares of how far gaps came out from their guesses, in units of gap + scale
  double linearisation = 0;    // the same of what is left of a force linearised so far off, (gap - guess)^2/2 guess or less where
                               // the true force there is nearly the linear law's, and of how far
                               // particles at the surface stick out of it or would be moved by what it holds them with wrongly
  double farthest = 0;         // largest |gap - guess|/guess
  bool far = false, deep = false;  // some gap came out so far off its guess, or so much nearer, that its linear law says nothing of it
  double surface_height = 0;   // at the end of the step, um
  double smallest_gap = 0;     // at the end of the step, um (pairs)
  std::size_t worst_pair = 0;  // index into the neighbour list's pairs
};

// How a step takes what depends on the gaps: forces and resistances at its beginning; forces linearised there; or both
// linearised about the gaps that come out, found by iteration. For noise that obeys fluctuation and dissipation
// (assembly/path_average.cpp): forces as in the first two or averaged along the step, and, unless asked not to
// (Interactions::brownian, drift), the resistance half-way between the step's ends.
// ConvexSplitting: as Newton, but attractions that ease with distance are taken at the beginning, so that what is left is the minimum of
// a convex function, whatever the length of the step [eyre1998].
enum class Treatment { Explicit, LinearlyImplicit, Newton, ConvexSplitting, ExplicitMidpoint, ImplicitMidpoint, PathAverage };

// What a step of the second-order backward differentiation formula ([hairer1996]) starts from besides its beginning, file order, um.
// With w the step over the last one, the formula is Euler's step from `from` = x0 + w^2/(1 + 2w) (x0 - x_before) over
// (1 + w)/(1 + 2w) of the step.
struct TwoStep {
  double share = 0;                 // w^2/(1 + 2w)
  const Vec3Array& before;          // where the last step began
  const Vec3Array& from;
  const Vec3Array& predicted;       // at the step's end, to second order: where axes and resistances are taken
  double range = 5e-3;              // of a gap, um, over which forces change: the Debye length
};

class StepAssembly {
 public:
  // Arrays of the particles in engine order follow from list.order; species potentials from interactions.
  StepAssembly(const Interactions&, const Particles&, const Cell&, const neighbours::NeighbourList&);

  // Geometry at the beginning of a step. position: file order; force: external (Brownian) force a particle, file order, or
  // empty; protrusion: guess of each particle's protrusion through the free surface at the end of the step, file order.
  void begin(const Vec3Array& position, const Film&, const Liquid&, double dt, Treatment, const Vec3Array& force,
             const std::vector<double>& protrusion, const TwoStep* = nullptr);
  // Splitting alone: axes half-way along the motion that these velocities (engine order) foretell, and the gaps of pairs that are not
  // about to bond.
  void foretell(const std::vector<double>& velocity);
  // Fills the system for the current guesses.
  void build(solve::PairSystem&) const;
  // Fills the system with R at the beginning of the step alone: no stiffness; its right-hand side means nothing.
  void build_resistance(solve::PairSystem&);
  // A random force, engine order, D a particle, that acts from here to the next begin().
  void set_random_force(std::vector<double> force) { random_force_ = std::move(force); }
  // Judges a solution (engine order) of the system built last and moves the guesses towards it.
  // scale: um, the length by which a gap may be wrong (GapCheck::miss). tolerance: of the step, in these units: a twentieth
  // of it, as a root mean square over the particles, is what may be left of the linearisation; 0: nothing.
  GapCheck refine(const solve::PairSystem&, const std::vector<double>& solution, double scale = 5e-3, double tolerance = 0);

  const solve::PairTopology& topology() const { return topology_; }
  std::size_t pair_count() const { return pairs_.size(); }
  // Rate of change of every pair's gap for a solution, um/ms; and the gaps at the beginning.
  void gap_velocities(const std::vector<double>& solution, std::vector<double>& rate) const;
  const std::vector<double>& gaps() const { return gap_begin_; }
  // How much of an error at the beginning of the step each gap still has at its end, by its own stiffness: one minus the share that
  // relaxes within it. With ConvexSplitting and in two-step methods.
  const std::vector<double>& memory() const { return memory_; }
  BoundaryPressures boundary_pressures(const std::vector<double>& solution) const;
  // Protrusion of every particle at the end of the step for the accepted solution, file order: next step's guess.
  std::vector<double> protrusions() const;
  // The liquid's slices, from below, for a solution; none without hindered drag.
  std::vector<SliceState> slice_states(const std::vector<double>& solution) const;
  // Smallest distance of a sphere to a substrate that is not the plane, um; infinite for the plane.
  double rough_gap(const Vec3& position, double radius) const;
  const neighbours::IndexPair& pair(std::size_t p) const { return pairs_[p]; }  // engine indices
  double pair_force(std::size_t p) const;  // colloidal, at the current guess

 private:
  struct SurfaceState {
    double gap_begin, resistance, force, stiffness, anchor;  // spring: force + stiffness (p1 - anchor); none while held
  };
  struct SubstrateState {
    double gap_begin, force, stiffness;
  };
  void particle_terms(int chunk, solve::PairSystem&, double* rhs) const;
  void pair_terms(int chunk, solve::PairSystem&, double* rhs) const;
  SurfaceState surface_state(int k) const;
  SubstrateState substrate_state(int k) const;
  resistance::SqueezeStep wall_squeeze(int k) const;  // the whole perpendicular term of the substrate
  double squeeze_weight(std::size_t p) const;         // taper on the singular part of a pair's squeeze resistance
  forces::PairGeometry geometry(std::size_t p) const;  // at the guess
  // What a step of the pair moves from: its gap then, and the gap whose logarithm its squeeze starts from (TwoStep::from).
  double gap_from(std::size_t p) const { return two_step_ ? gap_from_[p] : gap_begin_[p]; }
  double squeeze_from(std::size_t p) const { return two_step_ ? squeeze_from_[p] : gap_begin_[p]; }
  forces::PairGeometry wall_geometry(int k) const;  // at the guess
  void set_scalars(int chunk, std::size_t p, const resistance::PairScalars&);
  StepForce pair_step_force(int chunk, std::size_t p) const;
  StepForce substrate_step_force(int k) const;
  double wall_stiffness(int chunk, std::size_t p) const;  // pN/um, that the linear law has at least
  double gap_alone(StepForce, const forces::PairGeometry&) const;
  // Gaps of some pairs at the step's end, and how far they moved apart along their normals.
  void move_pairs(const std::vector<double>& velocity, std::size_t first, std::size_t count, double* gap, double* along) const;
  std::vector<double> in_fours(const std::vector<double>& solution) const;  // velocities, four numbers a particle (pair_separation.h)
  // Terms of the plane and of the free surface at the heights where resistances are taken.
  resistance::BoundaryScalars wall_scalars(int k) const;
  resistance::BoundaryScalars surface_scalars(int k) const;
  double surface_gap(int k) const;
  double approach_speed() const;  // of the surface towards particles at rest, um/ms
  double surface_pressure(const std::vector<double>& solution) const;
  void begin_path();
  // A run of a chunk's pairs, no more than law_pairs.
  void begin_two_step(int chunk, std::size_t first, std::size_t count, const TwoStepSpheres&, const TwoStep&);
  void path_forces(std::size_t begin, std::size_t end, std::span<double> force, std::span<double> stiffness) const;
  // Adds what the colloidal laws say of the pairs from `begin` to `end` at their guesses; no more than law_pairs of them.
  enum class Laws { All, Concave, NotConcave };
  void add_laws(std::size_t begin, std::size_t end, Laws, std::span<double> force, std::span<double> stiffness) const;
  void add_laws(std::span<const std::int32_t> pairs, std::span<double> force, std::span<double> stiffness) const;  // all laws
  void add_laws(std::size_t begin, std::size_t end, std::span<forces::PairTerm>) const;
  static constexpr std::size_t law_pairs = 64;
  void follow_flow(const std::vector<double>& solution);
  void follow_path(int chunk, const std::vector<double>& solution, GapCheck&);
  forces::PairTerm substrate_term(const forces::PairGeometry&) const;
  SubstrateState path_substrate_state(int k) const;

  const Interactions& interactions_;
  Cell cell_;
  const std::vector<std::int32_t>& order_;
  const std::vector<neighbours::IndexPair>& pairs_;
  solve::PairTopology topology_;
  std::vector<double> radius_, mass_, potential_;  // engine order
  std::vector<double> guess_;                      // gap at the step's end, one a pair
  std::vector<double> wall_guess_;                 // gap to the plane at the step's end, one a particle

  // of the current step
  Film film_;
  Liquid liquid_{};
  double dt_ = 0;
  bool implicit_ = true, newton_ = true;
  bool split_ = false;
  std::vector<std::vector<double>> standing_force_;  // of concave laws at the beginning, where split: one array a chunk
  std::vector<double> substrate_standing_force_;
  // Newton's method, one a pair: the linear law is no softer than this, pN/um; 0 but for contacts that open.
  std::vector<double> least_stiffness_;
  mutable std::vector<double> memory_;  // resistance over resistance and stiffness times the step, one a pair
  std::vector<std::unique_ptr<forces::PreparedPairLaw>> laws_;
  double prepared_temperature_ = -1, colloidal_reach_ = 0;  // reach: gap beyond which no law acts, um
  std::vector<Vec3> position_, external_force_;
  std::vector<Sphere> sphere_;             // position_ and radius_ side by side
  std::optional<SliceFlow> flow_;
  std::optional<RoughSubstrate> rough_;    // in place of the plane
  std::vector<Vec3> normal_;               // one a pair
  std::vector<double> gap_begin_;          // one a pair
  // What the motion of the step starts from (TwoStep::from): gap and separation; and the gap whose logarithm the squeeze starts from.
  // But in a two-step method all are those of the beginning.
  bool two_step_ = false;
  std::vector<double> gap_from_, squeeze_from_;           // one a pair, two-step only
  std::vector<double> height_begin_, wall_squeeze_from_;  // one a particle, two-step only: its centre at the beginning
  SurfaceSearch search_;                   // of a pressure-limited surface
  double surface_end_ = 0;                 // height at the step's end, um
  double entry_pressure_ = 0;              // of air into the pores, pN/um^2; pressure-limited only
  std::vector<double> resistance_gap_;     // gap at which R is taken: that at the beginning, or half-way
  std::vector<double> resistance_height_;  // of a particle's centre, likewise
  std::vector<double> random_force_;
  bool path_ = false, path_resistance_ = false, path_force_ = false, resistance_only_ = false;
  int passes_ = 0;  // solutions judged in this step
  std::vector<std::unordered_map<std::size_t, GapBracket>> bracket_;  // of the pairs that have one, chunk by chunk
  // What each pair's gap gains as its axis turns in the step, (transverse motion)^2/2r, um: no part of the linear system, it is taken from
  // the last solution. Left out, a bond that turns by 5 degrees would be held 1 nm from where its force is right.
  std::vector<double> turn_;
  std::vector<double> swing_;  // velocities that axes turn by, four numbers a particle: the running mean of the solutions
  // What the averages along the step start from.
  std::vector<Vec3> separation_;                             // one a pair, from i to j
  std::vector<forces::PairTerm> term_begin_, substrate_term_begin_;
  // What each particle is to the surface: free (0), held exactly (`held`), or lifted on the spring by so much, um; and how it
  // came out, with the force of those held, pN.
  static constexpr double held = 1e-12;
  std::vector<double> protrusion_guess_, protrusion_end_, holding_force_;
  mutable std::vector<double> mean_force_;  // along the path, one a pair
  // At resistance_gap_: the squeeze of every pair, and the other scalars of the few that are near enough to have them, rising in p. One
  // array a chunk.
  mutable std::vector<double> squeeze_;
  struct NearScalars {
    std::int32_t pair = 0;
    resistance::PairScalars scalars;
  };
  std::vector<std::vector<NearScalars>> near_;
  // Where a step takes all at its beginning most pairs listed are too far apart for anything to act: those that are not, rising, one array
  // a chunk.
  bool all_act_ = true;
  std::vector<std::vector<std::int32_t>> acting_;
  // One a particle, where they stay what they are all through a step; else empty.
  std::vector<resistance::BoundaryScalars> wall_, surface_;
};

}  // namespace pigment::assembly
