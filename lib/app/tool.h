#pragma once
// One main for every tool: options, help, messages, signals, exit statuses.
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pigment::app {

using std::filesystem::path;

// What every tool has: -o/--output, --set, --quiet, --threads (where it has threads), --help, --version.
struct CommonOptions {
  path output;
  std::vector<std::string> set;
  int threads = 0;  // 0: what OpenMP takes
  bool quiet = false;
};

// The options of one tool, bound to variables. A thin face over CLI11, which nothing else sees.
class CommandLine {
 public:
  void describe(const std::string& text, const std::string& example);  // synopsis and example for --help
  void references(const std::string& text);                             // literature, printed by --help
  void positional(const std::string& name, path& variable, const std::string& help, bool required = true);
  void positional(const std::string& name, std::vector<path>& variable, const std::string& help, bool required = true);
  void option(const std::string& flags, path& variable, const std::string& help, bool required = false);
  void option(const std::string& flags, std::vector<path>& variable, const std::string& help);  // repeatable
  void option(const std::string& flags, std::string& variable, const std::string& help);
  void option(const std::string& flags, std::vector<std::string>& variable, const std::string& help);  // repeatable
  void option(const std::string& flags, double& variable, const std::string& help);
  void option(const std::string& flags, int& variable, const std::string& help);
  void flag(const std::string& flags, bool& variable, const std::string& help);
  void output_required(bool required = true, const std::string& help = "the file to write");
  void has_threads();  // adds --threads

  CommonOptions common;
  struct Data;
  std::unique_ptr<Data> data;
  CommandLine();
  ~CommandLine();
};

// Parses, runs, catches. `body(line)` gets the parsed command line (declare() bound the rest to its own variables).
// Exit status as the contract says: 2 usage, Error::exit_status(), 128+n after a signal (see stop_requested), 1 for any
// other exception. name is without the prefix: "pack".
int run_tool(const std::string& name, int argc, char** argv, const std::function<void(CommandLine&)>& declare,
             const std::function<void(CommandLine&)>& body);

// For a tool whose arrays come and go all the time: what is freed stays with the process and is used again, where the system would
// have to clear as many pages anew.
void keep_freed_memory();

// A signal (SIGINT, SIGTERM) ends a tool at once with status 128 + n: nothing partial stands under a final name. A tool
// with a checkpoint calls handle_signals() instead; then stop_requested() is the signal's number (0: none came), which it
// polls, saves, and throws Interrupted.
void handle_signals();
int stop_requested();
struct Interrupted {
  int signal;
};

}  // namespace pigment::app
