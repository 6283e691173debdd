#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "io/h5_detail.h"

namespace pigment::io::h5 {
namespace {

constexpr std::size_t chunk_bytes =
    256 * 1024;  // a checksum and a compressed unit each; a frame of 10,000 positions
constexpr unsigned deflate_level = 4;

// Large leading dimensions are cut first, so that a chunk is a whole frame or several where frames are small.
std::vector<hsize_t> chunk_shape(const Extent& shape, std::size_t element) {
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  for (auto& edge : chunk) edge = std::max<hsize_t>(edge, 1);
  const auto bytes = [&] {
    double b = static_cast<double>(element);
    for (const auto edge : chunk) b *= static_cast<double>(edge);
    return b;
  };
  for (auto& edge : chunk) {
    const double excess = bytes() / chunk_bytes;
    if (excess <= 1) break;
    edge = std::max<hsize_t>(1, static_cast<hsize_t>(static_cast<double>(edge) / excess));
  }
  return chunk;
}

hid_t stored_type(Type type) {
  switch (type) {
    case Type::Float32:
      return H5T_IEEE_F32LE;
    case Type::Int64:
      return H5T_STD_I64LE;
    default:
      return H5T_IEEE_F64LE;
  }
}

std::string parent_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

}  // namespace

OutputFile::OutputFile(std::filesystem::path final_name) : final_(std::move(final_name)), part_(final_) {
  silence();
  std::error_code ignored;
  const auto status = std::filesystem::status(final_, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw OutputError(
        fmt::format("{}: cannot be written: there is something there that is not a file", final_.string()));
  part_ += ".part";
  const Handle access = property_list(H5P_FILE_ACCESS), creation = property_list(H5P_FILE_CREATE);
  H5Pset_fclose_degree(access.id(),
                       H5F_CLOSE_STRONG);  // else one leaked handle would leave the file unfinished
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);  // object headers with checksums
  H5Pset_obj_track_times(creation.id(), false);                       // the root group
  // Opening for writing first gives the system's own words for what is wrong, and HDF5 none of the blame.
  const int descriptor = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0)
    throw OutputError(fmt::format("{}: cannot be written: {}", final_.string(), std::strerror(errno)));
  ::close(descriptor);
  file_ = Handle(H5Fcreate(part_.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
  if (!file_) throw OutputError(fmt::format("{}: cannot be written: {}", final_.string(), reason()));
}

OutputFile::~OutputFile() {
  if (!file_) return;
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void OutputFile::fail(const std::string& what) const {
  throw OutputError(fmt::format("{}: cannot write {}: {}", final_.string(), what, reason()));
}

void OutputFile::group(const std::string& path) {
  if (path.empty() || path == "/") return;
  if (H5Lexists(file_.id(), path.c_str(), H5P_DEFAULT) > 0) return;
  group(parent_of(path));
  const Handle creation = property_list(H5P_GROUP_CREATE);
  H5Pset_obj_track_times(creation.id(), false);
  const Handle made(H5Gcreate2(file_.id(), path.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Gclose);
  if (!made) fail(path);
}

Handle OutputFile::create(const std::string& path, const Extent& shape, std::int64_t type) const {
  const Handle creation = property_list(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(creation.id(), false);
  const std::size_t element = H5Tget_size(type);
  if (shape.empty()) {
    // Inside the object header, which has a checksum; a header holds 64 kB.
    if (element < 60'000) H5Pset_layout(creation.id(), H5D_COMPACT);
  } else {
    const auto chunk = chunk_shape(shape, element);
    H5Pset_chunk(creation.id(), static_cast<int>(chunk.size()), chunk.data());
    if (!plain_) {
      H5Pset_shuffle(creation.id());
      H5Pset_deflate(creation.id(), deflate_level);
    }
    H5Pset_fletcher32(creation.id());
    // A chunk that a damaged index no longer finds reads as what cannot be meant, not as zero.
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();
    if (H5Tget_class(type) == H5T_FLOAT) H5Pset_fill_value(creation.id(), H5T_NATIVE_DOUBLE, &not_a_number);
    if (H5Tget_class(type) == H5T_INTEGER) H5Pset_fill_value(creation.id(), H5T_NATIVE_INT64, &lost_integer);
  }
  const Handle space = simple_space(shape);
  Handle dataset(
      H5Dcreate2(file_.id(), path.c_str(), type, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
      H5Dclose);
  if (!dataset) fail(path);
  return dataset;
}

void OutputFile::make_parent(const std::string& path) { group(parent_of(path)); }

void OutputFile::write(const std::string& path, const Extent& shape, const double* values, Type stored) {
  make_parent(path);
  const Handle dataset = create(path, shape, stored_type(stored));
  if (element_count(shape) > 0 &&
      H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail(path);
}

void OutputFile::write(const std::string& path, const Extent& shape, const std::int64_t* values) {
  make_parent(path);
  const Handle dataset = create(path, shape, H5T_STD_I64LE);
  if (element_count(shape) > 0 &&
      H5Dwrite(dataset.id(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail(path);
}

void OutputFile::write(const std::string& path, const std::string& text) {
  make_parent(path);
  const Handle type = text_type(std::max<std::size_t>(text.size(), 1));
  const Handle dataset = create(path, {}, type.id());
  const std::string padded = text + '\0';
  if (H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0) fail(path);
}

void OutputFile::write(const std::string& path, const std::vector<std::string>& texts) {
  make_parent(path);
  std::size_t length = 1;
  for (const auto& text : texts) length = std::max(length, text.size());
  std::string padded;
  for (auto text : texts) {
    text.resize(length, '\0');
    padded += text;
  }
  const Handle type = text_type(length);
  const Handle dataset = create(path, {texts.size()}, type.id());
  if (!texts.empty() && H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0)
    fail(path);
}

OutputFile::Rows OutputFile::create_rows(const std::string& path, const Extent& shape, Type stored) {
  make_parent(path);
  Rows rows;
  rows.file_ = this;
  rows.path_ = path;
  rows.shape_ = shape;
  rows.dataset_ = create(path, shape, stored_type(stored));
  return rows;
}

void OutputFile::Rows::append(const void* values, std::int64_t memory_type, std::size_t count) {
  std::vector<hsize_t> start(shape_.size(), 0), extent(shape_.begin(), shape_.end());
  start[0] = filled_;
  extent[0] = count;
  const Handle space(H5Dget_space(dataset_.id()), H5Sclose);
  const Handle memory(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose);
  if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) < 0 ||
      H5Dwrite(dataset_.id(), memory_type, memory.id(), space.id(), H5P_DEFAULT, values) < 0)
    file_->fail(path_);
  filled_ += count;
}
void OutputFile::Rows::append(const double* values, std::size_t count) {
  append(values, H5T_NATIVE_DOUBLE, count);
}
void OutputFile::Rows::append(const std::int64_t* values, std::size_t count) {
  append(values, H5T_NATIVE_INT64, count);
}

void OutputFile::link(const std::string& existing, const std::string& path) {
  make_parent(path);
  if (H5Lcreate_hard(file_.id(), existing.c_str(), file_.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
    fail(path);
}

void OutputFile::raw_attribute(const std::string& object, const std::string& name, std::int64_t type,
                               std::int64_t space, const void* value) const {
  const Handle made(H5Acreate_by_name(file_.id(), object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                      H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose);
  if (!made || H5Awrite(made.id(), type, value) < 0) fail(object + ", attribute " + name);
}

void OutputFile::attribute(const std::string& object, const std::string& name, const std::string& text) {
  // H5MD wants units in ASCII.
  const bool ascii =
      std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  const Handle type = text_type(H5T_VARIABLE, ascii), space = simple_space({});
  const char* value = text.c_str();
  raw_attribute(object, name, type.id(), space.id(), &value);
}
void OutputFile::fixed_attribute(const std::string& object, const std::string& name,
                                 const std::string& text) {
  const Handle type = text_type(std::max<std::size_t>(text.size(), 1)), space = simple_space({});
  raw_attribute(object, name, type.id(), space.id(), text.c_str());
}
void OutputFile::fixed_attribute(const std::string& object, const std::string& name,
                                 const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const auto& text : texts) length = std::max(length, text.size());
  std::string padded;
  for (auto text : texts) {
    text.resize(length, '\0');
    padded += text;
  }
  const Handle type = text_type(length), space = simple_space({texts.size()});
  raw_attribute(object, name, type.id(), space.id(), padded.data());
}
void OutputFile::attribute(const std::string& object, const std::string& name, double value) {
  const Handle space = simple_space({});
  raw_attribute(object, name, H5T_NATIVE_DOUBLE, space.id(), &value);
}
void OutputFile::attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Handle space = simple_space({});
  raw_attribute(object, name, H5T_NATIVE_INT64, space.id(), &value);
}
void OutputFile::attribute(const std::string& object, const std::string& name,
                           const std::vector<std::int64_t>& values) {
  const Handle space = simple_space({values.size()});
  raw_attribute(object, name, H5T_NATIVE_INT64, space.id(), values.data());
}

void OutputFile::commit() {
  const bool closed = H5Fclose(file_.release()) >= 0;
  const std::string why = closed ? "" : reason();
  const auto give_up = [&](const std::string& what) {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    throw OutputError(fmt::format("{}: cannot be written: {}", final_.string(), what));
  };
  if (!closed) give_up(why);
  const int descriptor = ::open(part_.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!synced) give_up(std::strerror(error));
  std::error_code renamed;
  std::filesystem::rename(part_, final_, renamed);
  if (renamed) give_up(renamed.message());
  // The name itself: best effort, some file systems refuse to sync a folder.
  const auto folder = final_.has_parent_path() ? final_.parent_path() : std::filesystem::path(".");
  const int folder_descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_descriptor >= 0) {
    (void)::fsync(folder_descriptor);
    ::close(folder_descriptor);
  }
}

}  // namespace pigment::io::h5
