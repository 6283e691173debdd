#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "io/h5_detail.h"

namespace pigment::io::h5 {
namespace {

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* out) {
  static_cast<std::vector<std::string>*>(out)->emplace_back(name);
  return 0;
}
herr_t collect_attribute(hid_t, const char* name, const H5A_info_t*, void* out) {
  static_cast<std::vector<std::string>*>(out)->emplace_back(name);
  return 0;
}

Extent extent_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank <= 0) return {};
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return {dims.begin(), dims.end()};
}

// Reads text of either kind of length through `read(memory type, buffer)`; `stored` is its type in the file.
template <typename Read>
std::optional<std::vector<std::string>> read_texts(hid_t stored, hid_t space, const Read& read) {
  const std::size_t count = element_count(extent_of(space));
  std::vector<std::string> texts(count);
  if (count == 0) return texts;
  if (H5Tis_variable_str(stored) > 0) {
    const Handle memory(H5Tcopy(stored), H5Tclose);
    std::vector<char*> pointers(count, nullptr);
    if (!read(memory.id(), static_cast<void*>(pointers.data()))) return std::nullopt;
    for (std::size_t i = 0; i < count; ++i) texts[i] = pointers[i] == nullptr ? "" : pointers[i];
    H5Dvlen_reclaim(memory.id(), space, H5P_DEFAULT, pointers.data());
    return texts;
  }
  const std::size_t length = H5Tget_size(stored);
  std::string buffer(length * count, '\0');
  if (!read(stored, static_cast<void*>(buffer.data()))) return std::nullopt;
  const bool space_padded = H5Tget_strpad(stored) == H5T_STR_SPACEPAD;
  for (std::size_t i = 0; i < count; ++i) {
    texts[i] = buffer.substr(i * length, length);
    if (space_padded)
      texts[i].resize(texts[i].find_last_not_of(' ') + 1);
    else
      texts[i].resize(std::min(texts[i].find('\0'), texts[i].size()));
  }
  return texts;
}

}  // namespace

InputFile::InputFile(std::filesystem::path name) : name_(std::move(name)) {
  silence();
  std::error_code error;
  const auto status = std::filesystem::status(name_, error);
  if (!std::filesystem::exists(status))
    throw FileError(fmt::format("{}: there is no such file", name_.string()));
  if (std::filesystem::is_directory(status))
    throw FileError(fmt::format("{}: is a folder, expected an HDF5 file", name_.string()));
  const Handle access = property_list(H5P_FILE_ACCESS);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  if (!heaps_are_sound(name_))
    throw FileError(fmt::format("{}: is damaged: its text cannot be read", name_.string()));
  file_ = Handle(H5Fopen(name_.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (file_) return;
  const std::string why = reason();
  const bool recognised = H5Fis_hdf5(name_.c_str()) > 0;
  const bool locked =
      why.find("unable to lock") != std::string::npos || why.find("ermission") != std::string::npos;
  throw FileError(fmt::format("{}: {}: {}", name_.string(),
                              recognised || locked ? "cannot be opened" : "is not a whole HDF5 file", why));
}

void InputFile::fail(const std::string& path, const std::string& what) const {
  throw FileError(fmt::format("{}: {}: {}", name_.string(), path, what));
}

// What a path leads to: H5I_GROUP, H5I_DATASET, ...; H5I_BADID where there is nothing, or a soft link that
// leads nowhere. Nothing is what the absence of an optional object looks like, so damage must not look the
// same.
int InputFile::object_kind(const std::string& path) const {
  int kind = H5I_GROUP;  // the root's
  for (std::size_t end = 0; end != std::string::npos && path != "/";) {
    if (kind != H5I_GROUP) return H5I_BADID;  // nothing lies below a dataset
    end = path.find('/', end + 1);
    const std::string part = path.substr(0, end);
    const htri_t there = H5Lexists(file_.id(), part.c_str(), H5P_DEFAULT);
    if (there == 0) return H5I_BADID;
    H5L_info_t link;
    if (there < 0 || H5Lget_info(file_.id(), part.c_str(), &link, H5P_DEFAULT) < 0)
      fail(part, "cannot be looked up, the file is damaged: " + reason());
    if (link.type != H5L_TYPE_HARD && H5Oexists_by_name(file_.id(), part.c_str(), H5P_DEFAULT) <= 0)
      return H5I_BADID;
    const Handle object(H5Oopen(file_.id(), part.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object) fail(part, "cannot be opened, the file is damaged: " + reason());
    kind = H5Iget_type(object.id());
  }
  return kind;
}

bool InputFile::has(const std::string& path) const { return object_kind(path) != H5I_BADID; }
bool InputFile::is_group(const std::string& path) const { return object_kind(path) == H5I_GROUP; }
bool InputFile::is_dataset(const std::string& path) const { return object_kind(path) == H5I_DATASET; }

std::vector<std::string> InputFile::children(const std::string& path) const {
  std::vector<std::string> names;
  const Handle group(H5Gopen2(file_.id(), path.c_str(), H5P_DEFAULT), H5Gclose);
  // Not in order of name: for that HDF5 1.10 makes a table, which it frees unfilled where the file is
  // damaged.
  if (!group || H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect_name, &names) < 0)
    fail(path, "cannot be listed: " + reason());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> InputFile::attributes(const std::string& path) const {
  std::vector<std::string> names;
  const Handle object(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object ||
      H5Aiterate2(object.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect_attribute, &names) < 0)
    fail(path, "its attributes cannot be listed: " + reason());
  std::sort(names.begin(), names.end());
  return names;
}

Handle InputFile::open_dataset(const std::string& path) const {
  if (!has(path)) fail(path, "is missing");
  Handle dataset(H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset)
    fail(path, is_group(path) ? "is a group, expected a dataset" : "cannot be opened: " + reason());
  return dataset;
}

Extent InputFile::shape(const std::string& path) const {
  const Handle dataset = open_dataset(path);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  return extent_of(space.id());
}

Type InputFile::type(const std::string& path) const {
  const Handle dataset = open_dataset(path);
  const Handle stored(H5Dget_type(dataset.id()), H5Tclose);
  return type_of(stored.id());
}

bool InputFile::is_number(const std::string& path) const {
  const Type stored = type(path);
  return stored != Type::Text && stored != Type::Other;
}

template <typename T>
std::vector<T> InputFile::read(const std::string& path, std::int64_t memory_type) const {
  const Handle dataset = open_dataset(path);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose), stored(H5Dget_type(dataset.id()), H5Tclose);
  const Type type = type_of(stored.id());
  if (type == Type::Text || type == Type::Other)
    fail(path, fmt::format("holds {}, expected numbers", name(type)));
  if (H5Sget_simple_extent_type(space.id()) == H5S_NULL) fail(path, "is empty, expected numbers");
  std::vector<T> values;
  try {
    values.resize(element_count(extent_of(space.id())));
  } catch (const std::exception&) {
    fail(path, fmt::format("its shape {} is too large for memory", to_string(extent_of(space.id()))));
  }
  if (!values.empty() && H5Dread(dataset.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(path, "cannot be read, the file is damaged: " + reason());
  if (type == Type::Int64 &&
      std::find(values.begin(), values.end(), static_cast<T>(lost_integer)) != values.end())
    fail(path, "cannot be read, the file is damaged: a part of it is not found");
  return values;
}

std::vector<double> InputFile::doubles(const std::string& path) const {
  return read<double>(path, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> InputFile::integers(const std::string& path) const {
  const Type stored = type(path);
  if (stored != Type::Float64 && stored != Type::Float32) return read<std::int64_t>(path, H5T_NATIVE_INT64);
  const std::vector<double> values = doubles(path);  // whole numbers that were stored as floats
  std::vector<std::int64_t> whole(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    whole[i] = values[i] >= -9e15 && values[i] <= 9e15 ? static_cast<std::int64_t>(values[i]) : 0;
    if (static_cast<double>(whole[i]) != values[i])
      fail(path, fmt::format("entry {} is {}, expected a whole number", i, values[i]));
  }
  return whole;
}

std::vector<double> InputFile::rows(const std::string& path, std::size_t first, std::size_t count) const {
  const Handle dataset = open_dataset(path);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  const Extent shape = extent_of(space.id());
  if (shape.empty() || first + count > shape[0])
    fail(path, fmt::format("its shape is {}, rows {} to {} were asked for", to_string(shape), first,
                           first + count));
  std::vector<hsize_t> start(shape.size(), 0), extent(shape.begin(), shape.end());
  start[0] = first;
  extent[0] = count;
  const Handle memory(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose);
  std::vector<double> values;
  try {
    values.resize(element_count({extent.begin(), extent.end()}));
  } catch (const std::exception&) {
    fail(path, fmt::format("its shape {} is too large for memory", to_string(shape)));
  }
  if (values.empty()) return values;
  if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) < 0 ||
      H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT, values.data()) < 0)
    fail(path, "cannot be read, the file is damaged: " + reason());
  return values;
}

std::vector<std::string> InputFile::texts(const std::string& path) const {
  const Handle dataset = open_dataset(path);
  const Handle stored(H5Dget_type(dataset.id()), H5Tclose), space(H5Dget_space(dataset.id()), H5Sclose);
  if (H5Tget_class(stored.id()) != H5T_STRING) fail(path, "expected text");
  const auto texts = read_texts(stored.id(), space.id(), [&](hid_t memory, void* buffer) {
    return H5Dread(dataset.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer) >= 0;
  });
  if (!texts) fail(path, "cannot be read, the file is damaged: " + reason());
  return *texts;
}

Handle InputFile::open_attribute(const std::string& object, const std::string& attribute) const {
  const htri_t there = H5Aexists_by_name(file_.id(), object.c_str(), attribute.c_str(), H5P_DEFAULT);
  if (there == 0 || (there < 0 && !has(object))) return {};
  Handle handle(H5Aopen_by_name(file_.id(), object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                H5Aclose);
  if (!handle) fail(object, "attribute " + attribute + " cannot be read, the file is damaged: " + reason());
  return handle;
}

Type InputFile::attribute_type(const std::string& object, const std::string& attribute) const {
  const Handle handle = open_attribute(object, attribute);
  const Handle stored(handle ? H5Aget_type(handle.id()) : -1, H5Tclose);
  return stored ? type_of(stored.id()) : Type::Other;
}

std::optional<std::vector<std::string>> InputFile::texts_attribute(const std::string& object,
                                                                   const std::string& attribute) const {
  const Handle handle = open_attribute(object, attribute);
  if (!handle) return std::nullopt;
  const Handle stored(H5Aget_type(handle.id()), H5Tclose), space(H5Aget_space(handle.id()), H5Sclose);
  if (H5Tget_class(stored.id()) != H5T_STRING) return std::nullopt;
  auto texts = read_texts(stored.id(), space.id(), [&](hid_t memory, void* buffer) {
    return H5Aread(handle.id(), memory, buffer) >= 0;
  });
  if (!texts) fail(object, "attribute " + attribute + " cannot be read, the file is damaged: " + reason());
  return texts;
}

std::optional<std::string> InputFile::text_attribute(const std::string& object,
                                                     const std::string& attribute) const {
  const auto texts = texts_attribute(object, attribute);
  if (!texts || texts->size() != 1) return std::nullopt;
  return texts->front();
}

std::optional<std::vector<double>> InputFile::number_attribute(const std::string& object,
                                                               const std::string& attribute) const {
  const Handle handle = open_attribute(object, attribute);
  if (!handle) return std::nullopt;
  const Handle stored(H5Aget_type(handle.id()), H5Tclose), space(H5Aget_space(handle.id()), H5Sclose);
  const Type type = type_of(stored.id());
  if (type == Type::Text || type == Type::Other) return std::nullopt;
  std::vector<double> values(element_count(extent_of(space.id())));
  if (!values.empty() && H5Aread(handle.id(), H5T_NATIVE_DOUBLE, values.data()) < 0)
    fail(object, "attribute " + attribute + " cannot be read, the file is damaged: " + reason());
  return values;
}

}  // namespace pigment::io::h5
