#include <fmt/format.h>

#include "io/export.h"
#include "io/file_units.h"
#include "io/particle_file.h"
#include "io/text_file.h"

namespace pigment::io {
namespace {

const std::string group = "/particles/layer";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

// Writes DataItems that point into the HDF5 file.
class Pointer {
 public:
  Pointer(const h5::InputFile& file, const std::string& file_name) : file_(file), name_(escaped(file_name)) {}

  // The dataset of an element: itself, or its value; empty where there is none in SI that can be pointed to.
  std::string dataset(const std::string& element, Dimension dimension) const {
    const std::string path = file_.is_group(element) ? element + "/value" : element;
    if (!file_.is_dataset(path)) return {};
    const std::string unit = unit_of(file_, path);
    return unit.empty() || unit == info(dimension).si_unit ? path : std::string();
  }
  // All of a dataset, or one frame of it where it has `frames` more than the rank of one.
  std::string item(const std::string& path, std::size_t frame, std::size_t rank) const {
    const h5::Extent shape = file_.shape(path);
    const h5::Type type = file_.type(path);
    const bool whole = shape.size() == rank;
    const bool real = type == h5::Type::Float64 || type == h5::Type::Float32;
    const std::string all = fmt::format(
        "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:{}</DataItem>",
        fmt::join(shape, " "), real ? "Float" : "Int", type == h5::Type::Float32 ? 4 : 8, name_, path);
    if (whole) return all;
    h5::Extent start(shape.size(), 0), stride(shape.size(), 1), count = shape;
    start[0] = frame;
    count[0] = 1;
    return fmt::format(
        "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{}\"><DataItem Dimensions=\"3 {}\" Format=\"XML\">{} "
        "{} {}</DataItem>{}</DataItem>",
        fmt::join(count.begin() + 1, count.end(), " "), shape.size(), fmt::join(start, " "),
        fmt::join(stride, " "), fmt::join(count, " "), all);
  }

 private:
  const h5::InputFile& file_;
  std::string name_;
};

// Numbers in the text itself. Nine digits: more than a picture shows.
std::string inline_vectors(const Vec3Array& vectors, Dimension dimension) {
  std::string text = fmt::format(
      "<DataItem Dimensions=\"{} 3\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">\n", vectors.size());
  for (const auto& v : vectors)
    fmt::format_to(std::back_inserter(text), "{:.9g} {:.9g} {:.9g}\n", to_si(dimension, v.x()),
                   to_si(dimension, v.y()), to_si(dimension, v.z()));
  return text + "</DataItem>";
}
template <typename Number>
std::string inline_numbers(const std::vector<Number>& numbers, double si, const char* type) {
  std::string text =
      fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"8\" Format=\"XML\">\n",
                  numbers.size(), type);
  for (const Number n : numbers) {
    if constexpr (std::is_floating_point_v<Number>)
      fmt::format_to(std::back_inserter(text), "{:.9g}\n", n * si);
    else
      fmt::format_to(std::back_inserter(text), "{}\n", n);
  }
  return text + "</DataItem>";
}

}  // namespace

void export_xdmf(const ParticleFile& particles, const std::filesystem::path& output) {
  const auto folder = std::filesystem::absolute(output).parent_path();
  const std::string name =
      std::filesystem::proximate(std::filesystem::absolute(particles.path()), folder).string();
  const h5::InputFile raw(particles.path());
  const Pointer pointer(raw, name);
  const Particles& p = particles.particles();
  const std::size_t count = p.size();

  const auto attribute = [](const std::string& attribute_name, const char* type, const std::string& item) {
    return fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">\n{}\n</Attribute>\n",
                       attribute_name, type, item);
  };
  // The same in every frame.
  const std::string radius = pointer.dataset(group + "/radius", Dimension::Length);
  const auto whole_numbers = [&](const std::string& path, const auto& numbers) {
    const bool there = raw.is_dataset(path) && raw.type(path) == h5::Type::Int64;
    return there ? pointer.item(path, 0, 1) : inline_numbers(numbers, 1, "Int");
  };
  const std::string fixed =
      attribute("radius", "Scalar",
                radius.empty() ? inline_numbers(p.radius, to_si(Dimension::Length, 1), "Float")
                               : pointer.item(radius, 0, 1)) +
      attribute("species", "Scalar", whole_numbers(group + "/species", p.species)) +
      attribute("id", "Scalar", whole_numbers(group + "/id", p.id));
  const std::string position = pointer.dataset(group + "/position", Dimension::Length);

  TextFile file(output);
  file.write(
      "<?xml version=\"1.0\"?>\n<!-- Open with ParaView's \"XDMF Reader\"; draw Point Gaussian or Glyph by "
      "radius. SI units. -->\n"
      "<Xdmf Version=\"2.0\">\n<Domain>\n<Grid Name=\"layer\" GridType=\"Collection\" "
      "CollectionType=\"Temporal\">\n");
  for (std::size_t f = 0; f < particles.frame_count(); ++f) {
    Frame frame = particles.frame(f);
    bool inside = true;
    for (auto& x : frame.position) {
      const Vec3 wrapped = frame.cell.wrap(x);
      inside = inside && wrapped == x;
      x = wrapped;
    }
    file.write(
        fmt::format("<Grid Name=\"frame {}\" GridType=\"Uniform\">\n<Time Value=\"{}\"/>\n"
                    "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/>\n<Geometry "
                    "GeometryType=\"XYZ\">\n{}\n</Geometry>\n",
                    f, to_si(Dimension::Time, frame.time), count,
                    inside && !position.empty() ? pointer.item(position, f, 2)
                                                : inline_vectors(frame.position, Dimension::Length)));
    file.write(fixed);
    const auto moving = [&](const char* element, const Vec3Array& vectors, Dimension dimension) {
      if (vectors.empty()) return;
      const std::string path = pointer.dataset(group + "/" + element, dimension);
      file.write(attribute(element, "Vector",
                           path.empty() ? inline_vectors(vectors, dimension) : pointer.item(path, f, 2)));
    };
    moving("velocity", frame.velocity, Dimension::Velocity);
    moving("angular_velocity", frame.angular_velocity, Dimension::AngularVelocity);
    file.write("</Grid>\n");
  }
  file.write("</Grid>\n</Domain>\n</Xdmf>\n");
  file.commit();
}

}  // namespace pigment::io
