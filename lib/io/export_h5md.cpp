#include "base/version.h"
#include "io/export.h"
#include "io/file_header.h"
#include "io/particle_file.h"

namespace pigment::io {

namespace {
constexpr double nm_per_um = 1e3, ns_per_ms = 1e6, nm_per_ns = 1e-3;  // the last: of 1 um/ms
const std::string group = "/particles/layer";
}  // namespace

void export_h5md(const ParticleFile& particles, const std::filesystem::path& output) {
  const Particles& p = particles.particles();
  const std::size_t frames = particles.frame_count(), count = p.size();
  h5::OutputFile file(output);
  // A kind of its own: wrapped positions are no trajectory to go on with.
  write_header(file, "export", {}, {"pigment-export", "", {{"particles", sha256_of_file(particles.path())}}});
  file.group("/h5md");
  file.attribute("/h5md", "version", std::vector<std::int64_t>{1, 1});
  file.group("/h5md/author");
  file.fixed_attribute("/h5md/author", "name", "pigment");
  file.group("/h5md/creator");
  file.fixed_attribute("/h5md/creator", "name", "pigment-export");
  file.fixed_attribute("/h5md/creator", "version", version);

  auto step = file.create_rows(group + "/position/step", {frames}, h5::Type::Int64);
  auto time = file.create_rows(group + "/position/time", {frames}, h5::Type::Float64);
  file.attribute(group + "/position/time", "unit", std::string("ns"));
  const auto element = [&](const std::string& path, const h5::Extent& shape, const char* unit,
                           h5::Type stored) {
    auto rows = file.create_rows(path + "/value", shape, stored);
    if (unit != nullptr) file.attribute(path + "/value", "unit", std::string(unit));
    if (path != group + "/position") {
      file.link(group + "/position/step", path + "/step");
      file.link(group + "/position/time", path + "/time");
    }
    return rows;
  };
  auto position = element(group + "/position", {frames, count, 3}, "nm", h5::Type::Float64);
  file.group(group + "/box");
  file.attribute(group + "/box", "dimension", std::int64_t{3});
  file.fixed_attribute(group + "/box", "boundary", std::vector<std::string>{"periodic", "periodic", "none"});
  auto edges = element(group + "/box/edges", {frames, 3, 3}, "nm", h5::Type::Float64);
  const bool moving = !particles.frame(0).velocity.empty();
  h5::OutputFile::Rows velocity;
  if (moving) velocity = element(group + "/velocity", {frames, count, 3}, "nm ns-1", h5::Type::Float32);
  auto radius = element("/observables/radius", {frames, count}, "nm", h5::Type::Float64);
  const std::vector<std::int64_t> species(p.species.begin(), p.species.end());
  file.write(group + "/species", {count}, species.data());
  file.write(group + "/id", {count}, p.id.data());
  std::vector<double> radius_nm(count), values;
  for (std::size_t i = 0; i < count; ++i) radius_nm[i] = p.radius[i] * nm_per_um;

  const auto append = [&](h5::OutputFile::Rows& rows, const Vec3Array& vectors, double factor) {
    values.clear();
    for (const auto& v : vectors)
      for (int k = 0; k < 3; ++k) values.push_back(v[k] * factor);
    rows.append(values.data(), 1);
  };
  for (std::size_t f = 0; f < frames; ++f) {
    Frame frame = particles.frame(f);
    for (auto& x : frame.position) x = frame.cell.wrap(x);
    const double nanoseconds = frame.time * ns_per_ms;
    step.append(&frame.step, 1);
    time.append(&nanoseconds, 1);
    append(position, frame.position, nm_per_um);
    append(edges, {{frame.cell.width_x, 0, 0}, {0, frame.cell.width_y, 0}, {0, 0, frame.cell.height}},
           nm_per_um);
    if (moving) append(velocity, frame.velocity, nm_per_ns);
    radius.append(radius_nm.data(), 1);
  }
  file.commit();
}

}  // namespace pigment::io
