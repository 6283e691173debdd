#pragma once
// Separations and gaps of many pairs at once, four side by side.
#include <span>
#include <vector>

#include "base/vec.h"
#include "model/cell.h"
#include "neighbours/pair_search.h"

namespace pigment::assembly {

// A particle's centre, unwrapped by any number of periods, and its radius, um.
struct Sphere {
  double x = 0, y = 0, z = 0, radius = 0;
};

// For every pair the nearest image of the separation from i to j as its length and direction, and the gap: what
// Cell::minimum_image gives pair by pair, to the last bit. normal, gap and, unless empty, separation: as long as pairs; um.
void separations(const Cell&, const std::vector<Sphere>&, std::span<const neighbours::IndexPair> pairs, std::span<Vec3> normal,
                 std::span<double> gap, std::span<Vec3> separation);

// What a two-step method starts from, pair by pair (TwoStep): positions now, a step before, from where Euler's step goes, and foretold. The
// same image throughout: a pair whose nearest one changes within two steps is nowhere near. All outputs as long as pairs; um.
struct TwoStepSpheres {
  const std::vector<Sphere>&now, &before, &from, &predicted;
};
struct TwoStepPairs {
  std::span<Vec3> separation, normal;  // of `from`; of `predicted`
  std::span<double> gap, gap_before, gap_from, gap_predicted;
  std::span<double> turn;              // how much shorter `from` is along the normal
};
void separations(const Cell&, const TwoStepSpheres&, std::span<const neighbours::IndexPair> pairs, const TwoStepPairs&);

// What becomes of pairs whose spheres move: velocity, four numbers a particle, the last one unused, um/ms; dt, ms.
// gap: of separations of which these are the ends, along: how far they move apart along the normals; um.
void moved_gaps(const double* velocity, double dt, const std::vector<Sphere>&, std::span<const neighbours::IndexPair> pairs, std::span<const Vec3> separation,
                std::span<const Vec3> normal, std::span<double> gap, std::span<double> along);
// Where the separation is (gap_begin + both radii) along the normal.
void moved_gaps(const double* velocity, double dt, const std::vector<Sphere>&, std::span<const neighbours::IndexPair> pairs, std::span<const double> gap_begin,
                std::span<const Vec3> normal, std::span<double> gap, std::span<double> along);
// The least that such a gap can be: turning only widens it.
void least_gaps(const double* velocity, double dt, std::span<const neighbours::IndexPair> pairs, std::span<const double> gap_begin,
                std::span<const Vec3> normal, std::span<double> least);

}  // namespace pigment::assembly
