#pragma once
#include <filesystem>
#include <string>

namespace pigment::report {

// Writes the text beside the final name and renames it when whole; throws OutputError.
void write_whole_file(const std::filesystem::path&, const std::string& bytes);

}  // namespace pigment::report
