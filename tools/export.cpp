// export: particle files for ParaView, OVITO and MDAnalysis; results as CSV.
#include "io/export.h"

#include <fmt/format.h>

#include "app/tool.h"
#include "base/error.h"
#include "base/log.h"
#include "io/particle_file.h"

namespace {

using namespace pigment;

struct Options {
  std::filesystem::path input;
  std::string format, dataset;
  bool csv = false;
};

void declare(app::CommandLine& line, Options& options) {
  line.describe(
      "Writes a packing or a trajectory in a form that other programs read, x and y wrapped into the box:\n"
      "xdmf (ParaView, the reader called XDMF Reader), xyz (OVITO, extended XYZ with Radius; um, s),\n"
      "h5md (MDAnalysis, nm and ns). Or the numbers of any file of pigment as csv.",
      "pigment-export trajectory.h5 -o trajectory.xyz");
  line.positional("input", options.input, "a packing or a trajectory; for csv any file of pigment");
  line.option("--format", options.format,
              "xdmf, xyz, h5md or csv; else the ending of the output says (.h5: h5md)");
  line.flag("--csv", options.csv, "the same as --format csv");
  line.option("--dataset", options.dataset,
              "for csv: a dataset, or a group whose datasets stand side by side");
  line.output_required(false, "the file to write; else the input's name with the format's ending, beside it");
}

std::string format_of(const Options& options, const std::filesystem::path& output) {
  const std::string ending = output.extension().string();
  std::string format = options.format;
  if (options.csv) {
    if (!format.empty() && format != "csv")
      throw InputError(fmt::format("--csv: contradicts --format {}", format));
    format = "csv";
  }
  if (format.empty()) {
    if (output.empty())
      format = "xdmf";
    else if (ending == ".xdmf" || ending == ".xmf")
      format = "xdmf";
    else if (ending == ".xyz" || ending == ".extxyz" || ending == ".exyz")
      format = "xyz";
    else if (ending == ".h5" || ending == ".h5md")
      format = "h5md";
    else if (ending == ".csv")
      format = "csv";
    else
      throw InputError(fmt::format("{}: its ending says no format; use .xdmf, .xyz, .h5 or .csv, or --format",
                                   output.string()));
  }
  if (format != "xdmf" && format != "xyz" && format != "h5md" && format != "csv")
    throw InputError(fmt::format("--format: \"{}\" is none; use xdmf, xyz, h5md or csv", format));
  if (!options.dataset.empty() && format != "csv") throw InputError("--dataset: is for csv only");
  return format;
}

void run(const Options& options, std::filesystem::path output) {
  const std::string format = format_of(options, output);
  if (output.empty()) {
    output = options.input;
    output.replace_extension(format == "h5md" ? ".nm.h5" : "." + format);
  }
  if (format == "csv") {
    std::string object = options.dataset;
    if (!object.empty() && object.front() != '/') object.insert(0, "/");
    while (object.size() > 1 && object.back() == '/') object.pop_back();
    const io::CsvLeftOut left_out = io::export_csv(options.input, object, output);
    if (!left_out.other_rows.empty())
      warning(fmt::format("{}: left out, for they have another number of rows: {}; --dataset writes one",
                          output.string(), left_out.other_rows));
    if (!left_out.too_wide.empty())
      warning(fmt::format("{}: left out, for they have more than 1000 columns: {}; --dataset writes one",
                          output.string(), left_out.too_wide));
  } else {
    const io::ParticleFile particles(options.input);
    if (format == "xdmf") io::export_xdmf(particles, output);
    if (format == "xyz") io::export_xyz(particles, output);
    if (format == "h5md") io::export_h5md(particles, output);
  }
  note(fmt::format("{} written", output.string()));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return app::run_tool(
      "export", argc, argv, [&](app::CommandLine& line) { declare(line, options); },
      [&](app::CommandLine& line) { run(options, line.common.output); });
}
