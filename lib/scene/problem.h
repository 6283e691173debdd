#pragma once
// From a scene and a packing to what the stepper needs.
#include "io/particle_file.h"
#include "scene/scene.h"
#include "stepping/consolidate.h"

namespace pigment::scene {

// What acts in the scene; surface potentials by species.
assembly::Interactions interactions_of(const Scene&);

// The packing's box, positions and radii win over `layer`. Species are matched by name where the packing stores names, else by
// index; masses missing in the file follow from the species's density (said as a note). Throws FileError for a species that the
// scene does not have.
stepping::Problem problem_of(const Scene&, const io::ParticleFile& packing);

// Output interval and end: stepping.until, else the end of the dewatering curve of the problem. Throws InputError where
// neither is there, and where evaporation meets a scene without free surface.
stepping::RunSettings run_settings_of(const Scene&, const stepping::Problem&);

}  // namespace pigment::scene
