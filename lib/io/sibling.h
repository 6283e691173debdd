#pragma once
// Names beside an output: for "run/trajectory.h5", sibling(output, ".checkpoint.h5") is
// "run/trajectory.checkpoint.h5".
#include <filesystem>

namespace pigment::io {

inline std::filesystem::path sibling(const std::filesystem::path& output, const char* ending) {
  std::filesystem::path name = output;
  if (name.extension() == ".h5") name.replace_extension();
  name += ending;
  return name;
}

}  // namespace pigment::io
