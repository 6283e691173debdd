#include "io/checkpoint_file.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/log.h"
#include "io/file_header.h"
#include "io/h5.h"
#include "io/sibling.h"

namespace pigment::io {
namespace {

namespace fs = std::filesystem;

fs::path previous_path(const fs::path& output) { return sibling(output, ".checkpoint.previous.h5"); }
fs::path old_path(const fs::path& output) { return sibling(output, ".checkpoint.old.h5"); }

void move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw OutputError(
        fmt::format("{}: cannot be renamed {}: {}", from.string(), to.string(), error.message()));
}

Checkpoint read_one(const fs::path& name) {
  const h5::InputFile file(name);
  const Header header = read_header(file);
  if (header.kind != "checkpoint")
    throw FileError(fmt::format("{}: is a {} file, expected a checkpoint", name.string(), header.kind));
  Checkpoint checkpoint;
  checkpoint.inputs = header.provenance.inputs;
  for (const auto& array : file.children("/checkpoint/arrays"))
    checkpoint.arrays[array] = file.doubles("/checkpoint/arrays/" + array);
  for (const auto& array : file.children("/checkpoint/integers"))
    checkpoint.integers[array] = file.integers("/checkpoint/integers/" + array);
  return checkpoint;
}

// The first input that differs; empty where none does.
std::string difference(const std::map<std::string, std::string>& then,
                       const std::map<std::string, std::string>& now) {
  for (const auto& [role, hash] : now) {
    const auto found = then.find(role);
    if (found == then.end()) return fmt::format("{} was not among its inputs", role);
    if (found->second != hash) return fmt::format("{} has changed", role);
  }
  for (const auto& [role, hash] : then)
    if (!now.contains(role)) return fmt::format("{} is no longer among the inputs", role);
  return {};
}

}  // namespace

fs::path checkpoint_path(const fs::path& output) { return sibling(output, ".checkpoint.h5"); }

void write_checkpoint(const fs::path& output, const Checkpoint& checkpoint) {
  // Under a name of its own first, so that the newest and the previous are never both in the making.
  const fs::path newest = checkpoint_path(output), fresh = sibling(output, ".checkpoint.new.h5");
  h5::OutputFile file(fresh);
  // One a frame: deflating them took a tenth of the time of a layer of 7,000 particles with a frame every 5 ms.
  file.keep_plain();
  Provenance provenance;
  provenance.tool = "checkpoint";
  provenance.inputs = checkpoint.inputs;
  write_header(file, "checkpoint", {{"units", "engine: um, ms, pN, mV, K"}}, provenance);
  file.group("/checkpoint/arrays");
  file.group("/checkpoint/integers");
  for (const auto& [name, values] : checkpoint.arrays)
    file.write("/checkpoint/arrays/" + name, {values.size()}, values.data());
  for (const auto& [name, values] : checkpoint.integers)
    file.write("/checkpoint/integers/" + name, {values.size()}, values.data());
  file.commit();
  if (fs::exists(newest)) move(newest, previous_path(output));
  move(fresh, newest);
}

std::optional<Checkpoint> read_checkpoint(const fs::path& output,
                                          const std::map<std::string, std::string>& inputs) {
  for (const fs::path& name : {checkpoint_path(output), previous_path(output)}) {
    if (!fs::exists(name)) continue;
    Checkpoint checkpoint;
    try {
      checkpoint = read_one(name);
    } catch (const FileError& e) {
      warning(fmt::format("{}; this checkpoint is left out", e.what()));
      continue;
    }
    const std::string differs = difference(checkpoint.inputs, inputs);
    if (differs.empty()) return checkpoint;
    warning(fmt::format("{}: is not used: {}; it is kept as {}, and the run begins anew", name.string(),
                        differs, old_path(output).filename().string()));
    set_checkpoint_aside(output);
    return std::nullopt;
  }
  return std::nullopt;
}

void set_checkpoint_aside(const fs::path& output) {
  const fs::path newest = checkpoint_path(output), previous = previous_path(output);
  if (fs::exists(newest))
    move(newest, old_path(output));
  else if (fs::exists(previous))
    move(previous, old_path(output));
  std::error_code ignored;
  fs::remove(previous, ignored);
}

void remove_checkpoint(const fs::path& output) {
  std::error_code ignored;
  // The last two are what a process killed in mid-write leaves.
  for (const fs::path& name : {checkpoint_path(output), previous_path(output), sibling(output, ".checkpoint.new.h5"),
                               sibling(output, ".checkpoint.new.h5.part")})
    fs::remove(name, ignored);
}

}  // namespace pigment::io
