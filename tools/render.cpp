// render: pictures of a layer: one frame, a sequence, or a sheet of several times.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "analysis/clusters.h"
#include "analysis/local_solids.h"
#include "app/tool.h"
#include "base/error.h"
#include "base/log.h"
#include "base/units.h"
#include "io/particle_file.h"
#include "report/layer_picture.h"
#include "report/picture_options.h"
#include "report/run_files.h"

namespace {

using namespace pigment;
using report::ParticleColours;

struct Options {
  app::path input;
  std::string frame = "last", time, frames, view = "side", colour = "size", cut, size = "1600x1200",
              threshold = "20 nm";
  int contact_sheet = 0, columns = 0, repeat = 1, samples = 3;
  double azimuth = 32, elevation = 24;
  int cluster_size = 0;
  bool connections = false, perspective = false, sawn = false, no_surface = false, no_substrate = false, bare = false;
};

void declare(app::CommandLine& line, Options& o) {
  line.describe(
      "Draws a layer of particles: lit spheres, cut where asked, with scale and colour bars.",
      "pigment-render trajectory.h5 --time 0.2s --view oblique --cut y=2.5um --colour size -o layer.png");
  line.positional("particles", o.input, "a packing or trajectory (HDF5)");
  line.option("--frame", o.frame, "number of the frame, from 0; or last");
  line.option("--time", o.time, "the frame nearest to this time, e.g. 0.2s, in place of --frame");
  line.option("--frames", o.frames,
              "a sequence, one picture each (NAME.0000.png, ...): all, or FIRST:LAST or FIRST:LAST:STEP");
  line.option("--contact-sheet", o.contact_sheet, "this many frames, evenly in time, in one picture");
  line.option("--columns", o.columns, "columns of the contact sheet (0: chosen to suit)");
  line.option("--view", o.view, "side, top or oblique");
  line.option(
      "--colour,--color", o.colour,
      "size, species, height, velocity (at that frame), global-velocity (over the whole run), local-solids (how full "
      "each particle's own space is), cluster (by its size), cluster-identity, or membership (in a cluster or alone)");
  line.option("--cut", o.cut,
              "takes away what lies in front of a plane: y=2.5um; or keeps one side: \"y>2.5um\"; several "
              "with commas");
  line.option("--threshold", o.threshold,
              "clusters and connections: particles whose surfaces are closer than this hang together");
  line.option("--cluster-size", o.cluster_size,
              "draws only particles in clusters of this many or more: 2 leaves out those that are alone");
  line.flag("--connections", o.connections,
            "in place of the particles the connections between them, red (near) to blue (at the threshold)");
  line.option("--size", o.size, "of a picture, in pixels: WIDTHxHEIGHT");
  line.option("--repeat", o.repeat, "periodic copies side by side");
  line.option("--samples", o.samples, "rays a pixel and direction, 1 to 8: smoothness of edges");
  line.option("--azimuth", o.azimuth, "oblique: turn about the vertical, degrees");
  line.option("--elevation", o.elevation, "oblique: height of the eye, degrees, 0 to 90");
  line.flag("--perspective", o.perspective, "oblique: near things larger (no scale bar then)");
  line.flag("--sawn", o.sawn, "cut at the cell's faces in place of whole spheres");
  line.flag("--no-surface", o.no_surface, "leave out the liquid and its surface");
  line.flag("--no-substrate", o.no_substrate, "leave out the substrate");
  line.flag("--bare", o.bare, "no scale bar, colour bar and caption");
  line.output_required(true, "the picture (PNG)");
  line.has_threads();
}

// Speeds where the file has velocities, else from the frames around.
std::vector<double> speeds_at(const io::ParticleFile& file, std::size_t k) {
  const io::Frame frame = file.frame(k);
  std::vector<double> speed;
  for (const Vec3& v : frame.velocity) speed.push_back(v.norm());
  if (!speed.empty()) return speed;
  if (file.frame_count() < 2)
    throw InputError(
        fmt::format("--colour velocity: {} has no velocities and one frame only", file.path().string()));
  const io::Frame before = file.frame(k == 0 ? 0 : k - 1),
                  after = file.frame(std::min(k + 1, file.frame_count() - 1));
  const double span = after.time - before.time;
  for (std::size_t i = 0; i < after.position.size(); ++i)
    speed.push_back(span > 0 ? (after.position[i] - before.position[i]).norm() / span : 0);
  return speed;
}

std::vector<double> global_speeds(const io::ParticleFile& file) {
  const io::Frame first = file.frame(0), last = file.frame(file.frame_count() - 1);
  if (!(last.time > first.time))
    throw InputError(fmt::format("--colour global-velocity: {} covers no time", file.path().string()));
  std::vector<double> speed;
  for (std::size_t i = 0; i < last.position.size(); ++i)
    speed.push_back((last.position[i] - first.position[i]).norm() / (last.time - first.time));
  return speed;
}

double threshold_of(const Options& o) {
  return report::quantity_option("--threshold", o.threshold, Dimension::Length);
}

analysis::Snapshot snapshot_of(const io::ParticleFile& file, std::size_t k) {
  const Layer layer = file.layer(k);
  return {file.times()[k], layer.cell, layer.position};
}

// How one frame is drawn.
struct FrameLook {
  ParticleColours colours;
  std::vector<report::ParticleLink> links;  // --connections
};

bool needs_clusters(const Options& o) {
  return o.connections || o.cluster_size > 0 || o.colour == "cluster" || o.colour == "cluster-identity" ||
         o.colour == "membership";
}

ParticleColours colours_of(const io::ParticleFile& file, std::size_t k, const analysis::Clusters& clusters,
                           const Options& o) {
  if (o.colour == "size") return report::colours_by_size(file.particles());
  if (o.colour == "species") return report::colours_by_species(file.particles(), file.species_names());
  if (o.colour == "height") return report::colours_by_height(file.layer(k), file.layer(0).cell.height);
  if (o.colour == "velocity") return report::colours_by_speed("speed", speeds_at(file, k));
  if (o.colour == "global-velocity") return report::colours_by_speed("speed over the run", global_speeds(file));
  if (o.colour == "local-solids")
    return report::colours_by_local_solids(
        analysis::local_solids(snapshot_of(file, k), file.particles().radius).solids_fraction);
  if (o.colour == "cluster") return report::colours_by_cluster({clusters.size.begin(), clusters.size.end()});
  if (o.colour == "cluster-identity") return report::colours_by_cluster_identity(clusters.id, clusters.size);
  if (o.colour == "membership") return report::colours_by_membership(clusters.size);
  throw InputError(
      fmt::format("--colour: \"{}\" is none of size, species, height, velocity, global-velocity, local-solids, "
                  "cluster, cluster-identity, membership",
                  o.colour));
}

// The frames' looks, on one scale for all but velocity and local solids, whose scales are each frame's own.
std::vector<FrameLook> looks_of(const io::ParticleFile& file, const std::vector<std::size_t>& frames,
                                const Options& o) {
  const double threshold = threshold_of(o);
  std::vector<FrameLook> looks;
  for (const std::size_t k : frames) {
    analysis::Clusters clusters;
    if (needs_clusters(o))
      clusters = analysis::find_clusters(snapshot_of(file, k), file.particles().radius, file.particles().id, threshold);
    FrameLook& look = looks.emplace_back();
    look.colours = colours_of(file, k, clusters, o);
    if (o.cluster_size > 0)
      for (const std::int64_t size : clusters.size) look.colours.hidden.push_back(size < o.cluster_size);
    if (o.connections)
      for (const analysis::Connection& c : clusters.pairs)
        look.links.push_back(
            {static_cast<std::size_t>(c.first), static_cast<std::size_t>(c.second), c.separation});
  }
  if (o.colour == "cluster") {
    double high = 0;
    for (const FrameLook& look : looks) high = std::max(high, look.colours.high);
    for (FrameLook& look : looks) look.colours.high = high;
  }
  return looks;
}

void run(const app::CommandLine& line, const Options& o) {
  if (!line.common.set.empty()) throw InputError("--set: pigment-render reads no scene");
  report::PictureSettings settings;
  settings.view = report::view_option(o.view);
  std::tie(settings.width, settings.height) = report::size_option(o.size);
  settings.cuts = report::cuts_option(o.cut);
  settings.repeat = report::whole_option("--repeat", o.repeat, 1, 20);
  settings.samples = report::whole_option("--samples", o.samples, 1, 8);
  settings.azimuth = o.azimuth;
  settings.elevation = report::range_option("--elevation", o.elevation, 0, 90);
  settings.perspective = o.perspective, settings.sawn = o.sawn;
  settings.scale_bar = settings.colour_bar = !o.bare;

  const io::ParticleFile file(o.input);
  const report::Surroundings around = report::surroundings_of(file.provenance());
  if (file.particle_count() == 0) throw FileError(fmt::format("{}: holds no particles", o.input.string()));
  settings.surface = around.free_surface && !o.no_surface;
  settings.substrate = around.substrate && !o.no_substrate;
  const auto frames = report::frames_option(file.times(), o.frame, o.time, o.frames, o.contact_sheet);
  report::whole_option("--cluster-size", o.cluster_size, 0, 1'000'000'000);
  const auto looks = looks_of(file, frames, o);
  settings.framed_height = report::framed_height(file, frames);

  std::vector<report::Image> sheet;
  Progress progress("drawing");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    settings.caption =
        o.bare || file.frame_count() < 2 ? "" : "t = " + report::time_text(file.times()[frames[i]]);
    const Layer layer = file.layer(frames[i]);
    const report::Image image = o.connections
                                    ? report::draw_connections(layer, looks[i].links, threshold_of(o),
                                                               looks[i].colours.hidden, settings)
                                    : report::draw_layer(layer, looks[i].colours, settings);
    if (o.contact_sheet > 0)
      sheet.push_back(image);
    else
      report::write_png(
          o.frames.empty() ? line.common.output : report::numbered(line.common.output, frames[i]), image);
    progress.update(static_cast<double>(i + 1) / static_cast<double>(frames.size()));
  }
  if (o.contact_sheet > 0) report::write_png(line.common.output, report::contact_sheet(sheet, o.columns));
  progress.finish();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return app::run_tool(
      "render", argc, argv, [&](auto& line) { declare(line, options); },
      [&](auto& line) { run(line, options); });
}
