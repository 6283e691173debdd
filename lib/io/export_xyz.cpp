#include <fmt/format.h>

#include <algorithm>

#include "io/export.h"
#include "io/particle_file.h"
#include "io/text_file.h"

namespace pigment::io {

void export_xyz(const ParticleFile& particles, const std::filesystem::path& output) {
  const Particles& p = particles.particles();
  std::vector<std::string> species = particles.species_names();
  for (auto& name : species)
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c <= ' '; }, '_');
  const auto species_of = [&](std::size_t i) {
    const auto k = static_cast<std::size_t>(p.species[i]);
    return k < species.size() && !species[k].empty() ? species[k] : fmt::format("species_{}", k);
  };
  TextFile file(output);
  std::string text;
  for (std::size_t f = 0; f < particles.frame_count(); ++f) {
    const Frame frame = particles.frame(f);
    const bool moving = !frame.velocity.empty();
    const Cell& cell = frame.cell;
    text = fmt::format(
        "{}\nLattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"0 0 0\" pbc=\"T T F\" "
        "Properties=species:S:1:pos:R:3:Radius:R:1:id:I:1{} "
        "Time={} Step={} length_unit=um time_unit=s\n",
        p.size(), cell.width_x, cell.width_y, cell.height, moving ? ":velo:R:3" : "",
        to_si(Dimension::Time, frame.time), frame.step);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 x = cell.wrap(frame.position[i]);
      // Nine digits: a thousandth of a nanometre in a layer of a millimetre.
      fmt::format_to(std::back_inserter(text), "{} {:.9g} {:.9g} {:.9g} {:.9g} {}", species_of(i), x.x(),
                     x.y(), x.z(), p.radius[i], p.id[i]);
      if (moving) {
        const Vec3 v = frame.velocity[i] * 1e3;  // um/ms to um/s
        fmt::format_to(std::back_inserter(text), " {:.7g} {:.7g} {:.7g}", v.x(), v.y(), v.z());
      }
      text += '\n';
    }
    file.write(text);
  }
  file.commit();
}

}  // namespace pigment::io
