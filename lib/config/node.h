#pragma once
// A block of a scene: every value is read once, checked, converted to engine units, and recorded with its default, so
// that reading a scene also writes the resolved one. Errors are collected, not thrown: Document::check() reports all of
// them at once, each as "scene.yaml:14: colloidal.electrostatic.debye_length: "5 nmm" is not a length; write e.g. "5 nm"".
// A reader that met an error returns a harmless value (the default, or the low end of the range) and goes on.
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"

namespace pigment::config {

// Bounds in SI units of the quantity's dimension; messages print them so.
struct Range {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  bool min_allowed = true, max_allowed = true;
};
inline Range any() { return {}; }
inline Range positive() { return {0, std::numeric_limits<double>::infinity(), false, true}; }
inline Range non_negative() { return {0, std::numeric_limits<double>::infinity(), true, true}; }
inline Range between(double min, double max) { return {min, max, true, true}; }
inline Range strictly_between(double min, double max) { return {min, max, false, false}; }

class Node {
 public:
  // Whether the scene writes this key (a default does not count).
  bool has(const std::string& key) const;

  // A number with its unit, in engine units. Without a default the key is required. The default is written as a scene
  // would write it ("2 nm") and goes through the same checks.
  double quantity(const std::string& key, Dimension, Range = any());
  double quantity(const std::string& key, Dimension, const std::string& default_text, Range = any());
  std::optional<double> optional_quantity(const std::string& key, Dimension, Range = any());
  // Several quantities, "[0.3 um, 0.5 um]"; the default is a list of such texts.
  std::vector<double> quantities(const std::string& key, Dimension, const std::vector<std::string>& default_texts,
                                 Range = any());
  // A dimensionless number.
  double number(const std::string& key, Range = any());
  double number(const std::string& key, double default_value, Range = any());
  std::int64_t integer(const std::string& key, std::int64_t default_value, Range = any());
  bool boolean(const std::string& key, bool default_value);
  std::string text(const std::string& key);
  std::string text(const std::string& key, const std::string& default_text);
  // A file named relative to the scene's folder; it is not opened here.
  std::filesystem::path file(const std::string& key);
  // One word out of a list; an unknown word is an error that lists the known ones and the nearest.
  template <typename Enum>
  Enum choice(const std::string& key, std::initializer_list<std::pair<const char*, Enum>> words,
              std::optional<const char*> default_word = std::nullopt) {
    std::vector<std::string> names;
    for (const auto& w : words) names.push_back(w.first);
    const std::size_t index = choose(key, names, default_word ? std::optional<std::string>(*default_word) : std::nullopt);
    return (words.begin() + index)->second;
  }
  // Whether the value of this key is just this word ("substrate: none", "cutoff: auto"). Does not count as reading.
  bool is_word(const std::string& key, const std::string& word) const;
  // Reads a key as this word and records it (after is_word said yes, or as a default).
  void accept_word(const std::string& key, const std::string& word);

  // A nested block. block(): an absent one reads as empty, all its defaults apply (and required keys are errors).
  Node block(const std::string& key);
  std::optional<Node> optional_block(const std::string& key);
  std::vector<Node> blocks(const std::string& key);  // a list of blocks; absent: empty
  std::vector<std::string> keys() const;             // as written in the scene, in order

  // Something is wrong with this key although each value is well-formed ("min: must be below max (2 um)"). An empty key
  // means the block itself. A key that already has an error keeps its first.
  void error(const std::string& key, const std::string& message);
  // Whether an error stands at this key: then its value is a stand-in, and checks against other keys are pointless.
  bool failed(const std::string& key) const;
  std::string path() const;  // "colloidal.electrostatic"

  struct Data;
  explicit Node(std::shared_ptr<Data> data) : data_(std::move(data)) {}

 private:
  std::size_t choose(const std::string& key, const std::vector<std::string>& words, std::optional<std::string> def);
  std::shared_ptr<Data> data_;
};

class Document {
 public:
  // Reads the file, then lays `--set key.path=value` texts over it in order (list elements by index:
  // "particles.0.surface_potential=-50 mV"; a missing block is made; the value is YAML). Throws InputError for YAML that
  // cannot be read, with file and line, and FileError where the file cannot be opened.
  Document(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
  // The same from text; `name` stands in messages. For tests and examples.
  static Document from_text(const std::string& text, const std::string& name = "scene",
                            const std::vector<std::string>& overrides = {});

  Node root();
  // Adds an error for every written key that nobody read, with the nearest known key suggested, then throws one
  // InputError holding all errors, one a line, in order of line; returns if there are none.
  void check();
  bool has_errors() const;
  const std::filesystem::path& folder() const;  // of the scene: what file names in it are relative to
  // The resolved scene as YAML: what was written, and every default that was read, in order of reading. With `blocks`:
  // only those top-level keys. Deterministic bytes; comments and formatting of the source do not show. Files are written
  // by their name alone, without folders, so that the same scene gives the same provenance wherever it lies.
  std::string resolved(const std::vector<std::string>& blocks = {}) const;
  // The same for a scene that is to be read from `folder`: files are written relative to it.
  std::string resolved_for(const std::filesystem::path& folder, const std::vector<std::string>& blocks = {}) const;
  // Files that the scene names (Node::file), in these top-level blocks or all, in order of reading: for provenance.
  std::vector<std::filesystem::path> files(const std::vector<std::string>& blocks = {}) const;

  struct Data;

 private:
  Document() = default;
  std::shared_ptr<Data> data_;
};

}  // namespace pigment::config
