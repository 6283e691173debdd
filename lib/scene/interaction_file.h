#pragma once
// What pigment-interactions writes: curves of forces and resistances against gap, as docs/files.md lists them.
#include "assembly/interaction_curves.h"
#include "io/result_file.h"
#include "scene/scene.h"

namespace pigment::scene {

// Without provenance.
io::ResultFile interaction_file_of(const Scene&, const assembly::InteractionEvaluator&);

}  // namespace pigment::scene
