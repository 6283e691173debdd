// The interactive 3-D view: one for the page, with all of its runs.
#include <fmt/format.h>

#include <algorithm>

#include "report/colour.h"
#include "report/sections.h"
#include "report/ticks.h"
#include "report/viewer_data.h"

namespace pigment::report {
namespace {

// Particles times frames in one page: at 12 bytes each before packing, the page stays below 50 MB.
constexpr std::size_t most_places = 2'300'000;

std::string colour_list(Colour (*colour)(std::size_t, std::size_t), std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) out += (i ? ",\"" : "\"") + to_hex(colour(i, count)) + "\"";
  return "[" + out + "]";
}

}  // namespace

void add_viewer(HtmlReport& page, const std::vector<RunView>& views, const PictureWishes& wishes) {
  std::vector<const RunView*> seen;
  std::size_t particles = 0;
  for (const RunView& v : views)
    if (const auto* file = v.files.particles(); file && file->particle_count() > 0)
      seen.push_back(&v), particles += file->particle_count();
  if (seen.empty() || wishes.viewer_frames == 0) return;
  const std::size_t frames =
      std::clamp<std::size_t>(most_places / particles, 1, static_cast<std::size_t>(wishes.viewer_frames));

  std::string metas, packed, note;
  double rounding = 0;
  for (const RunView* v : seen) {
    const ViewerLayer layer = pack_layer(*v, frames);
    metas += (metas.empty() ? "" : ",") + layer.meta;
    packed += "<script type=\"text/plain\" class=\"packed\">" + layer.packed + "</script>\n";
    rounding = std::max(rounding, layer.rounding);
    if (layer.shown < layer.frames)
      note += fmt::format("{}{} of {} frames are here. ", seen.size() > 1 ? v->files.name + ": " : "", layer.shown,
                          layer.frames);
  }
  note += fmt::format("Positions are rounded to {} nm; connections and clusters are found from them. ",
                      number_text(1000 * rounding, 1));
  note += "Drag to turn, wheel or pinch to come closer, right drag to shift; click a particle for its numbers.";
  page.viewer(
      fmt::format(R"({{"runs":[{}],"scale":{},"tints":{},"alone":"#c3c8d0"}})", metas,
                  colour_list([](std::size_t i, std::size_t n) { return sequential(double(i) / double(n - 1)); }, 65),
                  colour_list([](std::size_t i, std::size_t) { return categorical(i); }, 8)),
      packed, note);
}

}  // namespace pigment::report
