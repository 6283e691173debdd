#pragma once
// Spheres placed by hand, of density 2700 kg/m3, and the system of their first step.
#include <memory>
#include <string>
#include <vector>

#include "assembly/step_assembly.h"

namespace pigment::test {

struct Spheres {
  Particles particles;
  Vec3Array position;

  void add(double radius, const Vec3& at) {
    particles.radius.push_back(radius);
    particles.mass.push_back(2.7e-3 * Particles::sphere_volume(radius));
    particles.species.push_back(0);
    particles.id.push_back(static_cast<std::int64_t>(position.size()));
    position.push_back(at);
  }
};

// In a liquid of viscosity 1 mPa s and relative permittivity 80; surface potential -25 mV.
struct FirstStep : Spheres {
  assembly::Interactions interactions;
  Cell cell{20, 20, 20};
  assembly::Film film{20, 20, 0, 0};
  double dt = 0.01;
  assembly::Treatment treatment = assembly::Treatment::Newton;
  Vec3Array force;

  neighbours::NeighbourList list;
  std::unique_ptr<assembly::StepAssembly> step;
  solve::PairSystem system;

  FirstStep() {
    interactions.surface_potential = {-25};
    interactions.liquid.viscosity = 1;
    interactions.liquid.relative_permittivity = 80;
  }
  void colloidal(const std::string& laws) {
    auto document = config::Document::from_text("colloidal: " + laws);
    interactions.colloidal = forces::read_colloidal(document.root().block("colloidal"));
  }
  void build() {
    const Liquid liquid = liquid_at(interactions.liquid, 298.15);
    neighbours::PairRange range = assembly::pair_range(interactions, liquid);
    range.skin = 0.1;
    list = neighbours::make_neighbour_list(cell, position, particles.radius, range);
    step = std::make_unique<assembly::StepAssembly>(interactions, particles, cell, list);
    step->begin(position, film, liquid, dt, treatment, force, std::vector<double>(position.size(), 0.0));
    step->build(system);
  }
};

}  // namespace pigment::test
