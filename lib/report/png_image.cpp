#include "report/png_image.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>

#include "base/error.h"
#include "report/base64.h"
#include "report/whole_file.h"

namespace pigment::report {
namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}
void ignore_flush(png_structp) {}

// libpng reports errors by a long jump: nothing with a destructor may live in this function.
bool encode_rows(const Image& image, const png_byte* const* rows, std::string& out) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  if (!png) return false;
  png_infop header = png_create_info_struct(png);
  if (!header || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &header);
    return false;
  }
  png_set_write_fn(png, &out, append, ignore_flush);
  png_set_compression_level(png, 6);
  png_set_IHDR(png, header, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, header, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, header);
  png_write_image(png, const_cast<png_bytepp>(reinterpret_cast<const png_byte* const*>(rows)));
  png_write_end(png, header);
  png_destroy_write_struct(&png, &header);
  return true;
}

}  // namespace

Image::Image(int width_, int height_, Colour fill) : width(width_), height(height_) {
  const auto bytes = to_srgb(fill);
  rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = bytes[i % 3];
}

void Image::blend(int x, int y, Colour colour, double weight) {
  if (x < 0 || y < 0 || x >= width || y >= height || weight <= 0) return;
  const auto bytes = to_srgb(colour);
  std::uint8_t* pixel = at(x, y);
  weight = std::min(weight, 1.0);
  for (int k = 0; k < 3; ++k)
    pixel[k] = static_cast<std::uint8_t>(
        std::lround((1 - weight) * pixel[k] + weight * bytes[static_cast<std::size_t>(k)]));
}

void Image::paste(const Image& other, int left, int top) {
  for (int y = std::max(0, -top); y < other.height && top + y < height; ++y) {
    const int x0 = std::max(0, -left), x1 = std::min(other.width, width - left);
    if (x0 < x1) std::copy(other.at(x0, y), other.at(x0, y) + 3 * (x1 - x0), at(left + x0, top + y));
  }
}

std::string encode_png(const Image& image) {
  std::vector<const png_byte*> rows;
  for (int y = 0; y < image.height; ++y) rows.push_back(image.at(0, y));
  std::string out;
  if (!encode_rows(image, rows.data(), out)) throw OutputError("a picture could not be encoded as PNG");
  return out;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  write_whole_file(path, encode_png(image));
}

std::string png_data_uri(const Image& image) { return "data:image/png;base64," + base64(encode_png(image)); }

}  // namespace pigment::report
