#pragma once
// A scene's YAML as a plain tree that remembers lines, and a tree as YAML again.
#include <string>
#include <vector>

namespace pigment::config {

struct Tree {
  enum class Kind { Null, Scalar, List, Map };
  Kind kind = Kind::Null;
  std::string key;     // under which it stands in its parent map
  std::string scalar;  // as written, without quotes
  std::vector<Tree> children;
  int line = 0;  // from 1; 0: came from the command line

  const Tree* find(const std::string& key) const;
  Tree* find(const std::string& key);
};

// A fault of form that reading can go on after.
struct TreeError {
  int line;
  std::string path, message;
};

// `name` stands in messages. Throws InputError with file and line where the text is no YAML; duplicate and odd keys are
// appended to `errors`.
Tree parse_yaml(const std::string& text, const std::string& name, std::vector<TreeError>& errors);

// Lays one "key.path=value" over the tree. Null or empty value: the key is taken out. Throws InputError.
void overlay(Tree& root, const std::string& assignment);

// Block style, short blocks on one line as "{a: 1, b: 2}". The root must be a map.
std::string emit_yaml(const Tree& root);

}  // namespace pigment::config
