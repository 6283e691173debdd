#pragma once
// A text file that stands under its final name only when whole.
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace pigment::io {

class TextFile {
 public:
  explicit TextFile(std::filesystem::path final_name);  // throws OutputError
  ~TextFile();                                          // removes what was not committed
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  void write(std::string_view);
  void commit();

 private:
  [[noreturn]] void fail(int error);
  std::filesystem::path final_, part_;
  std::FILE* file_ = nullptr;
};

}  // namespace pigment::io
