#pragma once
// What a tool says of itself, in the form of other programs: a manual page and a completion for bash. Both come from the
// declared options alone, so they cannot say anything else than --help.
#include <string>

namespace CLI {
class App;
}

namespace pigment::app {

// troff, macros of man(7). The same text for the same tool and version: no date.
std::string man_page(const CLI::App&, const std::string& example, const std::string& references);
std::string bash_completion(const CLI::App&);

}  // namespace pigment::app
