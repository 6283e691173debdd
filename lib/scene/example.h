#pragma once
#include <string>

namespace pigment::scene {

// A commented scene to start from: a 20 um layer that drains and dries. A valid scene.
std::string example_scene();

}  // namespace pigment::scene
