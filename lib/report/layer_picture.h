#pragma once
// One frame of a layer -> picture: periodic images wrapped, coloured by a quantity, with substrate, free
// surface, scale bar and colour bar.
#include <optional>
#include <string>
#include <vector>

#include "model/particles.h"
#include "report/render.h"
#include "report/ticks.h"

namespace pigment::report {

enum class View { Side, Top, Oblique };

// How numbers become colours: one value a particle. Categories (species) take tints of their own instead.
struct ParticleColours {
  std::string label;          // "diameter"
  std::string unit;           // "µm"
  std::vector<double> value;  // one a particle
  double low = 0, high = 1;   // ends of the scale
  bool logarithmic = false;
  std::vector<std::string> categories;  // not empty: value is an index into these

  Colour of(std::size_t particle) const;
  double position(double value) const;  // on the scale, 0..1 inside its ends
};
// Round numbers along the scale; short logarithmic scales are told by their ends as well.
Ticks scale_ticks(const ParticleColours&, int wanted);
ParticleColours colours_by_size(const Particles&);
ParticleColours colours_by_species(const Particles&, const std::vector<std::string>& names);
ParticleColours colours_by_height(const Layer&, double highest);
// speed: one a particle, um/ms (= mm/s), shown in um/s; ends of the scale are its 2nd and 98th percentile.
ParticleColours colours_by_speed(const std::string& label, const std::vector<double>& speed);
// size: particles in each particle's cluster; single particles stay pale.
ParticleColours colours_by_cluster(const std::vector<double>& size);

// One cut, parallel to an axis: keeps what lies below (or above) the position. No side: the part away from
// the viewer.
struct AxisCut {
  enum class Keep { AwayFromViewer, Below, Above };
  int axis = 0;  // 0 x, 1 y, 2 z
  double position = 0;
  Keep keep = Keep::AwayFromViewer;
};

struct PictureSettings {
  View view = View::Side;
  bool perspective = false;             // oblique only
  double azimuth = 32, elevation = 24;  // degrees, oblique only
  int width = 1200, height = 900;       // pixels
  int samples = 3;
  std::vector<AxisCut> cuts;
  int repeat = 1;     // periodic copies along x (and y, seen from the top)
  bool sawn = false;  // true: cut at the cell's faces, every image filled in; false: whole spheres
  bool substrate = true, surface = true;
  std::optional<double> framed_height;  // um: same scale for a whole sequence; absent: this frame's own
  bool scale_bar = true, colour_bar = true;
  std::string caption;    // upper left, "t = 0.12 s"
  double text_scale = 1;  // for pictures that are shown smaller than they are
};

Image draw_layer(const Layer&, const ParticleColours&, const PictureSettings&);

// Pictures in a grid, left to right, with a gap between them; all of one size. columns 0: chosen to suit.
Image contact_sheet(const std::vector<Image>&, int columns);

}  // namespace pigment::report
