#pragma once
#include <string>

#include "base/error.h"

namespace pigment::packing {

// A recipe that cannot be packed, and the key of the scene that asks too much.
struct Impossible : InputError {
  Impossible(const std::string& block_name, const std::string& key_name, const std::string& why)
      : InputError(block_name + "." + key_name + ": " + why), block(block_name), key(key_name), reason(why) {}
  std::string block, key, reason;
};

}  // namespace pigment::packing
