#include "report/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace pigment::report {

void write_whole_file(const std::filesystem::path& path, const std::string& bytes) {
  // A device or pipe (/dev/stdout) is written to as it stands; only a regular file is replaced.
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  const bool in_place = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  std::filesystem::path part = path;
  if (!in_place) part += ".part";
  const auto fail = [&](const char* what) {
    const std::string reason = std::strerror(errno);
    if (!in_place) ::unlink(part.c_str());
    throw OutputError(fmt::format("{}: {}: {}", path.string(), what, reason));
  };
  if (std::filesystem::is_directory(status))
    throw OutputError(fmt::format("{}: is a folder, not a file", path.string()));
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail("cannot be written");
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int saved = errno;
      ::close(file);
      errno = saved;
      fail("cannot be written");
    }
    done += static_cast<std::size_t>(n);
  }
  if (::fsync(file) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP) {
    const int saved = errno;
    ::close(file);
    errno = saved;
    fail("cannot be written");
  }
  if (::close(file) != 0) fail("cannot be closed");
  if (!in_place && ::rename(part.c_str(), path.c_str()) != 0) fail("cannot be put in place");
}

}  // namespace pigment::report
