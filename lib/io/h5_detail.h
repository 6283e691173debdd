#pragma once
// Shared by h5_*.cpp only: HDF5's own header must not reach further.
#include <hdf5.h>

#include <limits>
#include <string>

#include "io/h5.h"

namespace pigment::io::h5 {

// HDF5 prints a stack of its own to stderr unless told not to.
inline void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

// The innermost reason on HDF5's error stack; with a hint where another program holds the lock.
std::string reason();

inline Handle property_list(hid_t kind) { return {H5Pcreate(kind), H5Pclose}; }
inline Handle simple_space(const Extent& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose};
}
Handle text_type(std::size_t length, bool ascii = false);  // fixed length, or H5T_VARIABLE; else UTF-8
Type type_of(hid_t datatype);

// False where the text in the file is damaged in a way that HDF5 does not survive.
bool heaps_are_sound(const std::filesystem::path&);

// What an integer reads as where its chunk is lost (floats read as not-a-number).
inline constexpr std::int64_t lost_integer = std::numeric_limits<std::int64_t>::min();

}  // namespace pigment::io::h5
