#include "io/text_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace pigment::io {

TextFile::TextFile(std::filesystem::path final_name) : final_(std::move(final_name)), part_(final_) {
  std::error_code ignored;
  const auto status = std::filesystem::status(final_, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw OutputError(
        fmt::format("{}: cannot be written: there is something there that is not a file", final_.string()));
  part_ += ".part";
  file_ = std::fopen(part_.c_str(), "wbe");
  if (file_ == nullptr) fail(errno);
}

TextFile::~TextFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void TextFile::fail(int error) {
  throw OutputError(fmt::format("{}: cannot be written: {}", final_.string(), std::strerror(error)));
}

void TextFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(errno);
}

void TextFile::commit() {
  if (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0) fail(errno);
  std::fclose(file_);
  file_ = nullptr;
  std::error_code error;
  std::filesystem::rename(part_, final_, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    throw OutputError(fmt::format("{}: cannot be written: {}", final_.string(), error.message()));
  }
}

}  // namespace pigment::io
