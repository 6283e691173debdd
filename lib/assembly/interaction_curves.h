#pragma once
// What a scene's interactions are worth: a sphere facing another sphere, the wall or the free surface, at given gaps.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "assembly/interactions.h"

namespace pigment::assembly {

enum class Partner { Sphere, Wall, Surface };

// A sphere (a) and what it faces (b).
struct Facing {
  Partner partner = Partner::Sphere;
  double radius_a = 0, radius_b = 0;        // um; radius_b of spheres only
  double potential_a = 0, potential_b = 0;  // mV; potential_b of spheres only, the wall's is the scene's
};

// Times the viscosity. Two spheres: the scalars of the pair term, a standing for i and b for j (PairScalars). Wall and free
// surface: what they add to isolated drag, with z away from the boundary and into the liquid:
//   kn perpendicular, ks parallel motion, kt twist (rotation about z), kp rotation about an axis in the plane, and
//   ksp the force on the liquid along x of a sphere that turns at unit rate about y (and the torque about y of one that
//   moves along x).
struct ResistanceScalars {
  double kn = 0, kt = 0, ks = 0, kp = 0, ksp = 0;
};

enum class Reach { Tapered, Untapered };

// Laws are taken as they are, not switched off towards their cutoff. What the scene does not have is zero: lubrication
// with model drag, the wall with `substrate: none`, its forces where the substrate is not colloidal. The free surface
// always resists; one that the scene describes does so from its roughness on, with the term frozen below.
class InteractionEvaluator {
 public:
  InteractionEvaluator(const Interactions&, const Liquid&, Reach = Reach::Tapered);

  ResistanceScalars resistance(const Facing&, double gap) const;
  // Of one law by its name: nothing where the scene does not have it.
  forces::PairTerm colloidal(const std::string& law, const Facing&, double gap) const;
  forces::PairTerm total(const Facing&, double gap) const;

 private:
  forces::PairTerm evaluate(const forces::PreparedPairLaw&, const Facing&, double gap) const;
  bool acts_on(const Facing&) const;

  Interactions interactions_;
  double viscosity_;
  std::map<std::string, std::unique_ptr<forces::PreparedPairLaw>> laws_;
};

// Curves over one set of gaps: [facing][gap].
struct InteractionCurves {
  std::vector<std::vector<ResistanceScalars>> resistance;
  std::map<std::string, std::vector<std::vector<forces::PairTerm>>> colloidal;  // by law, and "total" where there is one
};
InteractionCurves interaction_curves(const InteractionEvaluator&, const std::vector<std::string>& laws,
                                     const std::vector<Facing>&, const std::vector<double>& gaps);

// From 0.01 nm to 10 um, 100 a decade.
std::vector<double> curve_gaps();

}  // namespace pigment::assembly
