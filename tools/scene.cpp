// scene: a scene as pigment understands it, with every default, and what its numbers say about it.
#include <cstdio>
#include <string>

#include "app/tool.h"
#include "base/error.h"
#include "scene/scene.h"

namespace {

using namespace pigment;

struct Options {
  app::path scene;
  std::string stage;
  bool example = false;
};

void declare(app::CommandLine& line, Options& options) {
  line.describe("Checks a scene and writes it with every default filled in.", "pigment-scene scene.yaml --for pack");
  line.positional("scene", options.scene, "the scene (YAML)", false);
  line.option("--for", options.stage, "write just the blocks that this stage reads, without comments");
  line.flag("--example", options.example, "write a commented scene to start from");
  line.output_required(false, "the file to write instead of standard output");
}

void run(const app::CommandLine& line, const Options& options) {
  if (options.scene.empty()) throw InputError("pigment-scene: name a scene, or ask for --example");
  config::Document document(options.scene, line.common.set);
  scene::read_scene(document);
  const auto folder = line.common.output.empty() ? document.folder() : line.common.output.parent_path();
  const std::vector<std::string> blocks =
      options.stage.empty() ? std::vector<std::string>{} : scene::stage(options.stage).reads;
  std::fputs(document.resolved_for(folder, blocks).c_str(), stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return pigment::app::run_tool(
      "scene", argc, argv, [&](auto& line) { declare(line, options); }, [&](auto& line) { run(line, options); });
}
