#pragma once
// Reading packing.h5, trajectory.h5 and files made by hand: particle data in H5MD 1.1 layout, group
// /particles/layer.
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/result_file.h"
#include "model/particles.h"

namespace pigment::io {

struct Frame {
  std::int64_t step = 0;
  double time = 0;  // ms
  Cell cell;
  Vec3Array position;          // um, x and y unwrapped
  Vec3Array velocity;          // um/ms; empty where the file has none
  Vec3Array angular_velocity;  // 1/ms; empty where the file has none
};

// Made-by-hand files are valid: box, position ([N,3] or value [frames,N,3]) and radius are enough; edges [3]
// or [3,3], with or without frames; no unit means SI; no id means 0..N-1; no species means the first (0).
class ParticleFile {
 public:
  explicit ParticleFile(
      const std::filesystem::path&);  // throws FileError with file, path in it, found and expected
  ~ParticleFile();
  ParticleFile(ParticleFile&&) noexcept;

  std::size_t particle_count() const;
  std::size_t frame_count() const;
  const std::vector<double>& times() const;  // ms, one a frame
  const Particles& particles() const;        // mass is 0 where the file has none (see has_mass)
  bool has_mass() const;
  const std::vector<std::string>& species_names() const;  // as stored by pigment-pack; empty where unknown
  Frame frame(std::size_t) const;                         // reads one frame
  Layer layer(std::size_t frame = 0) const;
  // Scalars in time under /observables, by name ("thickness"), engine units; empty where absent.
  std::vector<std::string> observable_names() const;
  std::vector<double> observable(const std::string& name) const;
  std::vector<double> observable_time(const std::string& name) const;
  std::string outcome() const;  // attribute of /pigment; empty for a packing
  const Provenance& provenance() const;
  const std::filesystem::path& path() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// Writes a packing: one frame, plus extra datasets below /packing (statistics) from `report`.
void write_packing(const std::filesystem::path&, const Layer&, const std::vector<std::string>& species_names,
                   const std::vector<Dataset>& report, const Provenance&);

}  // namespace pigment::io
