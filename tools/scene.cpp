// scene: a scene as pigment understands it, with every default, and what its numbers say about it.
#include <cstdio>
#include <string>

#include "app/tool.h"
#include "base/error.h"
#include "io/result_file.h"
#include "report/whole_file.h"
#include "scene/example.h"
#include "scene/remarks.h"
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
  line.describe(
      "Checks a scene and writes it with every default filled in; below it, as comments, the dimensionless numbers,\n"
      "amounts, which models the scene needs and which it could drop, and what it will cost.",
      "pigment-scene --example > scene.yaml\n  pigment-scene scene.yaml\n  pigment-scene scene.yaml --for pack");
  line.references("[sand2010] A. Sand, Microscopic Simulation of Pigment Coating Consolidation, 2010: (2)-(4)");
  line.positional("scene", options.scene, "the scene (YAML)", false);
  line.option("--for", options.stage,
              "write just the blocks that this stage reads, and the checksums of the files they name");
  line.option("--folder", options.folder,
              "the folder that files named in the scene are written relative to (default: the output's, or the scene's)");
  line.flag("--example", options.example, "write a commented scene to start from");
  line.output_required(false, "the file to write instead of standard output");
}

// The files that these blocks name, as comments: a make rule that compares slices then sees an edited table too.
std::string checksums(const config::Document& document, const std::vector<std::string>& blocks) {
  std::string lines;
  for (const auto& file : document.files(blocks))
    lines += "# " + file.filename().string() + " " + io::sha256_of_file(file) + "\n";
  return lines;
}

std::string text_of(const app::CommandLine& line, const Options& options) {
  if (options.example) return scene::example_scene();
  if (options.scene.empty()) throw InputError("pigment-scene: name a scene, or ask for --example");
  const std::vector<std::string> blocks =
      options.stage.empty() ? std::vector<std::string>{} : scene::stage(options.stage).reads;
  config::Document document(options.scene, line.common.set);
  const scene::Scene scene = scene::read_scene(document);
  const auto folder = !options.folder.empty()       ? options.folder
                      : line.common.output.empty() ? document.folder()
                                                   : line.common.output.parent_path();
  std::string text = document.resolved_for(folder, blocks);
  if (!options.stage.empty()) return text + checksums(document, blocks);
  text += "\n";
  for (const std::string& remark : scene::remarks(scene)) text += "# " + remark + "\n";
  return text;
}

void run(const app::CommandLine& line, const Options& options) {
  const std::string text = text_of(line, options);
  if (line.common.output.empty())
    std::fputs(text.c_str(), stdout);
  else
    report::write_whole_file(line.common.output, text);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return pigment::app::run_tool(
      "scene", argc, argv, [&](auto& line) { declare(line, options); }, [&](auto& line) { run(line, options); });
}
