#pragma once
#include <string>

namespace pigment::report {

// Bytes as text, for pictures inside a page (RFC 4648, with padding).
std::string base64(const std::string& bytes);

}  // namespace pigment::report
