#pragma once
#include <filesystem>

#include "model/particles.h"

namespace pigment::io {

// Warns, naming the file, how many pairs of particles overlap and which do so deepest; periodic images
// included.
void warn_of_overlaps(const std::filesystem::path&, const Layer&);

}  // namespace pigment::io
