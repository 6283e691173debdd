#pragma once
// One frame of a layer -> picture: periodic images wrapped, coloured by a quantity, with substrate, free
// surface, scale bar and colour bar.
#include <optional>
#include <string>
#include <vector>

#include "model/particles.h"
#include "report/particle_colours.h"
#include "report/render.h"

namespace pigment::report {

enum class View { Side, Top, Oblique };

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

// A connection between two particles, by index.
struct ParticleLink {
  std::size_t first = 0, second = 0;
  double separation = 0;  // um
};
// The connections as rods between the particles' middles, red where these are near to blue where they are `farthest` um
// apart; of the particles just small balls. What crosses a periodic border is drawn in two halves.
Image draw_connections(const Layer&, const std::vector<ParticleLink>&, double farthest,
                       const std::vector<char>& hidden, const PictureSettings&);

// Pictures in a grid, left to right, with a gap between them; all of one size. columns 0: chosen to suit.
Image contact_sheet(const std::vector<Image>&, int columns);

}  // namespace pigment::report
