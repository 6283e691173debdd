#pragma once
// A species of particles: density, surface potential and size law, as the scene's `particles` list writes it.
#include <filesystem>
#include <string>
#include <vector>

#include "config/node.h"

namespace pigment {

// Distribution of diameter by weight (equal density within a species: by volume).
struct SizeLaw {
  enum class Kind { Lognormal, Normal, Monodisperse, Table };
  Kind kind = Kind::Monodisperse;
  double mean = 0, standard_deviation = 0;  // um, of the uncut law by weight (normal; lognormal)
  double median = 0, geometric_standard_deviation = 0;  // lognormal, resolved from either way of writing it
  double diameter = 0;                      // monodisperse
  double min = 0, max = 0;                  // cut-offs
  std::filesystem::path file;               // table: "diameter [um],finer [wt%]"
};

struct Species {
  std::string name;
  double parts = 100;                 // dry parts by weight
  double density = 2.7e-3;            // engine units (2700 kg/m3)
  double surface_potential = -25;     // mV
  SizeLaw size;
};

// Reads the list; parts are required (error otherwise) with more than one species. Names must differ.
std::vector<Species> read_species(config::Node root);

}  // namespace pigment
