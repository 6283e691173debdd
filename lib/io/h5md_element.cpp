#include "io/h5md_element.h"

#include <fmt/format.h>

#include "io/file_units.h"

namespace pigment::io {

std::optional<Element> find_element(const h5::InputFile& file, const std::string& path) {
  if (!file.has(path)) return std::nullopt;
  Element element;
  element.has_frames = file.is_group(path);
  element.path = element.has_frames ? path + "/value" : path;
  if (!file.is_dataset(element.path)) file.fail(element.path, "is missing");
  element.shape = file.shape(element.path);
  return element;
}

std::optional<std::vector<double>> read_schedule(const h5::InputFile& file, const std::string& path,
                                                 std::optional<Dimension> dimension, std::size_t frames) {
  if (!file.is_dataset(path)) return std::nullopt;
  std::vector<double> values;
  if (dimension) {
    values = read_quantity(file, path, *dimension);
  } else {
    const auto whole = file.integers(path);
    values.assign(whole.begin(), whole.end());
  }
  const h5::Extent shape = file.shape(path);
  if (shape.empty()) {
    const auto offset = file.number_attribute(path, "offset");
    const double unit = dimension ? file_to_engine(file, path, *dimension).factor : 1;
    const double first = offset && offset->size() == 1 ? offset->front() * unit : 0,
                 interval = values.front();
    values.resize(frames);
    for (std::size_t f = 0; f < frames; ++f) values[f] = first + interval * static_cast<double>(f);
  }
  if (values.size() != frames)
    file.fail(path, fmt::format("its shape is {}, expected [{}], one number a frame", h5::to_string(shape),
                                frames));
  for (std::size_t f = 1; f < frames; ++f)
    if (!(values[f] >= values[f - 1]))
      file.fail(path, fmt::format("falls from frame {} to frame {}", f - 1, f));
  return values;
}

}  // namespace pigment::io
