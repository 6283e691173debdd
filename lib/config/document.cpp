#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "config/node_data.h"

namespace pigment::config {

struct Document::Data {
  std::shared_ptr<Source> source;
  std::shared_ptr<Node::Data> root;
};

namespace {

std::string read_whole(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw FileError(file.string() + ": cannot be read: it is a folder; expected a scene (YAML)");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(fmt::format("{}: cannot be opened: {}", file.string(), std::strerror(errno)));
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) throw FileError(file.string() + ": cannot be read to its end");
  return text.str();
}

}  // namespace

Document::Document(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  *this = from_text(read_whole(file), file.string(), overrides);
  data_->source->folder = file.parent_path();
}

Document Document::from_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& overrides) {
  Document document;
  document.data_ = std::make_shared<Data>();
  auto source = std::make_shared<Source>();
  source->name = name;
  std::vector<TreeError> errors;
  source->tree = parse_yaml(text, name, errors);
  for (const TreeError& e : errors) source->add(e.line, e.path, e.message);
  for (const std::string& o : overrides) overlay(source->tree, o);
  auto root = std::make_shared<Node::Data>();
  root->source = source;
  root->tree = &source->tree;
  root->line = 1;
  document.data_->source = std::move(source);
  document.data_->root = std::move(root);
  return document;
}

Node Document::root() { return Node(data_->root); }

void Document::check() {
  data_->root->find_unknown_keys();
  if (has_errors()) throw InputError(data_->source->report());
}

bool Document::has_errors() const { return !data_->source->faults.empty(); }

const std::filesystem::path& Document::folder() const { return data_->source->folder; }

std::vector<std::filesystem::path> Document::files(const std::vector<std::string>& blocks) const {
  std::vector<std::filesystem::path> found;
  for (const auto& [block, file] : data_->source->files)
    if (blocks.empty() || std::find(blocks.begin(), blocks.end(), block) != blocks.end())
      if (std::find(found.begin(), found.end(), file) == found.end()) found.push_back(file);
  return found;
}

namespace {
std::string pick(Tree tree, const std::vector<std::string>& blocks) {
  if (!blocks.empty())
    std::erase_if(tree.children,
                  [&](const Tree& t) { return std::find(blocks.begin(), blocks.end(), t.key) == blocks.end(); });
  return emit_yaml(tree);
}
}  // namespace

std::string Document::resolved(const std::vector<std::string>& blocks) const {
  return pick(data_->root->resolved(nullptr), blocks);
}

std::string Document::resolved_for(const std::filesystem::path& folder, const std::vector<std::string>& blocks) const {
  return pick(data_->root->resolved(&folder), blocks);
}

}  // namespace pigment::config
