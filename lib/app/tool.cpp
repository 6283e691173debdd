#include "app/tool.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif
#include <omp.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <limits>
#include <new>
#include <optional>

#include "app/manual.h"
#include "base/error.h"
#include "base/log.h"
#include "base/version.h"

namespace pigment::app {
namespace {

constexpr int most_threads = 1024;

volatile std::sig_atomic_t signal_seen = 0;

extern "C" void end_at_once(int signal) { _exit(128 + signal); }
extern "C" void remember_signal(int signal) { signal_seen = signal; }

void on_signals(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

struct CommandLine::Data {
  CLI::App app;
  std::string example, references;
  std::vector<const path*> inputs;                      // what the output must not replace
  std::vector<const std::vector<path>*> input_lists;
  bool has_output = false;

  CLI::Option* add_path(const std::string& flags, path& variable, const std::string& help) {
    return app.add_option_function<std::string>(flags, [&variable](const std::string& text) { variable = text; }, help)
        ->type_name("FILE")
        ->check([](const std::string& text) { return std::string(text.empty() ? "a file needs a name" : ""); });
  }
};

CommandLine::CommandLine() : data(std::make_unique<Data>()) {}
CommandLine::~CommandLine() = default;

void CommandLine::describe(const std::string& text, const std::string& example) {
  data->app.description(text);
  data->example = example;
}

void CommandLine::references(const std::string& text) { data->references = text; }

void CommandLine::positional(const std::string& name, path& variable, const std::string& help, bool required) {
  data->add_path(name, variable, help)->required(required);
  data->inputs.push_back(&variable);
}

void CommandLine::positional(const std::string& name, std::vector<path>& variable, const std::string& help, bool required) {
  data->app
      .add_option_function<std::vector<std::string>>(
          name, [&variable](const std::vector<std::string>& texts) { variable.assign(texts.begin(), texts.end()); },
          help)
      ->type_name("FILE")
      ->required(required);
  data->input_lists.push_back(&variable);
}

void CommandLine::option(const std::string& flags, path& variable, const std::string& help, bool required) {
  data->add_path(flags, variable, help)->required(required);
  data->inputs.push_back(&variable);
}

void CommandLine::option(const std::string& flags, std::vector<path>& variable, const std::string& help) {
  data->app
      .add_option_function<std::vector<std::string>>(
          flags, [&variable](const std::vector<std::string>& texts) { variable.assign(texts.begin(), texts.end()); }, help)
      ->type_name("FILE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  data->input_lists.push_back(&variable);
}

void CommandLine::option(const std::string& flags, std::string& variable, const std::string& help) {
  data->app.add_option(flags, variable, help)->type_name("TEXT");
}

void CommandLine::option(const std::string& flags, std::vector<std::string>& variable, const std::string& help) {
  data->app.add_option(flags, variable, help)->type_name("TEXT")->expected(1)->take_all()->allow_extra_args(false);
}

void CommandLine::option(const std::string& flags, double& variable, const std::string& help) {
  data->app.add_option(flags, variable, help)
      ->type_name("NUMBER")
      ->check([](const std::string& text) -> std::string {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        return end != text.c_str() && *end == '\0' && std::isfinite(value) ? "" : "\"" + text + "\" is not a finite number";
      });
}

void CommandLine::option(const std::string& flags, int& variable, const std::string& help) {
  data->app.add_option(flags, variable, help)->type_name("COUNT");
}

void CommandLine::flag(const std::string& flags, bool& variable, const std::string& help) {
  data->app.add_flag(flags, variable, help);
}

void CommandLine::output_required(bool required, const std::string& help) {
  data->has_output = true;
  data->add_path("-o,--output", common.output, help)->required(required);
}

void CommandLine::has_threads() {
  data->app.add_option("--threads", common.threads, "threads to use; the result does not depend on it")
      ->type_name("COUNT")
      ->check([](const std::string& text) -> std::string {
        char* end = nullptr;
        const long count = std::strtol(text.c_str(), &end, 10);
        if (end != text.c_str() && *end == '\0' && count >= 1 && count <= most_threads) return {};
        return "\"" + text + "\" is not a whole number from 1 to " + std::to_string(most_threads);
      });
}

namespace {

// Before the first second of work: can the output be written at all?
void check_output(const path& output) {
  const auto refuse = [&](const std::string& why) {
    throw OutputError(output.string() + ": cannot be written: " + why);
  };
  std::error_code ignored;
  const auto status = std::filesystem::status(output, ignored);
  if (std::filesystem::is_directory(status)) refuse("it is a folder; name a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) refuse("it is not a plain file");
  if (output.filename().empty()) refuse("it names no file");
  const path folder = output.parent_path().empty() ? path(".") : output.parent_path();
  if (!std::filesystem::is_directory(folder, ignored))
    refuse("the folder \"" + folder.string() + "\" does not exist; make it first");
  if (access(folder.c_str(), W_OK | X_OK) != 0) refuse("the folder \"" + folder.string() + "\" is not writable");
}

void check_inputs_survive(const CommandLine& line) {
  const path& output = line.common.output;
  const auto compare = [&](const path& input) {
    std::error_code ignored;
    if (!input.empty() && std::filesystem::equivalent(input, output, ignored))
      throw InputError(output.string() + ": is an input of this command and would be replaced; name another output");
  };
  for (const path* input : line.data->inputs) compare(*input);
  for (const auto* list : line.data->input_lists)
    for (const path& input : *list) compare(input);
}

// Nothing, where the work may begin; else the exit status.
std::optional<int> parse(CommandLine& line, const std::string& name, int argc, char** argv) {
  CLI::App& app = line.data->app;
  app.name(name);
  if (!line.data->has_output) line.output_required(false);
  app.add_option_function<std::vector<std::string>>(
         "--set", [&line](const std::vector<std::string>& texts) { line.common.set = texts; },
         "lay this value over the scene's; repeatable, e.g. --set stepping.until=\"0.5 s\"")
      ->type_name("KEY.PATH=VALUE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  app.add_flag("-q,--quiet", line.common.quiet, "only warnings and errors on stderr");
  app.set_version_flag("--version", name + " " + version, "print the version and stop");
  app.set_help_flag("-h,--help", "print this help and stop");
  std::string footer;
  if (!line.data->example.empty()) footer += "Example:\n  " + line.data->example + "\n";
  if (!line.data->references.empty()) footer += "\nReferences:\n  " + line.data->references + "\n";
  footer +=
      "\nExit status: 0 done; 1 the run failed; 2 wrong usage or scene; 3 an input file cannot be used;\n"
      "4 the output cannot be written; 128+n ended by signal n.";
  app.footer(footer);
  app.get_formatter()->column_width(34);
  // For the build, which keeps what they print; no user needs them.
  const std::string wish = argc == 2 ? argv[1] : "";
  if (wish == "--print-man-page" || wish == "--print-completion") {
    std::cout << (wish == "--print-completion" ? bash_completion(app)
                                               : man_page(app, line.data->example, line.data->references));
    return 0;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return 0;
  } catch (const CLI::CallForVersion& v) {
    std::cout << v.what() << "\n";
    return 0;
  } catch (const CLI::ParseError& e) {
    std::cerr << name << ": " << e.what() << "\n" << name << " --help shows the options and an example\n";
    return 2;
  }
  return std::nullopt;
}

// What went to stdout must have arrived.
int flush_stdout(int status) {
  std::cout.flush();
  const bool lost = !std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (lost && status == 0) {
    std::cerr << "standard output: cannot be written\n";
    return 4;
  }
  return status;
}

}  // namespace

int run_tool(const std::string& name, int argc, char** argv, const std::function<void(CommandLine&)>& declare,
             const std::function<void(CommandLine&)>& body) {
  const std::string full_name = "pigment-" + name;
  on_signals(end_at_once);
  try {
    CommandLine line;
    declare(line);
    if (const auto status = parse(line, full_name, argc, argv)) return flush_stdout(*status);
    set_quiet(line.common.quiet);
    if (line.common.threads > 0) omp_set_num_threads(line.common.threads);
    if (!line.common.output.empty()) {
      check_output(line.common.output);
      check_inputs_survive(line);
    }
    body(line);
    return flush_stdout(0);
  } catch (const Interrupted& stop) {
    return 128 + stop.signal;
  } catch (const Error& e) {
    std::cout.flush();
    std::cerr << e.what() << "\n";
    return e.exit_status();
  } catch (const std::bad_alloc&) {
    std::cerr << full_name << ": out of memory\n";
  } catch (const std::exception& e) {
    std::cerr << full_name << ": unexpected error: " << e.what() << "\n";
  }
  return 1;
}

void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

void handle_signals() {
  signal_seen = 0;
  on_signals(remember_signal);
}

int stop_requested() { return signal_seen; }

}  // namespace pigment::app
