#pragma once
// What every file of ours says about itself: /pigment (format version, kind) and /provenance.
#include <map>
#include <optional>
#include <string>

#include "io/h5.h"
#include "io/result_file.h"

namespace pigment::io {

inline constexpr std::int64_t format_major = 1, format_minor = 0;

void write_header(h5::OutputFile&, const std::string& kind,
                  const std::map<std::string, std::string>& attributes, const Provenance&);

struct Header {
  std::string kind;                               // empty: not made by a pigment tool
  std::map<std::string, std::string> attributes;  // text attributes of /pigment but `kind`
  Provenance provenance;
};
// Writes each dataset in SI with its unit.
void write_datasets(h5::OutputFile&, const std::vector<Dataset>&);
// Throws FileError for a newer major version.
Header read_header(const h5::InputFile&);

}  // namespace pigment::io
