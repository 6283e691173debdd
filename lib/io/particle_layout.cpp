#include "io/particle_layout.h"

#include "base/version.h"
#include "io/file_header.h"
#include "io/file_units.h"

namespace pigment::io {
namespace {

using h5::Type;
const std::string layer = "/particles/layer";
const std::string position_step = layer + "/position/step", position_time = layer + "/position/time";

void write_h5md(h5::OutputFile& file, const std::string& tool) {
  file.group("/h5md");
  file.attribute("/h5md", "version", std::vector<std::int64_t>{1, 1});
  file.group("/h5md/author");
  file.fixed_attribute("/h5md/author", "name", "pigment");  // no user's name: it would change the bytes
  file.group("/h5md/creator");
  file.fixed_attribute("/h5md/creator", "name", tool);
  file.fixed_attribute("/h5md/creator", "version", version);
  file.group("/h5md/modules/units");
  file.attribute("/h5md/modules/units", "version", std::vector<std::int64_t>{1, 0});
  file.attribute("/h5md/modules/units", "system", std::string("SI"));
}

void write_fixed(h5::OutputFile& file, const ParticleContent& content) {
  const Particles& p = *content.particles;
  write_quantity(file, layer + "/radius", {p.size()}, p.radius, Dimension::Length);
  if (!p.mass.empty()) write_quantity(file, layer + "/mass", {p.size()}, p.mass, Dimension::Mass);
  const std::vector<std::int64_t> species(p.species.begin(), p.species.end());
  file.write(layer + "/species", {species.size()}, species.data());
  file.write(layer + "/id", {p.id.size()}, p.id.data());
  // Names and counts: numbers without a dimension, and said so.
  write_unit(file, layer + "/species", Dimension::Number);
  write_unit(file, layer + "/id", Dimension::Number);
  if (!content.species_names.empty()) file.write(layer + "/species_names", content.species_names);
}

h5::OutputFile::Rows create_element(h5::OutputFile& file, const std::string& element, const h5::Extent& shape,
                                    Dimension dimension, Type stored = Type::Float64) {
  auto rows = file.create_rows(element + "/value", shape, stored);
  write_unit(file, element + "/value", dimension);
  if (element != layer + "/position") {
    file.link(position_step, element + "/step");
    file.link(position_time, element + "/time");
  }
  return rows;
}

void append_vectors(h5::OutputFile::Rows& rows, const Vec3Array& vectors, std::size_t count,
                    Dimension dimension, std::vector<double>& buffer) {
  buffer.assign(3 * count, 0.0);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (int k = 0; k < 3; ++k) buffer[3 * i + static_cast<std::size_t>(k)] = to_si(dimension, vectors[i][k]);
  rows.append(buffer.data(), 1);
}

}  // namespace

void write_particle_content(const std::filesystem::path& name, const ParticleContent& content) {
  h5::OutputFile file(name);
  const std::size_t frames = content.frame_count, count = content.particles->size();
  // All text first: it lies where readers look for damage (h5_input.cpp).
  write_header(file, content.kind, content.attributes, content.provenance);
  write_h5md(file, content.provenance.tool);
  auto step = file.create_rows(position_step, {frames}, Type::Int64);
  auto time = file.create_rows(position_time, {frames}, Type::Float64);
  write_unit(file, position_time, Dimension::Time);
  write_unit(file, position_step, Dimension::Number);
  auto position = create_element(file, layer + "/position", {frames, count, 3}, Dimension::Length);
  file.group(layer + "/box");
  file.attribute(layer + "/box", "dimension", std::int64_t{3});
  file.fixed_attribute(layer + "/box", "boundary", std::vector<std::string>{"periodic", "periodic", "none"});
  auto edges = create_element(file, layer + "/box/edges", {frames, 3}, Dimension::Length);
  h5::OutputFile::Rows velocity, angular_velocity;
  if (content.velocities) {
    velocity =
        create_element(file, layer + "/velocity", {frames, count, 3}, Dimension::Velocity, Type::Float32);
    angular_velocity = create_element(file, layer + "/angular_velocity", {frames, count, 3},
                                      Dimension::AngularVelocity, Type::Float32);
  }
  std::vector<h5::OutputFile::Rows> observables;
  for (const auto& observable : content.observables)
    observables.push_back(
        create_element(file, "/observables/" + observable.name, {frames}, observable.dimension));
  write_fixed(file, content);
  if (content.substrate) {
    const HeightMap& map = content.substrate->map();
    write_quantity(file, "/substrate/height", {map.count_x, map.count_y}, map.height, Dimension::Length);
    write_quantity(file, "/substrate/period", {2}, {map.period_x, map.period_y}, Dimension::Length);
  }
  write_datasets(file, content.extra);

  Frame frame;
  std::vector<double> values, buffer;
  for (std::size_t f = 0; f < frames; ++f) {
    content.frame(f, frame, values);
    const double seconds = to_si(Dimension::Time, frame.time);
    step.append(&frame.step, 1);
    time.append(&seconds, 1);
    append_vectors(position, frame.position, count, Dimension::Length, buffer);
    append_vectors(edges, {Vec3(frame.cell.width_x, frame.cell.width_y, frame.cell.height)}, 1,
                   Dimension::Length, buffer);
    if (content.velocities) {
      append_vectors(velocity, frame.velocity, count, Dimension::Velocity, buffer);
      append_vectors(angular_velocity, frame.angular_velocity, count, Dimension::AngularVelocity, buffer);
    }
    for (std::size_t k = 0; k < observables.size(); ++k) {
      const double si = to_si(content.observables[k].dimension, values[k]);
      observables[k].append(&si, 1);
    }
  }
  file.commit();
}

}  // namespace pigment::io
