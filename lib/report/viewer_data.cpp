#include "report/viewer_data.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/error.h"
#include "report/base64.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

static_assert(std::endian::native == std::endian::little, "the packed layout is little endian");

template <typename Number>
void append(std::string& bytes, const std::vector<Number>& numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

void append_words(std::string& bytes, const std::vector<std::uint16_t>& words) {
  for (const std::uint16_t w : words) bytes += static_cast<char>(w & 255);
  for (const std::uint16_t w : words) bytes += static_cast<char>(w >> 8);
}

// IEEE 754 binary16, rounded to nearest; beyond its range the largest number.
std::uint16_t half_of(double value) {
  const std::uint16_t sign = std::signbit(value) ? 0x8000 : 0;
  const double size = std::min(std::abs(value), 65504.0);
  int exponent = 0;
  std::frexp(size, &exponent);                          // size in [2^(exponent-1), 2^exponent)
  const int power = std::max(exponent - 1, -14) - 10;   // of the last bit
  auto steps = static_cast<unsigned>(std::nearbyint(std::ldexp(size, -power)));
  if (steps < 1024) return sign | static_cast<std::uint16_t>(steps);  // zero or subnormal
  const unsigned biased = static_cast<unsigned>(power + 25);
  return sign | static_cast<std::uint16_t>((biased << 10) + (steps - 1024));
}

std::uint16_t word_of(double share) {  // share of the range, 0..1
  return static_cast<std::uint16_t>(std::clamp(std::floor(share * 65536), 0.0, 65535.0));
}

// um/ms; from the frames around where the file has none; empty where there is one frame only.
Vec3Array velocities_at(const io::ParticleFile& file, std::size_t k) {
  io::Frame frame = file.frame(k);
  if (!frame.velocity.empty() || file.frame_count() < 2) return std::move(frame.velocity);
  const io::Frame before = file.frame(k == 0 ? 0 : k - 1), after = file.frame(std::min(k + 1, file.frame_count() - 1));
  const double span = after.time - before.time;
  Vec3Array velocity;
  for (std::size_t i = 0; i < after.position.size(); ++i)
    velocity.push_back(span > 0 ? Vec3((after.position[i] - before.position[i]) / span) : Vec3(Vec3::Zero()));
  return velocity;
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                6) != Z_OK)
    throw std::bad_alloc();  // its only way to fail with room enough
  out.resize(size);
  return out;
}

std::string json_strings(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& t : texts) out += (out.empty() ? "" : ",") + json_string(t);
  return "[" + out + "]";
}

// Heights of a substrate that is not flat at the corners of an even mesh over the cell: mesh + 1 along x and y. null: flat.
std::string ground_of(const Layer& layer) {
  if (!layer.substrate) return "null";
  constexpr int mesh = 80;
  std::string heights;
  for (int i = 0; i <= mesh; ++i)
    for (int j = 0; j <= mesh; ++j)
      heights += fmt::format("{}{:.4g}", heights.empty() ? "" : ",", layer.substrate->height(layer.cell.width_x * i / mesh, layer.cell.width_y * j / mesh));
  return fmt::format(R"({{"mesh":{},"heights":[{}]}})", mesh, heights);
}

}  // namespace

ViewerLayer pack_layer(const RunView& view, std::size_t most_frames) {
  const io::ParticleFile& file = *view.files.particles();
  const Particles& particles = file.particles();
  const std::size_t n = file.particle_count();
  const std::vector<std::size_t> chosen = evenly_in_time(file.times(), std::max<std::size_t>(1, most_frames));
  std::vector<io::Frame> frames;
  double low = INFINITY, high = -INFINITY, top = 0;
  for (const std::size_t k : chosen) {
    frames.push_back(file.frame(k));
    top = std::max(top, frames.back().cell.height);
    for (std::size_t i = 0; i < n; ++i) {
      const double z = frames.back().position[i].z();
      low = std::min(low, z), high = std::max(high, z), top = std::max(top, z + particles.radius[i]);
    }
  }
  if (!(high > low)) high = low + 1;
  const double z_step = (high - low) / 65536;

  std::string bytes;
  append(bytes, std::vector<double>(particles.id.begin(), particles.id.end()));
  append(bytes, std::vector<float>(particles.radius.begin(), particles.radius.end()));
  const io::Frame first = file.frame(0), last = file.frame(file.frame_count() - 1);
  const bool moves = last.time > first.time;
  if (moves) {
    std::vector<float> speed;
    for (std::size_t i = 0; i < n; ++i)
      speed.push_back(static_cast<float>(1000 * (last.position[i] - first.position[i]).norm() / (last.time - first.time)));
    append(bytes, speed);
  }
  std::vector<std::uint8_t> species(n, 0);
  for (std::size_t i = 0; i < particles.species.size(); ++i) species[i] = static_cast<std::uint8_t>(particles.species[i]);
  append(bytes, species);

  std::vector<std::uint16_t> before(3 * n, 0), places(3 * n), change(3 * n);
  bool has_velocity = true;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Cell& cell = frames[f].cell;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 p = cell.wrap(frames[f].position[i]);
      places[i] = word_of(p.x() / cell.width_x);
      places[n + i] = word_of(p.y() / cell.width_y);
      places[2 * n + i] = word_of((p.z() - low) / (high - low));
    }
    for (std::size_t i = 0; i < 3 * n; ++i) change[i] = static_cast<std::uint16_t>(places[i] - before[i]);
    append_words(bytes, change);
    before = places;
    const Vec3Array velocity = velocities_at(file, chosen[f]);
    if (velocity.empty()) {
      has_velocity = false;
      continue;
    }
    for (std::size_t i = 0; i < n; ++i)
      for (int axis = 0; axis < 3; ++axis) change[static_cast<std::size_t>(axis) * n + i] = half_of(1000 * velocity[i][axis]);
    append_words(bytes, change);
  }

  std::vector<std::string> labels;
  std::string times, heights;
  for (const io::Frame& f : frames) {
    labels.push_back(file.frame_count() > 1 ? view.when(f.time) : "packing");
    times += fmt::format("{}{:.9g}", times.empty() ? "" : ",", f.time);
    heights += fmt::format("{}{:.7g}", heights.empty() ? "" : ",", f.cell.height);
  }
  double threshold = 0.02;  // um, where no cluster file says another
  if (const auto* cluster = view.files.result("cluster"))
    if (const auto found = cluster->numbers.find("threshold"); found != cluster->numbers.end())
      threshold = to_engine(Dimension::Length, found->second);
  const Surroundings around = surroundings_of(file.provenance());
  const double mean_radius =
      std::accumulate(particles.radius.begin(), particles.radius.end(), 0.0) / static_cast<double>(std::max<std::size_t>(n, 1));
  ViewerLayer out;
  const int kinds = species.empty() ? 0 : *std::max_element(species.begin(), species.end());
  std::vector<std::string> names = file.species_names();
  for (int s = static_cast<int>(names.size()); s <= kinds && kinds > 0; ++s) names.push_back(fmt::format("species {}", s));
  out.meta = fmt::format(
      R"({{"name":{},"count":{},"times":[{}],"labels":{},"heights":[{}],"width":[{:.9g},{:.9g}],"z_low":{:.9g},"z_step":{:.9g},)"
      R"("z_top":{:.7g},"mean_radius":{:.7g},"species":{},"velocity":{},"run_speed":{},"threshold":{:.7g},"substrate":{},"ground":{},"free_surface":{}}})",
      json_string(view.files.name), n, times, json_strings(labels), heights, frames.front().cell.width_x,
      frames.front().cell.width_y, low, z_step, top, mean_radius, json_strings(names), has_velocity, moves, threshold,
      around.substrate, ground_of(file.layer(0)), around.free_surface);
  out.packed = base64(compressed(bytes));
  out.shown = frames.size(), out.frames = file.frame_count();
  out.rounding = std::max({z_step, frames.front().cell.width_x / 65536, frames.front().cell.width_y / 65536});
  return out;
}

}  // namespace pigment::report
