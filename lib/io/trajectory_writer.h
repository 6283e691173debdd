#pragma once
// A trajectory grows frame by frame into NAME.frames.part, an append-only journal that survives a kill at any
// moment; finish() turns it into NAME.h5 (H5MD) in one go, so that a broken and an unbroken run give the same
// bytes.
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/particle_file.h"

namespace pigment::io {

struct ObservableInfo {
  std::string name;
  Dimension dimension;
};

class TrajectoryWriter {
 public:
  // keep_frames: how many frames of an existing journal a resumed run keeps (the checkpoint says); 0 begins
  // anew. Throws FileError where the journal holds fewer whole frames or belongs to another run, OutputError
  // where a second run writes.
  TrajectoryWriter(const std::filesystem::path& output, Layer first, std::vector<std::string> species_names,
                   std::vector<ObservableInfo> observables, Provenance, std::size_t keep_frames = 0);
  ~TrajectoryWriter();
  // observables: one value each, in the order given above, engine units. On disk when it returns (write the
  // checkpoint after it). Throws NumericsError for a number that is not finite. Empty velocities are stored
  // as zeros.
  void append(const Frame&, const std::vector<double>& observables);
  std::size_t frame_count() const;
  // Writes OUTPUT, then removes the checkpoint, the journal and an older NAME.failed.h5.
  // outcome: "until", "immobile" or "first_critical_concentration".
  void finish(const std::string& outcome);
  // Writes NAME.failed.h5 (outcome "failed", attribute reason), nothing under the final name. Journal and
  // checkpoint stay: the same command goes on from there.
  void finish_failed(const std::string& reason);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pigment::io
