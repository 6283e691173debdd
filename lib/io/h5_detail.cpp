#include "io/h5_detail.h"

#include <fmt/format.h>

#include <fstream>
#include <string_view>

namespace pigment::io::h5 {
namespace {

herr_t keep_innermost(unsigned n, const H5E_error2_t* entry, void* out) {
  if (n == 0 && entry->desc != nullptr) *static_cast<std::string*>(out) = entry->desc;
  return 0;
}

}  // namespace

std::size_t element_count(const Extent& shape) {
  std::size_t count = 1;
  for (const auto edge : shape) count *= edge;
  return count;
}

std::string to_string(const Extent& shape) {
  return shape.empty() ? std::string("a scalar") : fmt::format("[{}]", fmt::join(shape, ", "));
}

const char* name(Type type) {
  switch (type) {
    case Type::Float64:
      return "64-bit float";
    case Type::Float32:
      return "float";
    case Type::Int64:
      return "64-bit integer";
    case Type::OtherInteger:
      return "integer";
    case Type::Text:
      return "text";
    case Type::Other:
      break;
  }
  return "something else than numbers or text";
}

std::string reason() {
  std::string why = "HDF5 gives no reason";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &why);
  if (why.find("unable to lock") != std::string::npos)
    why +=
        "; another program has the file open, or the file system has no locks (then set "
        "HDF5_USE_FILE_LOCKING=FALSE)";
  return why;
}

Handle text_type(std::size_t length, bool ascii) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), length);
  H5Tset_cset(type.id(), ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
  if (length != H5T_VARIABLE) H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  return type;
}

Type type_of(hid_t datatype) {
  switch (H5Tget_class(datatype)) {
    case H5T_FLOAT:
      return H5Tget_size(datatype) == 8 ? Type::Float64 : Type::Float32;
    case H5T_INTEGER:
      return H5Tget_size(datatype) == 8 && H5Tget_sign(datatype) == H5T_SGN_2 ? Type::Int64
                                                                              : Type::OtherInteger;
    case H5T_ENUM:
      return Type::OtherInteger;
    case H5T_STRING:
      return Type::Text;
    default:
      return Type::Other;
  }
}

// Text of variable length lies in "global heap collections", the one part of these files without a checksum,
// and HDF5 1.10 trusts the lengths in them: a damaged one makes it write past its buffer. So the collections
// near the beginning, where ours are, are walked through before HDF5 reads them. HDF5 file format
// specification, section III.E.
bool heaps_are_sound(const std::filesystem::path& name) {
  std::ifstream file(name, std::ios::binary);
  std::string bytes(1 << 20, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  const auto number = [&](std::size_t at, std::size_t width) {  // little-endian
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < width; ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return value;
  };
  constexpr std::string_view signature("GCOL\1\0\0\0", 8);
  constexpr std::size_t header = 16;
  for (std::size_t begin = bytes.find(signature); begin != std::string::npos;
       begin = bytes.find(signature, begin + 8)) {
    if (begin + header > bytes.size()) break;
    const std::uint64_t size = number(begin + 8, 8);
    if (size < header || size > bytes.size() - begin) return size > bytes.size() && bytes.size() == 1 << 20;
    std::size_t at = begin + header;
    const std::size_t end = begin + size;
    while (at + header <= end) {
      const std::uint64_t index = number(at, 2), length = number(at + 8, 8);
      if (index == 0) {  // what is left free, its own header included
        if (length != end - at) return false;
        at = end;
      } else {
        if (length > end - at - header) return false;
        at += header + (length + 7) / 8 * 8;
      }
    }
  }
  return true;
}

}  // namespace pigment::io::h5
