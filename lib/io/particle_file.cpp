#include "io/particle_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/log.h"
#include "io/file_header.h"
#include "io/file_units.h"
#include "io/h5md_element.h"
#include "io/overlaps.h"
#include "io/particle_layout.h"

namespace pigment::io {
namespace {

const std::string layer_group = "/particles/layer";

std::string list(const std::vector<std::string>& names) {
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

struct ParticleFile::Data {
  explicit Data(const std::filesystem::path& name) : file(name), header(read_header(file)) {}

  h5::InputFile file;
  Header header;
  Particles particles;
  bool has_mass = false;
  std::vector<std::string> species_names;
  std::size_t frames = 1;
  std::vector<double> step, time;  // ms
  Element position, edges;
  bool edges_are_matrix = false, edges_have_frames = false;
  std::optional<Element> velocity, angular_velocity;
  std::shared_ptr<const HeightField> substrate;

  void find_positions();
  void find_edges();
  void find_schedule();
  std::optional<Element> find_velocity(const std::string& name);
  void read_fixed();
  void read_substrate();
  Cell cell(std::size_t frame) const;
  Vec3Array vectors(const Element&, Dimension, std::size_t frame) const;
};

void ParticleFile::Data::find_positions() {
  if (!header.kind.empty() && header.kind != "packing" && header.kind != "trajectory")
    throw FileError(fmt::format("{}: is {} {} file, expected a packing or a trajectory", file.file().string(),
                                header.kind == "export" ? "an" : "a", header.kind));
  if (!file.is_group(layer_group))
    file.fail(layer_group, fmt::format("is missing; the file has {}", list(file.children("/"))));
  const auto found = find_element(file, layer_group + "/position");
  if (!found)
    file.fail(layer_group + "/position",
              fmt::format("is missing; there is {}", list(file.children(layer_group))));
  position = *found;
  const auto& shape = position.shape;
  if (shape.size() == 3) position.has_frames = true;
  if (shape.size() == 2 && position.has_frames) position.has_frames = false;
  if (shape.size() < 2 || shape.size() > 3 || shape.back() != 3)
    file.fail(position.path,
              fmt::format("its shape is {}, expected [N, 3] or [frames, N, 3]", h5::to_string(shape)));
  frames = position.has_frames ? shape[0] : 1;
  if (frames == 0) file.fail(position.path, "holds no frame");
  if (shape[shape.size() - 2] == 0) file.fail(position.path, "holds no particle");
}

void ParticleFile::Data::find_edges() {
  const std::string path = layer_group + "/box/edges";
  const auto found = find_element(file, path);
  if (!found)
    file.fail(path, "is missing; write the box's three edges there (the periods in x and y, and the height)");
  edges = *found;
  const auto& s = edges.shape;
  // [3], [3, 3], [frames, 3], [frames, 3, 3]. [3, 3] can be a matrix or three frames: a matrix has zeros off
  // its diagonal and an edge of 0 is none.
  bool fine = !s.empty() && s.back() == 3 && s.size() <= 3;
  if (fine && s.size() == 3) {
    fine = s[1] == 3;
    edges_are_matrix = edges_have_frames = true;
  } else if (fine && s.size() == 2) {
    const auto values = read_quantity(file, edges.path, Dimension::Length);
    const bool has_zeros = s[0] == 3 && values[1] == 0 && values[2] == 0 && values[3] == 0;
    edges_are_matrix = s[0] == 3 && (has_zeros || !(edges.has_frames || frames == 3));
    edges_have_frames = !edges_are_matrix;
  }
  if (!fine || (edges_have_frames && s[0] != frames && s[0] != 1))
    file.fail(edges.path,
              fmt::format("its shape is {}, expected [3] or [3, 3], with or without {} frame{} before",
                          h5::to_string(s), frames, frames == 1 ? "" : "s"));
  if (edges_have_frames && s[0] == 1 && frames > 1) edges_have_frames = false;  // one box for all frames
  if (const auto boundary = file.texts_attribute(layer_group + "/box", "boundary"))
    if (*boundary != std::vector<std::string>{"periodic", "periodic", "none"})
      warning(fmt::format("{}: {}/box: its boundary is {}; taken as periodic, periodic, none",
                          file.file().string(), layer_group, list(*boundary)));
}

Cell ParticleFile::Data::cell(std::size_t frame) const {
  const std::vector<double> v = edges_have_frames
                                    ? read_quantity_rows(file, edges.path, Dimension::Length, frame, 1)
                                    : read_quantity(file, edges.path, Dimension::Length);
  Cell cell;
  if (edges_are_matrix) {
    for (const std::size_t k : {1, 2, 3, 5, 6, 7})
      if (v[k] != 0) file.fail(edges.path, "the box is not rectangular: an entry off the diagonal is not 0");
    cell = {v[0], v[4], v[8]};
  } else {
    cell = {v[0], v[1], v[2]};
  }
  if (!(cell.width_x > 0 && cell.width_y > 0 && cell.height > 0))
    file.fail(
        edges.path,
        fmt::format("the edges {}, {}, {} m are not all positive", to_si(Dimension::Length, cell.width_x),
                    to_si(Dimension::Length, cell.width_y), to_si(Dimension::Length, cell.height)));
  return cell;
}

void ParticleFile::Data::find_schedule() {
  const std::string element = layer_group + "/position";
  auto times = read_schedule(file, element + "/time", Dimension::Time, frames);
  const auto steps = read_schedule(file, element + "/step", std::nullopt, frames);
  if (!times) {
    if (frames > 1)
      warning(fmt::format("{}: {}/time is missing; frame k is taken to be at k seconds", file.file().string(),
                          element));
    times.emplace(frames);
    for (std::size_t f = 0; f < frames; ++f) (*times)[f] = to_engine(Dimension::Time, static_cast<double>(f));
  }
  time = *times;
  step.resize(frames);
  std::iota(step.begin(), step.end(), 0.0);
  if (steps) step = *steps;
}

std::optional<Element> ParticleFile::Data::find_velocity(const std::string& name) {
  auto found = find_element(file, layer_group + "/" + name);
  if (!found) return found;
  found->has_frames = found->shape.size() == 3;
  const auto& s = found->shape;
  const std::size_t count = particles.size();
  const bool fine = s == h5::Extent{frames, count, 3} || (frames == 1 && s == h5::Extent{count, 3});
  if (!fine)
    file.fail(found->path, fmt::format("its shape is {}, expected [{}, {}, 3] as position has",
                                       h5::to_string(s), frames, count));
  return found;
}

Vec3Array ParticleFile::Data::vectors(const Element& element, Dimension dimension, std::size_t frame) const {
  const auto values = element.has_frames ? read_quantity_rows(file, element.path, dimension, frame, 1)
                                         : read_quantity(file, element.path, dimension);
  Vec3Array vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return vectors;
}

void ParticleFile::Data::read_fixed() {
  const std::size_t count = position.shape[position.shape.size() - 2];
  const auto check_shape = [&](const std::string& path) {
    if (!file.is_dataset(path))
      file.fail(path, "is not a dataset; expected one number a particle, the same in all frames");
    const h5::Extent shape = file.shape(path);
    if (shape != h5::Extent{count})
      file.fail(path, fmt::format("its shape is {}, expected [{}], one number a particle",
                                  h5::to_string(shape), count));
  };
  const std::string radius = layer_group + "/radius", mass = layer_group + "/mass";
  if (!file.has(radius))
    file.fail(radius, fmt::format("is missing; there is {}", list(file.children(layer_group))));
  check_shape(radius);
  particles.radius = read_quantity(file, radius, Dimension::Length);
  for (std::size_t i = 0; i < count; ++i)
    if (!(particles.radius[i] > 0))
      file.fail(radius, fmt::format("entry {} is {} m, expected a positive radius", i,
                                    to_si(Dimension::Length, particles.radius[i])));
  has_mass = file.has(mass);
  if (has_mass) {
    check_shape(mass);
    particles.mass = read_quantity(file, mass, Dimension::Mass);
    for (std::size_t i = 0; i < count; ++i)
      if (!(particles.mass[i] > 0))
        file.fail(mass, fmt::format("entry {} is {} kg, expected a positive mass", i,
                                    to_si(Dimension::Mass, particles.mass[i])));
  } else {
    particles.mass.assign(count, 0.0);
  }
  particles.species.assign(count, 0);
  if (const std::string path = layer_group + "/species"; file.has(path)) {
    check_shape(path);
    const auto species = file.integers(path);
    for (std::size_t i = 0; i < count; ++i) {
      if (species[i] < 0 || species[i] > 1'000'000)
        file.fail(path, fmt::format("entry {} is {}, expected 0 for the first species, 1 for the next, ...",
                                    i, species[i]));
      particles.species[i] = static_cast<int>(species[i]);
    }
  }
  particles.id.resize(count);
  std::iota(particles.id.begin(), particles.id.end(), 0);
  if (const std::string path = layer_group + "/id"; file.has(path)) {
    check_shape(path);
    particles.id = file.integers(path);
    std::set<std::int64_t> seen;
    for (std::size_t i = 0; i < count; ++i)
      if (!seen.insert(particles.id[i]).second)
        file.fail(path,
                  fmt::format("entry {} is {}, which another particle has already", i, particles.id[i]));
  }
  if (file.is_dataset(layer_group + "/species_names"))
    species_names = file.texts(layer_group + "/species_names");
  else if (const auto names = file.texts_attribute(layer_group, "species_names"))
    species_names = *names;
}

void ParticleFile::Data::read_substrate() {
  const std::string height = "/substrate/height", period = "/substrate/period";
  if (!file.has(height)) return;
  if (!file.is_dataset(height) || file.shape(height).size() != 2 || file.shape(height)[0] * file.shape(height)[1] == 0)
    file.fail(height, "expected a dataset [points along x, points along y]");
  if (!file.is_dataset(period) || file.shape(period) != h5::Extent{2}) file.fail(period, "expected two lengths, the period along x and along y");
  HeightMap map{file.shape(height)[0], file.shape(height)[1], 0, 0, read_quantity(file, height, Dimension::Length)};
  const std::vector<double> periods = read_quantity(file, period, Dimension::Length);
  for (const double p : periods)
    if (!(p > 0)) file.fail(period, fmt::format("holds {} m, expected positive lengths", to_si(Dimension::Length, p)));
  map.period_x = periods[0];
  map.period_y = periods[1];
  substrate = std::make_shared<const HeightField>(std::move(map), cell(0));
}

ParticleFile::ParticleFile(const std::filesystem::path& name) : data_(std::make_unique<Data>(name)) {
  Data& d = *data_;
  d.find_positions();
  d.find_edges();
  d.find_schedule();
  d.read_fixed();
  d.read_substrate();
  d.velocity = d.find_velocity("velocity");
  d.angular_velocity = d.find_velocity("angular_velocity");
  const Layer first = layer(0);
  for (std::size_t i = 0; i < first.position.size(); ++i)
    if (!(first.position[i].z() > 0))
      d.file.fail(
          d.position.path,
          fmt::format("particle {} (id {}) is centred at z = {} m, expected above the substrate, z = 0", i,
                      first.particles.id[i], to_si(Dimension::Length, first.position[i].z())));
  if (d.header.kind != "trajectory") warn_of_overlaps(d.file.file(), first);
}

ParticleFile::~ParticleFile() = default;
ParticleFile::ParticleFile(ParticleFile&&) noexcept = default;

std::size_t ParticleFile::particle_count() const { return data_->particles.size(); }
std::size_t ParticleFile::frame_count() const { return data_->frames; }
const std::vector<double>& ParticleFile::times() const { return data_->time; }
const Particles& ParticleFile::particles() const { return data_->particles; }
bool ParticleFile::has_mass() const { return data_->has_mass; }
const std::vector<std::string>& ParticleFile::species_names() const { return data_->species_names; }
const Provenance& ParticleFile::provenance() const { return data_->header.provenance; }
const std::filesystem::path& ParticleFile::path() const { return data_->file.file(); }
std::string ParticleFile::outcome() const {
  const auto found = data_->header.attributes.find("outcome");
  return found == data_->header.attributes.end() ? std::string() : found->second;
}

Frame ParticleFile::frame(std::size_t index) const {
  const Data& d = *data_;
  if (index >= d.frames)
    throw FileError(fmt::format("{}: has {} frames, frame {} (counted from 0) was asked for", path().string(),
                                d.frames, index));
  Frame frame;
  frame.step = static_cast<std::int64_t>(d.step[index]);
  frame.time = d.time[index];
  frame.cell = d.cell(index);
  frame.position = d.vectors(d.position, Dimension::Length, index);
  if (d.velocity) frame.velocity = d.vectors(*d.velocity, Dimension::Velocity, index);
  if (d.angular_velocity)
    frame.angular_velocity = d.vectors(*d.angular_velocity, Dimension::AngularVelocity, index);
  return frame;
}

Layer ParticleFile::layer(std::size_t index) const {
  const Data& d = *data_;
  if (index >= d.frames)
    throw FileError(fmt::format("{}: has {} frames, frame {} (counted from 0) was asked for", path().string(),
                                d.frames, index));
  return {d.cell(index), d.particles, d.vectors(d.position, Dimension::Length, index), d.substrate};
}

std::vector<std::string> ParticleFile::observable_names() const {
  const auto& file = data_->file;
  std::vector<std::string> names;
  if (!file.is_group("/observables")) return names;
  for (const auto& name : file.children("/observables")) {
    const std::string value = "/observables/" + name + "/value";
    if (file.is_group("/observables/" + name) && file.is_dataset(value) && file.is_number(value) &&
        file.shape(value).size() == 1)
      names.push_back(name);
  }
  return names;
}

std::vector<double> ParticleFile::observable(const std::string& name) const {
  const auto& file = data_->file;
  const std::string value = "/observables/" + name + "/value";
  if (!file.is_dataset(value)) return {};
  const std::string unit = unit_of(file, value);
  const Dimension dimension = dimension_of_unit(unit);
  return read_quantity(file, value, dimension);
}

std::vector<double> ParticleFile::observable_time(const std::string& name) const {
  const auto& file = data_->file;
  const std::string value = "/observables/" + name + "/value";
  if (!file.is_dataset(value) || file.shape(value).size() != 1) return {};
  return read_schedule(file, "/observables/" + name + "/time", Dimension::Time, file.shape(value)[0])
      .value_or(std::vector<double>{});
}

void write_packing(const std::filesystem::path& name, const Layer& layer,
                   const std::vector<std::string>& species_names, const std::vector<Dataset>& report,
                   const Provenance& provenance) {
  ParticleContent content;
  content.kind = "packing";
  content.particles = &layer.particles;
  content.substrate = layer.substrate;
  content.species_names = species_names;
  content.frame_count = 1;
  content.frame = [&](std::size_t, Frame& frame, std::vector<double>&) {
    frame.cell = layer.cell;
    frame.position = layer.position;
  };
  content.extra = report;
  content.provenance = provenance;
  write_particle_content(name, content);
}

}  // namespace pigment::io
