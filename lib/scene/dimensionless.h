#pragma once
// The dimensionless numbers (2)-(4) of [sand2010], engine units. a_char is the particle radius.
#include <memory>
#include <string>
#include <vector>

#include "forces/pair_law.h"
#include "forces/parameters.h"
#include "model/liquid.h"

namespace pigment::scene {

// (2): inertia of the liquid over its viscosity. Far below 1 the overdamped balance of forces holds. On the ranges that the
// source prints it is 1e-7..7e-5, not 1e-11..1e-7.
double particle_reynolds(double liquid_density, double radius, double velocity, double viscosity);

// (3): convection over diffusion across a length. The source's two examples (2 um, 5 um, 30 um/s, 298 K and 0.2 um, 1 um,
// 1 um/s, 353 K) give 1,228 and 0.27, not the "close to 10,000" of its text.
double peclet(double viscosity, double radius, double length, double velocity, double thermal_energy);

// (4): viscous over colloidal force, of the electrostatic and the van der Waals law together. Taken with |F|: the force
// crosses zero at the secondary minimum, where this is infinite (returned as such).
double colloidal_number(double radius, double viscosity, double velocity, double force);

// Two equal spheres of this radius and surface potential under the laws of a scene.
class EqualPair {
 public:
  EqualPair(const std::vector<forces::ColloidalLaw>&, const Liquid&, double radius, double potential);

  double force(double gap) const;   // of all laws, repulsion positive
  double energy(double gap) const;  // of all laws
  double law_force(const std::string& name, double gap) const;  // of one law; 0 where the scene lacks it
  bool empty() const { return laws_.empty(); }

  // Extremes of the energy on a logarithmic grid of gaps from 0.1 nm to the longest cutoff.
  struct Point {
    double gap = 0, energy = 0;
  };
  struct Landscape {
    Point barrier;            // the highest energy outside contact
    Point secondary_minimum;  // the lowest energy outside the barrier; energy 0 where there is none
  };
  Landscape landscape() const;
  double cutoff() const;  // the longest of the laws, um

 private:
  struct Law {
    std::string name;
    std::unique_ptr<forces::PreparedPairLaw> prepared;
  };
  std::vector<Law> laws_;
  double radius_, potential_;
};

}  // namespace pigment::scene
