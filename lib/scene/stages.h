#pragma once
// Which blocks of a scene each tool demands and reads: what --for prints, and what provenance keeps.
#include <string>
#include <vector>

namespace pigment::scene {

struct Stage {
  std::string name;                  // of the tool, without the prefix
  std::vector<std::string> demands;  // blocks that must be there
  std::vector<std::string> reads;    // every block that can change its result
};

const std::vector<Stage>& stages();
// Throws InputError, listing the known ones, for an unknown name.
const Stage& stage(const std::string& name);

}  // namespace pigment::scene
