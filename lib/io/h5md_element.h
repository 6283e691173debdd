#pragma once
// An H5MD element as it is found in a file: a dataset that holds for all frames, or a group with value, step
// and time.
#include <optional>
#include <string>
#include <vector>

#include "base/units.h"
#include "io/h5.h"

namespace pigment::io {

struct Element {
  std::string path;  // the dataset with the numbers
  h5::Extent shape;
  bool has_frames = false;
};

// Nothing where the element is absent; throws FileError for a group without value.
std::optional<Element> find_element(const h5::InputFile&, const std::string& path);

// step or time of an element, one number a frame; a scalar means equal intervals from the attribute `offset`
// (H5MD 1.1). Engine units with a dimension, else whole numbers. Nothing where it is absent; throws FileError
// where it does not fit the frames or falls.
std::optional<std::vector<double>> read_schedule(const h5::InputFile&, const std::string& path,
                                                 std::optional<Dimension>, std::size_t frames);

}  // namespace pigment::io
