#pragma once
// NAME.checkpoint.h5 beside the output NAME.h5: named arrays of doubles, exact to the bit, and the hashes of
// what they were made from. The last two are kept (NAME.checkpoint.h5 and .checkpoint.previous.h5), so that a
// file cut off in mid-write never costs the run.
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pigment::io {

struct Checkpoint {
  std::map<std::string, std::vector<double>> arrays;  // doubles, engine units, to the bit
  std::map<std::string, std::vector<std::int64_t>> integers;
  std::map<std::string, std::string> inputs;  // "scene", "packing", "dewatering", ...: what it was made from
};

std::filesystem::path checkpoint_path(const std::filesystem::path& output);
void write_checkpoint(const std::filesystem::path& output, const Checkpoint&);
// The newest whole checkpoint (a damaged one is passed over with a warning); nothing where there is none. One
// made from other inputs is renamed NAME.checkpoint.old.h5, a warning says which input differs, and nothing
// is returned.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& output,
                                          const std::map<std::string, std::string>& inputs);
// Sets an existing checkpoint aside on purpose (--restart), or removes it at the end of a run.
void set_checkpoint_aside(const std::filesystem::path& output);
void remove_checkpoint(const std::filesystem::path& output);

}  // namespace pigment::io
