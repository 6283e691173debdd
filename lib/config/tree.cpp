#include "config/tree.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "base/error.h"

namespace pigment::config {
namespace {

constexpr int deepest = 32;            // levels; a scene has five
constexpr int most_values = 100'000;   // aliases of aliases can make a small file huge

struct Converter {
  const std::string& name;
  std::vector<TreeError>& errors;
  int values = 0;

  Tree convert(const YAML::Node& node, const std::string& path, int depth) {
    if (depth > deepest || ++values > most_values)
      throw InputError(fmt::format("{}:{}: {}: nested too deeply or too large for a scene", name,
                                   node.Mark().line + 1, path));
    Tree tree;
    tree.line = node.Mark().line + 1;
    switch (node.Type()) {
      case YAML::NodeType::Undefined:
      case YAML::NodeType::Null:
        break;
      case YAML::NodeType::Scalar:
        tree.kind = Tree::Kind::Scalar;
        tree.scalar = node.Scalar();
        break;
      case YAML::NodeType::Sequence:
        tree.kind = Tree::Kind::List;
        for (const auto& item : node)
          tree.children.push_back(convert(item, path + "." + std::to_string(tree.children.size()), depth + 1));
        break;
      case YAML::NodeType::Map:
        tree.kind = Tree::Kind::Map;
        for (const auto& entry : node) add_entry(tree, entry.first, entry.second, path, depth);
        break;
    }
    return tree;
  }

  void add_entry(Tree& tree, const YAML::Node& key, const YAML::Node& value, const std::string& path, int depth) {
    const int line = key.Mark().line + 1;
    if (!key.IsScalar()) {
      errors.push_back({line, path, "a key must be a plain word"});
      return;
    }
    const std::string here = path.empty() ? key.Scalar() : path + "." + key.Scalar();
    if (const Tree* first = tree.find(key.Scalar())) {
      errors.push_back({line, here, fmt::format("written twice; it already stands in line {}", first->line)});
      return;
    }
    Tree child = convert(value, here, depth + 1);
    child.key = key.Scalar();
    child.line = line;
    tree.children.push_back(std::move(child));
  }
};

std::vector<YAML::Node> load(const std::string& text, const std::string& where) {
  try {
    return YAML::LoadAll(text);
  } catch (const YAML::Exception& e) {
    if (e.mark.is_null()) throw InputError(fmt::format("{}: cannot be read as YAML: {}", where, e.msg));
    throw InputError(fmt::format("{}:{}: cannot be read as YAML: {} (column {})", where, e.mark.line + 1, e.msg,
                                 e.mark.column + 1));
  }
}

void clear_lines(Tree& tree) {
  tree.line = 0;
  for (Tree& child : tree.children) clear_lines(child);
}

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

bool is_index(const std::string& text) {
  return !text.empty() && text.size() < 6 && text.find_first_not_of("0123456789") == text.npos;
}

}  // namespace

const Tree* Tree::find(const std::string& wanted) const {
  const auto at = std::find_if(children.begin(), children.end(), [&](const Tree& c) { return c.key == wanted; });
  return kind == Kind::Map && at != children.end() ? &*at : nullptr;
}
Tree* Tree::find(const std::string& wanted) {
  return const_cast<Tree*>(static_cast<const Tree*>(this)->find(wanted));
}

Tree parse_yaml(const std::string& text, const std::string& name, std::vector<TreeError>& errors) {
  if (const auto nul = text.find('\0'); nul != text.npos)
    throw InputError(fmt::format("{}:{}: cannot be read as YAML: the file holds binary data", name,
                                 1 + std::count(text.begin(), text.begin() + static_cast<long>(nul), '\n')));
  const std::vector<YAML::Node> documents = load(text, name);
  if (documents.size() > 1)
    throw InputError(fmt::format("{}:{}: a scene is one YAML document; a second one begins here (after \"---\")",
                                 name, documents[1].Mark().line + 1));
  Tree root;
  if (!documents.empty()) root = Converter{name, errors}.convert(documents.front(), "", 0);
  if (root.kind == Tree::Kind::Null) root.kind = Tree::Kind::Map;
  if (root.kind != Tree::Kind::Map)
    throw InputError(fmt::format("{}:{}: a scene is a block of keys like \"layer: {{thickness: 25 um}}\"; found {}",
                                 name, std::max(root.line, 1),
                                 root.kind == Tree::Kind::List ? "a list" : "\"" + root.scalar + "\""));
  return root;
}

void overlay(Tree& root, const std::string& assignment) {
  const auto fail = [&](const std::string& why) -> void {
    throw InputError(fmt::format("--set {}: {}; write e.g. --set stepping.until=\"0.5 s\"", assignment, why));
  };
  const auto equals = assignment.find('=');
  if (equals == assignment.npos) fail("expected key.path=value");
  const std::vector<std::string> parts = split_path(assignment.substr(0, equals));
  std::vector<TreeError> errors;
  const std::vector<YAML::Node> documents = load(assignment.substr(equals + 1), "--set " + assignment);
  if (documents.size() > 1) fail("expected one value");
  Tree value;
  if (!documents.empty()) value = Converter{assignment, errors}.convert(documents.front(), "", 0);
  if (!errors.empty()) fail(errors.front().path + ": " + errors.front().message);
  clear_lines(value);

  const bool takes_out = value.kind == Tree::Kind::Null;
  Tree* at = &root;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    if (part.empty()) fail("a part of the key is empty");
    if (at->kind == Tree::Kind::Null) {  // a block that the scene does not have is made
      if (takes_out) return;
      at->kind = is_index(part) ? Tree::Kind::List : Tree::Kind::Map;
      at->line = 0;
    }
    Tree* next = nullptr;
    if (at->kind == Tree::Kind::List) {
      std::size_t index = 0;
      if (!is_index(part)) fail(fmt::format("\"{}\" is no index into a list of {}", part, at->children.size()));
      std::from_chars(part.data(), part.data() + part.size(), index);
      if (index > at->children.size())
        fail(fmt::format("index {} is past the end of a list of {}", index, at->children.size()));
      if (index == at->children.size() && takes_out) return;
      if (index == at->children.size()) at->children.emplace_back();
      next = &at->children[index];
    } else if (at->kind == Tree::Kind::Map) {
      next = at->find(part);
      if (next == nullptr && takes_out) return;  // is not there anyway
      if (next == nullptr) {
        at->children.emplace_back().key = part;
        next = &at->children.back();
      }
    } else {
      fail(fmt::format("\"{}\" is a value (\"{}\"), not a block", parts[i - 1], at->scalar));
    }
    if (i + 1 == parts.size() && takes_out) {
      at->children.erase(at->children.begin() + (next - at->children.data()));
      return;
    }
    at = next;
  }
  value.key = at->key;
  *at = std::move(value);
}

}  // namespace pigment::config
