#include "app/manual.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <vector>

#include "base/version.h"

namespace pigment::app {
namespace {

// Text as troff reads it back: backslashes and hyphens meant as such, and no line that begins a request.
std::string troff(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_begins = c == '\n';
  }
  return out;
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// "-o", "--output": short names first.
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& n : option.get_snames()) names.push_back("-" + n);
  for (const std::string& n : option.get_lnames()) names.push_back("--" + n);
  return names;
}

bool is_positional(const CLI::Option& option) { return names_of(option).empty(); }
bool takes_value(const CLI::Option& option) { return option.get_type_size() != 0; }

// "Packs particles": up to the first stop.
std::string headline(const std::string& description) {
  return description.substr(0, description.find_first_of(".:;"));
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& example, const std::string& references) {
  const std::string name = app.get_name();
  std::string out = ".TH " + troff(upper(name)) + " 1 \"\" \"pigment " + troff(version) + "\" \"User commands\"\n.ad l\n.nh\n";
  out += ".SH NAME\n" + troff(name) + " \\- " + troff(headline(app.get_description())) + "\n";
  out += ".SH SYNOPSIS\n.B " + troff(name) + "\n";
  std::string options;
  for (const CLI::Option* option : app.get_options()) {
    if (is_positional(*option)) {
      const std::string word = "\\fI" + troff(option->get_name(true)) + "\\fR" + (option->get_expected_max() > 1 ? " ..." : "");
      out += option->get_required() ? word + "\n" : "[" + word + "]\n";
    } else if (option->get_required()) {
      out += "\\fB" + troff(names_of(*option).front()) + "\\fR \\fI" + troff(option->get_type_name()) + "\\fR\n";
    }
    options += ".TP\n";
    const auto names = names_of(*option);
    for (std::size_t i = 0; i < names.size(); ++i) options += (i ? ", " : "") + ("\\fB" + troff(names[i]) + "\\fR");
    if (is_positional(*option)) options += "\\fI" + troff(option->get_name(true)) + "\\fR";
    if (!is_positional(*option) && takes_value(*option)) options += " \\fI" + troff(option->get_type_name()) + "\\fR";
    options += "\n" + troff(option->get_description()) + "\n";
  }
  out += "[\\fIoptions\\fR]\n.SH DESCRIPTION\n" + troff(app.get_description()) + "\n.SH OPTIONS\n" + options;
  if (!example.empty()) out += ".SH EXAMPLE\n.nf\n" + troff(example) + "\n.fi\n";
  out +=
      ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nthe run failed\n.TP\n2\nwrong usage or scene\n.TP\n3\nan input file cannot be "
      "used\n.TP\n4\nthe output cannot be written\n.TP\n128+\\fIn\\fR\nended by signal \\fIn\\fR\n";
  if (!references.empty()) out += ".SH REFERENCES\n.nf\n" + troff(references) + "\n.fi\n";
  return out;
}

std::string bash_completion(const CLI::App& app) {
  std::string words, function = "_" + app.get_name();
  std::replace(function.begin(), function.end(), '-', '_');
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : names_of(*option))
      if (name.starts_with("--")) words += (words.empty() ? "" : " ") + name;
  return "# bash completion of " + app.get_name() + "\n" + function + "() {\n  local word=${COMP_WORDS[COMP_CWORD]}\n  COMPREPLY=()\n" +
         "  if [[ $word == -* ]]; then\n    mapfile -t COMPREPLY < <(compgen -W '" + words + "' -- \"$word\")\n  fi\n}\n" +
         "complete -o default -F " + function + " " + app.get_name() + "\n";
}

}  // namespace pigment::app
