#pragma once
// Everything that can influence the rest of a run and is not an input: what a checkpoint holds.
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "base/vec.h"
#include "model/redistribution.h"
#include "solve/adaptive_solver.h"

namespace pigment::stepping {

struct RunState {
  std::int64_t step = 0;
  std::int64_t frame = 0;           // frames written so far; the next output time is frame * every
  double time = 0;                  // ms
  double preferred_step = 0;        // ms; what the controller would take next
  double last_step = 0;             // ms; 0: none yet
  double previous_step = 0;         // ms, the one before
  Vec3Array position;               // um
  Vec3Array velocity;               // um/ms, of the last step
  Vec3Array angular_velocity;       // 1/ms; zero without rotation
  Vec3Array previous_velocity;      // of the step before: extrapolated for the next starting guess
  Vec3Array previous_angular_velocity;
  double surface_height = 0;        // um, of the free surface: the dewatering's, or where a pressure-limited one lags behind
  double surface_velocity = 0;      // um/ms, of the last step
  std::array<double, 3> end_pressure{};  // pN/um^2, at the end of the last step (stepping/integrator.h)
  solve::SolverMemory solver;       // what the last step's solver leaves to the next one's
  std::vector<double> protrusion;   // guess for the free surface, um
  Vec3Array list_reference;         // positions at which the neighbour list was made
  double list_temperature = 0;      // K, of the liquid then: ranges follow it
  Vec3Array frame_position;         // positions at the last output frame: immobility is judged over a frame
  double frame_height = 0;          // H then
  std::deque<Redistribution> redistribution;  // of the last frames, as many as the immobility window holds
  std::deque<double> mass_centre;   // at the last frames under a steady flow, as many as two windows of stationarity hold
  std::vector<double> interval;     // sums since the last frame (stepping/consolidate.cpp)

  std::map<std::string, std::vector<double>> arrays() const;
  std::map<std::string, std::vector<std::int64_t>> integers() const;
  static RunState from(const std::map<std::string, std::vector<double>>&,
                       const std::map<std::string, std::vector<std::int64_t>>&);
};

}  // namespace pigment::stepping
