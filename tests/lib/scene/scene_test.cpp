#include "scene/scene.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "scene/example.h"
#include "scene/remarks.h"

namespace pigment::scene {
namespace {

// Every block and most keys that a scene may have.
const char* const whole = R"(
seed: 7
layer: {thickness: 25 um, solids: 65 wt%, width: 5 um}
particles:
  - species: pigment
    parts: 100
    density: 2700 kg/m3
    surface_potential: -25 mV
    size: {law: lognormal, mean: 1.5 um, standard_deviation: 10 um, min: 0.25 um, max: 2 um}
packing: {minimum_gap: 2 nm, equilibration_sweeps: 0}
liquid: {temperature: 25 degC}
hydrodynamics: {model: exact, drag: stokes, cutoff: auto, rotation: true}
colloidal:
  electrostatic: {debye_length: 5 nm}
  van_der_waals: {hamaker_constant: 1e-21 J, london_wavelength: 100 nm}
  born: {collision_diameter: 0.5 nm}
  steric: {layer_thickness: 5 nm, k1: 1e6 N/m2, k2: 1e6 N/m2}
brownian: {model: k_brown}
substrate: {colloidal: true, suction: impermeable}
free_surface: {model: spring, surface_tension: 72 mN/m, roughness: 2 nm, elongation: arc}
gravity: {acceleration: 9.81 m/s2}
dewatering:
  strategy: HLL
  duration: 0.5 s
  final_solids: 85 wt%
  reference_thickness: 25 um
  absorption: {permeability: 1e-18 m2, cake_solids: 68 vol%, capillary_pressure: 50 kPa, external_pressure: 0 kPa}
  evaporation: {high: 40 g/m2/s, low: 8 g/m2/s}
stepping: {integrator: auto, tolerance: 1e-2, until: 0.5 s, stop_when: immobile}
output: {every: 5 ms}
analysis: {slices: 30, size_classes: [0.3 um, 0.5 um, 1 um], cluster_threshold: 20 nm}
)";

std::string refusal(const std::string& text, const std::string& stage_name = "scene",
                    const std::vector<std::string>& overrides = {}) {
  config::Document d = config::Document::from_text(text, "s.yaml", overrides);
  try {
    read_scene(d, stage_name);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Scene, ReadsEveryBlock) {
  config::Document d = config::Document::from_text(whole);
  const Scene s = read_scene(d);
  EXPECT_EQ(s.seed, 7u);
  EXPECT_DOUBLE_EQ(s.layer->thickness.value(), 25);
  EXPECT_EQ(s.colloidal.size(), 4u);
  EXPECT_TRUE(s.brownian && s.substrate && s.free_surface && s.gravity && s.dewatering);
  EXPECT_DOUBLE_EQ(s.stepping.until.value(), 500);
  EXPECT_DOUBLE_EQ(s.output.every, 5);
}

TEST(Scene, AbsentBlocksAreAbsentModels) {
  config::Document d = config::Document::from_text("");
  const Scene s = read_scene(d);
  EXPECT_FALSE(s.layer || s.brownian || s.free_surface || s.gravity || s.dewatering);
  EXPECT_TRUE(s.colloidal.empty() && s.species.empty());
  EXPECT_TRUE(s.substrate);  // the one exception
  config::Document none = config::Document::from_text("substrate: none");
  EXPECT_FALSE(read_scene(none).substrate);
  EXPECT_NE(none.resolved().find("substrate: none\n"), std::string::npos);
}

TEST(Scene, ResolvedIsASceneAgain) {
  for (const std::string& text : {std::string(whole), example_scene(), std::string(), std::string("substrate: none\n"),
                                  std::string("stepping: {time_step: 0.1 ms}\nliquid: {viscosity: 2 mPa s}\n")}) {
    config::Document first = config::Document::from_text(text);
    const auto said = remarks(read_scene(first));
    config::Document second = config::Document::from_text(first.resolved());
    EXPECT_EQ(remarks(read_scene(second)), said);
    EXPECT_EQ(second.resolved(), first.resolved());
  }
}

// A stage's slice is a scene that the stage accepts, and leaves the same provenance as the whole scene does.
TEST(Scene, SlicesServeTheirStage) {
  for (const std::string& text : {std::string(whole), example_scene()}) {
    config::Document all = config::Document::from_text(text);
    read_scene(all);
    for (const Stage& s : stages()) {
      config::Document slice = config::Document::from_text(all.resolved(s.reads));
      EXPECT_NO_THROW(read_scene(slice, s.name)) << s.name;
      EXPECT_EQ(slice.resolved(s.reads), all.resolved(s.reads)) << s.name;
    }
  }
}

// A change in a block that a stage does not read leaves its slice alone.
TEST(Scene, SlicesForgetOtherBlocks) {
  config::Document a = config::Document::from_text(whole);
  config::Document b = config::Document::from_text(whole, "s", {"stepping.tolerance=0.1", "analysis.slices=20", "gravity="});
  read_scene(a);
  read_scene(b);
  for (const char* name : {"pack", "dewater", "kbrown", "interactions"})
    EXPECT_EQ(a.resolved(stage(name).reads), b.resolved(stage(name).reads)) << name;
  for (const char* name : {"consolidate", "solids"})
    EXPECT_NE(a.resolved(stage(name).reads), b.resolved(stage(name).reads)) << name;
}

TEST(Scene, ToolsDemandOnlyTheirBlocks) {
  EXPECT_EQ(refusal("", "interactions"), "accepted");
  const std::string layer = "layer: {thickness: 25 um, solids: 65 wt%, width: 5 um}\n";
  const std::string particles = "particles: [{size: {law: monodisperse, diameter: 1 um}}]\n";
  EXPECT_EQ(refusal(layer + particles, "pack"), "accepted");
  EXPECT_EQ(refusal(particles + "brownian: {}\n", "kbrown"), "accepted");
  EXPECT_EQ(refusal(layer + particles + "dewatering: {strategy: HLL, duration: 0.5 s}\n", "dewater"), "accepted");
  EXPECT_NE(refusal(layer, "pack").find("particles: missing; pigment-pack needs this block"), std::string::npos);
  EXPECT_NE(refusal(particles, "pack").find("layer: missing"), std::string::npos);
  EXPECT_NE(refusal(particles, "kbrown").find("brownian: missing"), std::string::npos);
  EXPECT_NE(refusal(layer + particles, "dewater").find("dewatering: missing"), std::string::npos);
  EXPECT_THROW(stage("bogus"), InputError);
}

TEST(Scene, ThermalNoiseRefusesWhatLacksItsStatistics) {
  const std::string thermal = "brownian: {model: fluctuation_dissipation}\n";
  for (const char* integrator : {"auto", "linearly_implicit", "explicit_euler"})
    EXPECT_EQ(refusal(thermal + "stepping: {integrator: " + integrator + "}\n"), "accepted") << integrator;
  for (const char* integrator : {"extrapolated", "newton_implicit", "explicit_midpoint"})
    EXPECT_NE(refusal(thermal + "stepping: {integrator: " + integrator + "}\n").find("s.yaml:2: stepping.integrator"), std::string::npos) << integrator;
  EXPECT_EQ(refusal("brownian: {model: fluctuation_dissipation, drift: false}\n"), "accepted");
  EXPECT_NE(refusal("brownian: {drift: false}\n").find("brownian.drift: belongs to"), std::string::npos);
}

TEST(Scene, UnknownBlocksAreFaults) {
  EXPECT_NE(refusal("particels: []").find("s.yaml:1: particels: unknown key; did you mean \"particles\"?"),
            std::string::npos);
  EXPECT_NE(refusal("colloidal: {electrostatics: {debye_length: 5 nm}}").find("did you mean \"electrostatic\"?"),
            std::string::npos);
  EXPECT_NE(refusal("substrate: nothing").find("substrate: expected a block of keys, found \"nothing\""), std::string::npos);
}

TEST(Scene, BlocksAreCheckedAgainstEachOther) {
  EXPECT_NE(refusal(whole, "scene", {"layer.width=3 um"}).find("layer.width: 3 um is under two largest diameters"),
            std::string::npos);
  EXPECT_NE(refusal(whole, "scene", {"layer.thickness=1 um"}).find("layer.thickness: 1 um is thinner"), std::string::npos);
  EXPECT_NE(refusal(whole, "scene", {"free_surface="}).find("dewatering.evaporation: the scene has no free_surface"),
            std::string::npos);
  EXPECT_EQ(refusal(whole, "scene", {"free_surface=", "dewatering.strategy=ABS"}), "accepted");
  EXPECT_NE(refusal(whole, "scene", {"dewatering.final_solids=60 wt%"}).find("dewatering.final_solids: must exceed"),
            std::string::npos);
  EXPECT_NE(refusal(whole, "scene", {"dewatering.strategy=EVA", "dewatering.evaporation.high=0 g/m2/s", "dewatering.evaporation.low=0 g/m2/s"})
                .find("s.yaml:25: dewatering.final_solids: the fluxes remove no liquid"),
            std::string::npos);
  EXPECT_NE(refusal(whole, "scene", {"free_surface.model=pressure_limited", "free_surface.max=500 nm"}).find("free_surface.max: \"500 nm\" is not a pressure"),
            std::string::npos);
  EXPECT_NE(refusal(whole, "scene", {"particles.0.size.min=1.9 m"}).find("particles.0.size.min:"), std::string::npos);
  EXPECT_NE(refusal(whole, "scene", {"particles.0.size={law: normal, mean: 9 um, standard_deviation: 0.1 um, min: 1 um, max: 2 um}"})
                .find("particles.0.size: the size law has less than a millionth"),
            std::string::npos);
}

// One slip in each block: all are reported together, in order of line.
TEST(Scene, AllErrorsTogether) {
  const std::string text =
      "layer: {thickness: 25, solids: 165 wt%, width: 5 um}\n"
      "particles:\n"
      "  - species: pigment\n"
      "    size: {law: monodisperse, diametre: 1 um}\n"
      "colloidal:\n"
      "  electrostatic: {debye_length: 5 nmm}\n"
      "free_surface: {model: sprong}\n"
      "dewatering: {strategy: HXL, duration: 0.5 s}\n"
      "stepping: {tolerance: -1}\n";
  const std::string said = refusal(text);
  std::size_t at = 0;
  for (const char* part : {"s.yaml:1: layer.thickness:", "s.yaml:1: layer.solids:", "s.yaml:4: particles.0.size.diameter: missing",
                           "s.yaml:4: particles.0.size.diametre: unknown key",
                           "s.yaml:6: colloidal.electrostatic.debye_length: \"5 nmm\" is not a length; write e.g. \"5 nm\"",
                           "s.yaml:7: free_surface.model: \"sprong\" is not one of spring, constraint, pressure_limited; did you mean \"spring\"?",
                           "s.yaml:8: dewatering.strategy: \"HXL\" is not one of HLL, LLH, ABS, EVA", "s.yaml:9: stepping.tolerance:"}) {
    const std::size_t found = said.find(part, at);
    ASSERT_NE(found, std::string::npos) << part << " in\n" << said;
    at = found;
  }
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 7) << said;
}

}  // namespace
}  // namespace pigment::scene
