// scene: a scene as pigment understands it, with every default, and what its numbers say about it.
#include <cstdio>
#include <string>

#include "app/tool.h"
#include "base/error.h"
#include "io/result_file.h"
#include "scene/scene.h"

namespace {

using namespace pigment;

struct Options {
  app::path scene;
  app::path folder;
  std::string stage;
  bool example = false;
};

void declare(app::CommandLine& line, Options& options) {
  line.describe("Checks a scene and writes it with every default filled in.", "pigment-scene scene.yaml --for pack");
  line.positional("scene", options.scene, "the scene (YAML)", false);
  line.option("--for", options.stage, "write just the blocks that this stage reads, and the checksums of the files they name");
  line.option("--folder", options.folder, "the folder that the files named in the scene are to be seen from");
  line.flag("--example", options.example, "write a commented scene to start from");
  line.output_required(false, "the file to write instead of standard output");
}

// The files that the text names, as comments: a make rule that compares slices then sees an edited table too.
std::string checksums(const config::Document& document, const std::string& text) {
  std::string lines;
  for (const auto& file : document.files()) {
    const std::string name = file.filename();
    if (text.find(name) != std::string::npos) lines += "# " + name + " " + io::sha256_of_file(file) + "\n";
  }
  return lines;
}

void run(const app::CommandLine& line, const Options& options) {
  if (options.scene.empty()) throw InputError("pigment-scene: name a scene, or ask for --example");
  config::Document document(options.scene, line.common.set);
  scene::read_scene(document);
  auto folder = line.common.output.empty() ? document.folder() : line.common.output.parent_path();
  if (!options.folder.empty()) folder = options.folder;
  const std::vector<std::string> blocks =
      options.stage.empty() ? std::vector<std::string>{} : scene::stage(options.stage).reads;
  const std::string text = document.resolved_for(folder, blocks);
  std::fputs(text.c_str(), stdout);
  if (!options.stage.empty()) std::fputs(checksums(document, text).c_str(), stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return pigment::app::run_tool(
      "scene", argc, argv, [&](auto& line) { declare(line, options); }, [&](auto& line) { run(line, options); });
}
