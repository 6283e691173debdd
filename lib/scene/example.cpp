#include "scene/example.h"

namespace pigment::scene {

std::string example_scene() {
  return R"(# A pigment coating layer that drains into its substrate and dries. Every quantity carries its unit.
# A block that is left out is a model that is not in the scene; the substrate is there unless "substrate: none".
seed: 1

layer:
  thickness: 20 um        # wet; or coat_weight: 22 g/m2 (dry) in its place
  solids: 65 wt%          # or vol%
  width: 5 um             # periodic in x and y; scaled a little to hit the solids

particles:                # one entry a species; parts by dry weight where there are several
  - species: pigment
    density: 2700 kg/m3
    surface_potential: -25 mV
    # Diameters by weight; mean and standard deviation of the law before it is cut at min and max. Also:
    # median and geometric_standard_deviation; {law: normal, mean: 1 um, standard_deviation: 0.1 um};
    # {law: monodisperse, diameter: 1 um}; {law: table, file: sizes.csv} with columns diameter [um],finer [wt%].
    size: {law: lognormal, mean: 1.5 um, standard_deviation: 10 um, min: 0.25 um, max: 2 um}

packing: {minimum_gap: 2 nm, equilibration_sweeps: 0}

liquid: {temperature: 25 degC}    # water, unless viscosity, relative_permittivity and density say otherwise

hydrodynamics: {model: exact}     # exact | drag

colloidal:                        # one block a law; leave one out to switch it off
  electrostatic: {debye_length: 5 nm}     # or electrolyte: {valence: 1, concentration: 4 mol/m3}
  van_der_waals: {hamaker_constant: 1e-21 J, london_wavelength: 100 nm}
  born: {collision_diameter: 0.5 nm}

brownian: {model: k_brown}

free_surface: {model: spring, surface_tension: 72 mN/m, roughness: 2 nm}

dewatering:
  strategy: HLL                   # HLL | LLH | ABS | EVA, or file: profile.csv in its place
  duration: 0.5 s
  final_solids: 85 wt%            # both fluxes are scaled so that the layer reaches this at duration
  absorption: {permeability: 1e-18 m2, cake_solids: 68 vol%, capillary_pressure: 50 kPa}
  evaporation: {high: 40 g/m2/s, low: 8 g/m2/s}

stepping: {until: 0.5 s, stop_when: immobile}
output: {every: 5 ms}
analysis: {slices: 30, size_classes: [0.3 um, 0.5 um, 1 um], cluster_threshold: 20 nm}
)";
}

}  // namespace pigment::scene
