#pragma once
// An RGB picture in memory, and its PNG form.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "report/colour.h"

namespace pigment::report {

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // rows from the top, 3 bytes a pixel

  Image() = default;
  Image(int width, int height, Colour fill = {1, 1, 1});
  std::uint8_t* at(int x, int y) {
    return &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x))];
  }
  const std::uint8_t* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
  // Mixes a colour into one pixel (in sRGB values, as thin lines and letters want it); outside the picture:
  // nothing.
  void blend(int x, int y, Colour, double weight);
  // Copies another picture to (left, top); what does not fit is cut off.
  void paste(const Image&, int left, int top);
};

// The bytes of a PNG file: no times, no names, the same for the same picture.
std::string encode_png(const Image&);
// Writes beside the final name and renames when whole; throws OutputError.
void write_png(const std::filesystem::path&, const Image&);
// "data:image/png;base64,..." for a page that stands alone.
std::string png_data_uri(const Image&);

}  // namespace pigment::report
