#include "io/file_header.h"

#include <fmt/format.h>

#include <cstdlib>

#include "base/version.h"

namespace pigment::io {
namespace {

// The major number in any form that somebody may write: 1, [1, 0], "1.0".
std::optional<double> major_version(const h5::InputFile& file) {
  if (const auto numbers = file.number_attribute("/pigment", "format_version"); numbers && !numbers->empty())
    return numbers->front();
  if (const auto text = file.text_attribute("/pigment", "format_version"))
    return std::strtod(text->c_str(), nullptr);
  return std::nullopt;
}

}  // namespace

void write_header(h5::OutputFile& file, const std::string& kind,
                  const std::map<std::string, std::string>& attributes, const Provenance& provenance) {
  file.group("/pigment");
  file.attribute("/pigment", "format_version", std::vector<std::int64_t>{format_major, format_minor});
  file.attribute("/pigment", "kind", kind);
  for (const auto& [name, text] : attributes) file.attribute("/pigment", name, text);
  file.group("/provenance");
  file.attribute("/provenance", "tool", provenance.tool);
  file.attribute("/provenance", "version", std::string(version));
  if (!provenance.scene.empty()) file.write("/provenance/scene", provenance.scene);
  file.group("/provenance/inputs");
  for (const auto& [role, hash] : provenance.inputs) file.attribute("/provenance/inputs", role, hash);
}

Header read_header(const h5::InputFile& file) {
  Header header;
  if (file.is_group("/pigment")) {
    if (const auto major = major_version(file); major && *major >= format_major + 1)
      file.fail("/pigment",
                fmt::format("format version {} is newer than this program reads ({}.{}); use a newer pigment",
                            *major, format_major, format_minor));
    for (const auto& name : file.attributes("/pigment")) {
      const auto text = file.text_attribute("/pigment", name);
      if (!text) continue;
      if (name == "kind")
        header.kind = *text;
      else
        header.attributes[name] = *text;
    }
  }
  if (file.is_group("/provenance")) {
    header.provenance.tool = file.text_attribute("/provenance", "tool").value_or("");
    if (file.is_dataset("/provenance/scene")) {
      const auto texts = file.texts("/provenance/scene");
      if (!texts.empty()) header.provenance.scene = texts.front();
    }
    if (file.is_group("/provenance/inputs"))
      for (const auto& role : file.attributes("/provenance/inputs"))
        header.provenance.inputs[role] = file.text_attribute("/provenance/inputs", role).value_or("");
  }
  return header;
}

}  // namespace pigment::io
