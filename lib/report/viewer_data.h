#pragma once
// A run's particles packed for the page's 3-D viewer. lib/report/page/layer_data.js unpacks them:
// zlib stream, as base64, of (little endian) id float64[n]; radius float32[n], um; speed over the run float32[n], um/s, where
// the run covers time; species uint8[n]; then for each frame: places uint16[3][n], less those of the frame before; velocity
// binary16[3][n], um/s, where known. uint16 and binary16 arrays stand as all low bytes, then all high bytes. A place p is
// width (p + 1/2)/65536 along x and y (wrapped into the cell), z_low + (p + 1/2) z_step along z.
#include <string>
#include <vector>

#include "report/sections.h"

namespace pigment::report {

struct ViewerLayer {
  std::string meta;      // JSON
  std::string packed;    // base64
  std::size_t shown = 0, frames = 0;  // frames packed, frames of the file
  double rounding = 0;   // um: positions are off by half of this at most, along each axis
};

// most_frames: at least 1; of more, that many are taken evenly in time.
ViewerLayer pack_layer(const RunView&, std::size_t most_frames);

}  // namespace pigment::report
