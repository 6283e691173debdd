#include "report/picture_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "report/ticks.h"

namespace pigment::report {
namespace {

template <typename Number>
std::optional<Number> number_in(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::size_t frame_number(const std::string& option, const std::string& text, std::size_t count) {
  if (text == "last") return count - 1;
  const auto number = number_in<std::size_t>(text);
  if (!number)
    throw InputError(
        fmt::format("{}: \"{}\" is not the number of a frame; write e.g. 0, 12 or last", option, text));
  if (*number >= count)
    throw InputError(fmt::format("{}: {} is beyond the last frame, {}", option, text, count - 1));
  return *number;
}

}  // namespace

double quantity_option(const std::string& option, const std::string& text, Dimension dimension) {
  const ParsedQuantity q = parse_quantity(text, dimension);
  if (!q.ok) throw InputError(fmt::format("{}: {}", option, q.error));
  return to_engine(dimension, q.si);
}

int whole_option(const std::string& option, int value, int least, int most) {
  if (value < least || value > most)
    throw InputError(fmt::format("{}: {} is not from {} to {}", option, value, least, most));
  return value;
}

double range_option(const std::string& option, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw InputError(fmt::format("{}: {} is not from {} to {}", option, value, least, most));
  return value;
}

View view_option(const std::string& text) {
  if (text == "side") return View::Side;
  if (text == "top") return View::Top;
  if (text == "oblique") return View::Oblique;
  throw InputError(fmt::format("--view: \"{}\" is none of side, top, oblique", text));
}

std::pair<int, int> size_option(const std::string& text) {
  const auto parts = split(text, 'x');
  const auto width = number_in<int>(parts[0]),
             height = parts.size() == 2 ? number_in<int>(parts[1]) : std::nullopt;
  if (!width || !height)
    throw InputError(fmt::format("--size: \"{}\" is not WIDTHxHEIGHT in pixels; write e.g. 1600x1200", text));
  return {whole_option("--size", *width, 64, 16384), whole_option("--size", *height, 64, 16384)};
}

std::vector<AxisCut> cuts_option(const std::string& text) {
  std::vector<AxisCut> cuts;
  if (trimmed(text).empty()) return cuts;
  for (const std::string& part : split(text, ',')) {
    const std::string cut = trimmed(part);
    const auto sign = cut.find_first_of("=<>");
    const std::string axis = sign == std::string::npos ? cut : trimmed(cut.substr(0, sign));
    if (sign == std::string::npos || (axis != "x" && axis != "y" && axis != "z"))
      throw InputError(fmt::format("--cut: \"{}\" is not a plane; write e.g. y=2.5um, x<1um or z>10um", cut));
    const double position = quantity_option("--cut", trimmed(cut.substr(sign + 1)), Dimension::Length);
    const auto keep = cut[sign] == '='   ? AxisCut::Keep::AwayFromViewer
                      : cut[sign] == '<' ? AxisCut::Keep::Below
                                         : AxisCut::Keep::Above;
    cuts.push_back({axis[0] - 'x', position, keep});
  }
  return cuts;
}

std::vector<std::size_t> frames_option(const std::vector<double>& times, const std::string& frame,
                                       const std::string& time, const std::string& frames,
                                       int contact_sheet) {
  const std::size_t count = times.size();
  if (int(!time.empty()) + int(!frames.empty()) + int(contact_sheet != 0) > 1)
    throw InputError("--time, --frames and --contact-sheet exclude one another");
  std::vector<std::size_t> chosen;
  if (contact_sheet != 0) {
    return evenly_in_time(times,
                          static_cast<std::size_t>(whole_option("--contact-sheet", contact_sheet, 1, 400)));
  } else if (!time.empty()) {
    const double at = quantity_option("--time", time, Dimension::Time);
    const auto nearest = std::min_element(
        times.begin(), times.end(), [&](double a, double b) { return std::abs(a - at) < std::abs(b - at); });
    chosen.push_back(static_cast<std::size_t>(nearest - times.begin()));
  } else if (!frames.empty()) {
    auto parts = frames == "all" ? std::vector<std::string>{"0", "last"} : split(frames, ':');
    if (parts.size() < 2 || parts.size() > 3)
      throw InputError(
          fmt::format("--frames: \"{}\" is neither all nor FIRST:LAST nor FIRST:LAST:STEP", frames));
    const std::size_t first = frame_number("--frames", parts[0], count),
                      last = frame_number("--frames", parts[1], count);
    const auto step = parts.size() == 3 ? number_in<std::size_t>(parts[2]) : std::optional<std::size_t>(1);
    if (!step || *step == 0)
      throw InputError(fmt::format("--frames: the step \"{}\" is not a whole number above 0", parts[2]));
    for (std::size_t k = first; k <= last; k += *step) chosen.push_back(k);
    if (chosen.empty())
      throw InputError(
          fmt::format("--frames: \"{}\" holds no frame: the first lies behind the last", frames));
  } else {
    chosen.push_back(frame_number("--frame", frame, count));
  }
  return chosen;
}

double framed_height(const io::ParticleFile& file, const std::vector<std::size_t>& frames) {
  double highest = 0;
  for (const std::size_t k : frames) {
    const io::Frame frame = file.frame(k);
    highest = std::max(highest, frame.cell.height);
    for (std::size_t i = 0; i < frame.position.size(); ++i)
      highest = std::max(highest, frame.position[i].z() + file.particles().radius[i]);
  }
  return highest;
}

std::filesystem::path numbered(const std::filesystem::path& path, std::size_t frame) {
  std::filesystem::path out = path;
  return out.replace_extension(fmt::format(".{:04}{}", frame, path.extension().string()));
}

}  // namespace pigment::report
