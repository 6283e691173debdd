#pragma once
// The one place that speaks to HDF5. Files written here carry no times (equal content gives equal bytes),
// checksums on every chunk and on every object header, and stand under their final name only when whole.
//
// Values are doubles or 64-bit integers in memory whatever the file stores; no units here (io/file_units.h
// has them). Errors: FileError for what is read, OutputError for what is written, each with the reason that
// HDF5 gives. Not for several threads at once.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pigment::io::h5 {

using Extent = std::vector<std::size_t>;  // {} for a scalar
std::size_t element_count(const Extent&);
std::string to_string(const Extent&);  // "[3, 5]", "a scalar"

enum class Type { Float64, Float32, Int64, OtherInteger, Text, Other };
const char* name(Type);

// An open HDF5 object, closed in the right way when it goes out of scope.
class Handle {
 public:
  using Close = int (*)(std::int64_t);
  Handle() = default;
  Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept { swap(other); }
  Handle& operator=(Handle&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Handle() { reset(); }
  void reset() {
    if (id_ >= 0 && close_ != nullptr) close_(id_);
    id_ = -1;
  }
  std::int64_t release() {
    const std::int64_t id = id_;
    id_ = -1;
    return id;
  }
  std::int64_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  void swap(Handle& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
  }
  std::int64_t id_ = -1;
  Close close_ = nullptr;
};

// A file in the making: NAME.part beside NAME, renamed to NAME by commit(), removed if that never comes.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path final_name);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // An array that is filled along its first index, bit by bit.
  class Rows {
   public:
    void append(const double* values, std::size_t rows);
    void append(const std::int64_t* values, std::size_t rows);

   private:
    friend class OutputFile;
    void append(const void* values, std::int64_t memory_type, std::size_t rows);
    const OutputFile* file_ = nullptr;
    std::string path_;
    Extent shape_;
    std::size_t filled_ = 0;
    Handle dataset_;
  };

  // Arrays from here on are not deflated: for files that are written often and soon gone.
  void keep_plain() { plain_ = true; }
  // Missing parents are made. Paths are absolute: "/solids/time".
  void group(const std::string& path);
  void write(const std::string& path, const Extent&, const double* values, Type stored = Type::Float64);
  void write(const std::string& path, const Extent&, const std::int64_t* values);
  void write(const std::string& path, const std::string& text);                // scalar
  void write(const std::string& path, const std::vector<std::string>& texts);  // [n]
  Rows create_rows(const std::string& path, const Extent&, Type stored);
  void link(const std::string& existing, const std::string& path);  // hard link

  // Attributes of an existing object. Text is stored with variable length, so that readers get a string;
  // fixed is what H5MD asks for in its own group and in `boundary`.
  void attribute(const std::string& object, const std::string& name, const std::string& text);
  void fixed_attribute(const std::string& object, const std::string& name, const std::string& text);
  void fixed_attribute(const std::string& object, const std::string& name,
                       const std::vector<std::string>& texts);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::int64_t value);
  void attribute(const std::string& object, const std::string& name, const std::vector<std::int64_t>& values);

  void commit();  // close, fsync, rename
  const std::filesystem::path& final_name() const { return final_; }

 private:
  [[noreturn]] void fail(const std::string& what) const;
  Handle create(const std::string& path, const Extent&, std::int64_t type) const;
  void make_parent(const std::string& path);
  void raw_attribute(const std::string& object, const std::string& name, std::int64_t type,
                     std::int64_t space, const void* value) const;
  std::filesystem::path final_, part_;
  Handle file_;
  bool plain_ = false;
};

class InputFile {
 public:
  explicit InputFile(std::filesystem::path);
  const std::filesystem::path& file() const { return name_; }

  bool has(const std::string& path) const;
  bool is_group(const std::string& path) const;
  bool is_dataset(const std::string& path) const;
  std::vector<std::string> children(const std::string& group) const;     // names, sorted
  std::vector<std::string> attributes(const std::string& object) const;  // names, sorted

  Extent shape(const std::string& dataset) const;
  Type type(const std::string& dataset) const;
  bool is_number(const std::string& dataset) const;
  std::vector<double> doubles(const std::string& dataset) const;
  std::vector<std::int64_t> integers(const std::string& dataset) const;
  // Rows first..first+count-1 along the first index.
  std::vector<double> rows(const std::string& dataset, std::size_t first, std::size_t count) const;
  std::vector<std::string> texts(const std::string& dataset) const;  // a scalar gives one

  Type attribute_type(const std::string& object, const std::string& name) const;
  // Nothing where the attribute is absent or of another kind.
  std::optional<std::string> text_attribute(const std::string& object, const std::string& name) const;
  std::optional<std::vector<std::string>> texts_attribute(const std::string& object,
                                                          const std::string& name) const;
  std::optional<std::vector<double>> number_attribute(const std::string& object,
                                                      const std::string& name) const;

  // "packing.h5: /particles/layer/radius: what"
  [[noreturn]] void fail(const std::string& path, const std::string& what) const;

 private:
  int object_kind(const std::string& path) const;
  Handle open_dataset(const std::string& path) const;
  Handle open_attribute(const std::string& object, const std::string& name) const;
  template <typename T>
  std::vector<T> read(const std::string& path, std::int64_t memory_type) const;
  std::filesystem::path name_;
  Handle file_;
};

}  // namespace pigment::io::h5
