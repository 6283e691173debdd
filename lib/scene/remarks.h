#pragma once
// What a scene's numbers say about it, as lines of text for a reader: dimensionless numbers, amounts, which models it needs
// and which it could drop, what it will cost.
#include <string>
#include <vector>

#include "scene/scene.h"

namespace pigment::scene {

// Says what can be said of the blocks that are there; no line ends in a newline.
std::vector<std::string> remarks(const Scene&);

}  // namespace pigment::scene
