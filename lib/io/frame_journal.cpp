#include "io/frame_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace pigment::io {
namespace {

// A record: magic, length of the payload, SHA-256 of the payload in hexadecimal, payload.
constexpr char magic[] = "pigment1";
constexpr std::size_t magic_length = 8, checksum_length = 64,
                      head_length = magic_length + 8 + checksum_length;

void put(std::string& out, const void* bytes, std::size_t count) {
  out.append(static_cast<const char*>(bytes), count);
}
void put_vectors(std::string& out, const Vec3Array& vectors, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 v = i < vectors.size() ? vectors[i] : Vec3(Vec3::Zero());
    put(out, v.data(), 3 * sizeof(double));
  }
}

struct Cursor {
  const char* at;
  void take(void* out, std::size_t count) {
    std::memcpy(out, at, count);
    at += count;
  }
  void take_vectors(Vec3Array& vectors, std::size_t count) {
    vectors.resize(count);
    for (auto& v : vectors) take(v.data(), 3 * sizeof(double));
  }
};

}  // namespace

FrameJournal::FrameJournal(std::filesystem::path file, const std::string& owner, std::size_t particles,
                           std::size_t observables, std::size_t keep_frames)
    : file_(std::move(file)), particles_(particles), observables_(observables) {
  first_frame_ = head_length + owner.size();
  frame_length_ = sizeof(double) * (5 + 9 * particles + observables);
  const bool there = std::filesystem::exists(file_);
  if (keep_frames > 0 && !there)
    throw FileError(fmt::format(
        "{}: is missing, the checkpoint goes on from it; --restart begins the run anew", file_.string()));
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw OutputError(fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(errno)));
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw OutputError(fmt::format("{}: another run is writing to it", file_.string()));
    if (keep_frames == 0) {
      if (::ftruncate(descriptor_, 0) != 0)
        throw OutputError(fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(errno)));
      write(owner);
    } else {
      if (record(owner.size(), 0) != owner)
        throw FileError(fmt::format("{}: belongs to another run; --restart begins anew", file_.string()));
      for (std::size_t frame = 0; frame < keep_frames; ++frame)
        if (record(frame_length_, frame_offset(frame)).empty())
          throw FileError(fmt::format(
              "{}: holds {} whole frames, the checkpoint goes on from {}; --restart begins the run anew",
              file_.string(), frame, keep_frames));
      if (::ftruncate(descriptor_, static_cast<off_t>(frame_offset(keep_frames))) != 0)
        throw OutputError(fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(errno)));
      frames_ = keep_frames;
    }
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

FrameJournal::~FrameJournal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint64_t FrameJournal::frame_offset(std::size_t index) const {
  return first_frame_ + index * (head_length + frame_length_);
}

std::string FrameJournal::record(std::uint64_t length, std::uint64_t offset) const {
  std::string bytes(head_length + length, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return {};
    done += static_cast<std::size_t>(got);
  }
  std::uint64_t stored_length = 0;
  std::memcpy(&stored_length, bytes.data() + magic_length, sizeof stored_length);
  std::string payload = bytes.substr(head_length);
  const bool whole = bytes.compare(0, magic_length, magic) == 0 && stored_length == length &&
                     bytes.compare(magic_length + 8, checksum_length, sha256_of_text(payload)) == 0;
  return whole ? payload : std::string();
}

void FrameJournal::write(const std::string& payload) {
  std::string bytes(magic, magic_length);
  const std::uint64_t length = payload.size();
  put(bytes, &length, sizeof length);
  bytes += sha256_of_text(payload) + payload;
  const off_t begin = ::lseek(descriptor_, 0, SEEK_END);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t put_now =
        ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, begin + static_cast<off_t>(done));
    if (put_now < 0 && errno == EINTR) continue;
    if (put_now <= 0) {
      const int error = errno;
      (void)!::ftruncate(descriptor_, begin);  // a frame that is not whole is none
      throw OutputError(fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(error)));
    }
    done += static_cast<std::size_t>(put_now);
  }
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    throw OutputError(fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(errno)));
}

void FrameJournal::append(const Frame& frame, const std::vector<double>& observables) {
  std::string payload;
  payload.reserve(frame_length_);
  put(payload, &frame.step, sizeof frame.step);
  for (const double number : {frame.time, frame.cell.width_x, frame.cell.width_y, frame.cell.height})
    put(payload, &number, sizeof number);
  put_vectors(payload, frame.position, particles_);
  put_vectors(payload, frame.velocity, particles_);
  put_vectors(payload, frame.angular_velocity, particles_);
  put(payload, observables.data(), observables.size() * sizeof(double));
  write(payload);
  ++frames_;
}

void FrameJournal::read(std::size_t index, Frame& frame, std::vector<double>& observables) const {
  const std::string payload = record(frame_length_, frame_offset(index));
  if (payload.empty())
    throw FileError(
        fmt::format("{}: frame {} is damaged; --restart begins the run anew", file_.string(), index));
  Cursor cursor{payload.data()};
  cursor.take(&frame.step, sizeof frame.step);
  for (double* number : {&frame.time, &frame.cell.width_x, &frame.cell.width_y, &frame.cell.height})
    cursor.take(number, sizeof *number);
  cursor.take_vectors(frame.position, particles_);
  cursor.take_vectors(frame.velocity, particles_);
  cursor.take_vectors(frame.angular_velocity, particles_);
  observables.resize(observables_);
  cursor.take(observables.data(), observables_ * sizeof(double));
}

void FrameJournal::remove() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

}  // namespace pigment::io
