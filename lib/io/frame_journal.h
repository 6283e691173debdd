#pragma once
// NAME.frames.part: an append-only file of records, each with its length and a checksum; a record torn by a
// kill is recognised and dropped. The first record says what the journal belongs to; every other is one frame
// of fixed length. Numbers lie in it as in memory: it is read by the machine that wrote it, until the run is
// over.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/particle_file.h"

namespace pigment::io {

class FrameJournal {
 public:
  // keep_frames > 0: goes on with the journal that is there, cut to so many frames; throws FileError where it
  // holds fewer whole ones, or belongs to another run. 0: begins anew. `owner` tells runs apart.
  FrameJournal(std::filesystem::path file, const std::string& owner, std::size_t particles,
               std::size_t observables, std::size_t keep_frames);
  ~FrameJournal();
  FrameJournal(const FrameJournal&) = delete;
  FrameJournal& operator=(const FrameJournal&) = delete;

  void append(const Frame&, const std::vector<double>& observables);  // on disk when it returns
  void read(std::size_t index, Frame&, std::vector<double>& observables) const;
  std::size_t frame_count() const { return frames_; }
  void remove();

 private:
  std::string record(std::uint64_t length,
                     std::uint64_t offset) const;  // its payload; empty where it is torn
  void write(const std::string& payload);
  std::uint64_t frame_offset(std::size_t index) const;
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::size_t particles_, observables_, frames_ = 0;
  std::uint64_t first_frame_ = 0, frame_length_ = 0;
};

}  // namespace pigment::io
