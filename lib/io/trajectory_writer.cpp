#include "io/trajectory_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "io/checkpoint_file.h"
#include "io/frame_journal.h"
#include "io/particle_layout.h"
#include "io/sibling.h"

namespace pigment::io {
namespace {

// What tells one run's journal from another's.
std::string owner_of(const Layer& layer, const std::vector<std::string>& species_names,
                     const std::vector<ObservableInfo>& observables, const Provenance& provenance) {
  std::string text = fmt::format("{} particles", layer.particles.size());
  const auto add = [&](const void* bytes, std::size_t count) {
    text.append(static_cast<const char*>(bytes), count);
  };
  const Particles& p = layer.particles;
  add(p.radius.data(), p.radius.size() * sizeof p.radius[0]);
  add(p.mass.data(), p.mass.size() * sizeof p.mass[0]);
  add(p.species.data(), p.species.size() * sizeof p.species[0]);
  add(p.id.data(), p.id.size() * sizeof p.id[0]);
  for (const auto& position : layer.position) add(position.data(), 3 * sizeof(double));
  for (const auto& name : species_names) text += "\nspecies " + name;
  for (const auto& o : observables)
    text += fmt::format("\nobservable {} {}", o.name, static_cast<int>(o.dimension));
  text += "\n" + provenance.tool + "\n" + provenance.scene;
  for (const auto& [role, hash] : provenance.inputs) text += "\n" + role + " " + hash;
  return sha256_of_text(text);
}

}  // namespace

struct TrajectoryWriter::Data {
  std::filesystem::path output;
  Particles particles;
  std::shared_ptr<const HeightField> substrate;
  std::vector<std::string> species_names;
  std::vector<ObservableInfo> observables;
  Provenance provenance;
  FrameJournal journal;

  void write(const std::filesystem::path& name, const std::map<std::string, std::string>& attributes) const;
};

void TrajectoryWriter::Data::write(const std::filesystem::path& name,
                                   const std::map<std::string, std::string>& attributes) const {
  ParticleContent content;
  content.kind = "trajectory";
  content.attributes = attributes;
  content.particles = &particles;
  content.substrate = substrate;
  content.species_names = species_names;
  content.velocities = true;
  content.observables = observables;
  content.frame_count = journal.frame_count();
  content.frame = [this](std::size_t i, Frame& frame, std::vector<double>& values) {
    journal.read(i, frame, values);
  };
  content.provenance = provenance;
  write_particle_content(name, content);
}

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& output, Layer first,
                                   std::vector<std::string> species_names,
                                   std::vector<ObservableInfo> observables, Provenance provenance,
                                   std::size_t keep_frames) {
  const std::string owner = owner_of(first, species_names, observables, provenance);
  const std::size_t particles = first.particles.size(), columns = observables.size();
  data_ = std::unique_ptr<Data>(
      new Data{output, std::move(first.particles), first.substrate, std::move(species_names), std::move(observables),
               std::move(provenance),
               FrameJournal(sibling(output, ".frames.part"), owner, particles, columns, keep_frames)});
}

TrajectoryWriter::~TrajectoryWriter() = default;

void TrajectoryWriter::append(const Frame& frame, const std::vector<double>& observables) {
  const Data& d = *data_;
  const auto broken = [&](const std::string& what) {
    throw NumericsError(fmt::format("step {}, time {} s: {} is not a finite number", frame.step,
                                    to_si(Dimension::Time, frame.time), what));
  };
  const std::size_t count = d.particles.size();
  const auto fits = [&](const Vec3Array& vectors) { return vectors.empty() || vectors.size() == count; };
  if (frame.position.size() != count || !fits(frame.velocity) || !fits(frame.angular_velocity) ||
      observables.size() != d.observables.size())
    throw std::logic_error("a frame with other particles or observables than the trajectory's");
  // Velocities are stored in 32 bits, where more than this would be infinite.
  const auto in_range = [](const Vec3& v, Dimension dimension) {
    return v.allFinite() && to_si(dimension, v.cwiseAbs().maxCoeff()) < std::numeric_limits<float>::max();
  };
  for (std::size_t i = 0; i < count; ++i) {
    const auto id = d.particles.id[i];
    if (!frame.position[i].allFinite()) broken(fmt::format("the position of the particle with id {}", id));
    if (!frame.velocity.empty() && !in_range(frame.velocity[i], Dimension::Velocity))
      broken(fmt::format("the velocity of the particle with id {}", id));
    if (!frame.angular_velocity.empty() && !in_range(frame.angular_velocity[i], Dimension::AngularVelocity))
      broken(fmt::format("the angular velocity of the particle with id {}", id));
  }
  for (std::size_t k = 0; k < observables.size(); ++k)
    if (!std::isfinite(observables[k])) broken("the observable " + d.observables[k].name);
  for (const double edge : {frame.time, frame.cell.width_x, frame.cell.width_y, frame.cell.height})
    if (!std::isfinite(edge)) broken("the time or an edge of the box");
  data_->journal.append(frame, observables);
}

std::size_t TrajectoryWriter::frame_count() const { return data_->journal.frame_count(); }

void TrajectoryWriter::finish(const std::string& outcome) {
  data_->write(data_->output, {{"outcome", outcome}});
  // In this order: a checkpoint without its journal could not be gone on from, a journal without checkpoint
  // does no harm.
  remove_checkpoint(data_->output);
  data_->journal.remove();
  std::error_code ignored;
  std::filesystem::remove(sibling(data_->output, ".failed.h5"), ignored);
}

void TrajectoryWriter::finish_failed(const std::string& reason) {
  data_->write(sibling(data_->output, ".failed.h5"), {{"outcome", "failed"}, {"reason", reason}});
}

}  // namespace pigment::io
