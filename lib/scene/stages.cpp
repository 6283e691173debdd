#include "scene/stages.h"

#include "base/error.h"

namespace pigment::scene {

const std::vector<Stage>& stages() {
  static const std::vector<Stage> table = {
      {"scene", {}, {}},  // all of them
      {"interactions", {}, {"particles", "liquid", "hydrodynamics", "colloidal", "substrate", "free_surface"}},
      {"pack", {"layer", "particles"}, {"seed", "layer", "particles", "packing", "liquid", "substrate"}},
      {"kbrown", {"particles", "brownian"}, {"seed", "particles", "liquid", "brownian"}},
      {"dewater", {"layer", "particles", "dewatering"}, {"layer", "particles", "liquid", "dewatering"}},
      {"consolidate",
       {"particles"},
       {"seed", "particles", "liquid", "hydrodynamics", "colloidal", "brownian", "substrate", "free_surface", "gravity",
        "stepping", "output"}},
      {"solids", {}, {"particles", "liquid", "analysis"}},
      {"cluster", {}, {"analysis"}},
      {"separation", {}, {"analysis"}},
      {"mobility", {}, {"analysis"}},
  };
  return table;
}

const Stage& stage(const std::string& name) {
  std::string known;
  for (const Stage& s : stages()) {
    if (s.name == name) return s;
    known += (known.empty() ? "" : ", ") + s.name;
  }
  throw InputError("\"" + name + "\" is not a stage that reads a scene; known: " + known);
}

}  // namespace pigment::scene
