#include "config/node_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace pigment::config {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  // Damerau-Levenshtein with neighbouring swaps only.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& words) {
  const auto at = std::min_element(words.begin(), words.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  return at == words.end() ? std::string() : *at;
}

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

void Source::add(int line, const std::string& path, const std::string& message) {
  if (faulty_paths.insert(path).second) faults.push_back({line, path, message});
}

std::string Source::report() const {
  std::vector<Fault> sorted = faults;
  const auto order = [](const Fault& f) { return f.line > 0 ? f.line : std::numeric_limits<int>::max(); };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Fault& a, const Fault& b) { return order(a) < order(b); });
  std::string text;
  for (const Fault& f : sorted) {
    if (!text.empty()) text += "\n";
    text += f.line > 0 ? fmt::format("{}:{}: ", name, f.line) : std::string("--set: ");
    text += f.path.empty() ? f.message : f.path + ": " + f.message;
  }
  return text;
}

std::string Node::Data::path_of(const std::string& key) const {
  if (key.empty()) return path;
  return path.empty() ? key : path + "." + key;
}

int Node::Data::line_of(const std::string& key) const {
  const Tree* value = key.empty() ? nullptr : find(key);
  return value != nullptr ? value->line : line;
}

void Node::Data::know(const std::string& key) {
  if (std::find(known.begin(), known.end(), key) == known.end()) known.push_back(key);
}

void Node::Data::mark_read(const std::string& key) {
  know(key);
  read.insert(key);
}

Record& Node::Data::record_entry(const std::string& key) {
  const auto at = std::find_if(records.begin(), records.end(), [&](const Record& r) { return r.key == key; });
  if (at != records.end()) return *at;
  records.emplace_back().key = key;
  return records.back();
}

void Node::Data::record(const std::string& key, const std::string& text, bool is_file) {
  Record& r = record_entry(key);
  if (!r.texts.empty()) return;
  r.kind = Record::Kind::Scalar;
  r.texts = {text};
  r.is_file = is_file;
}

void Node::Data::fault(const std::string& key, const std::string& message) {
  source->add(line_of(key), path_of(key), message);
}

void Node::Data::missing(const std::string& key, const std::string& hint) {
  if (!undecided) fault(key, "missing; write e.g. \"" + hint + "\"");
}

const Tree* Node::Data::scalar(const std::string& key, const std::string& expected) {
  mark_read(key);
  const Tree* value = find(key);
  if (value == nullptr) return nullptr;
  if (value->kind == Tree::Kind::Scalar) return value;
  const char* found = value->kind == Tree::Kind::Map ? "a block" : value->kind == Tree::Kind::List ? "a list" : "nothing";
  fault(key, fmt::format("expected {}, found {}", expected, found));
  return nullptr;
}

std::shared_ptr<Node::Data> Node::Data::child(const std::string& key, const Tree* subtree) const {
  auto made = std::make_shared<Node::Data>();
  made->source = source;
  made->tree = subtree;
  made->path = path_of(key);
  made->line = subtree != nullptr ? subtree->line : line;
  made->undecided = undecided;
  return made;
}

void Node::Data::find_unknown_keys() const {
  if (tree != nullptr && !undecided) {
    for (const Tree& entry : tree->children) {
      if (read.contains(entry.key)) continue;
      if (known.empty()) {
        source->add(entry.line, path_of(entry.key), "unknown key; no keys are known here");
        continue;
      }
      const std::string nearest = nearest_word(entry.key, known);
      // Asked about but not read: the key exists, but not together with what else is written here.
      if (nearest == entry.key)
        source->add(entry.line, path_of(entry.key), "does not apply together with the other keys of this block");
      else if (edit_distance(entry.key, nearest) <= std::max<std::size_t>(2, entry.key.size() / 3))
        source->add(entry.line, path_of(entry.key), "unknown key; did you mean \"" + nearest + "\"?");
      else
        source->add(entry.line, path_of(entry.key),
                    fmt::format("unknown key; the nearest known one is \"{}\" (known here: {})", nearest, joined(known)));
    }
  }
  for (const Record& r : records)
    for (const auto& block : r.blocks) block->find_unknown_keys();
}

Tree Node::Data::resolved(const std::filesystem::path* folder) const {
  namespace fs = std::filesystem;
  Tree out;
  out.kind = Tree::Kind::Map;
  const auto file_text = [&](const std::string& text) {
    const fs::path given(text);
    if (folder == nullptr) return given.filename().string();
    if (given.is_absolute()) return text;
    const fs::path from = fs::weakly_canonical(fs::absolute(folder->empty() ? fs::path(".") : *folder));
    const fs::path to = fs::weakly_canonical(fs::absolute(source->folder / given));
    return to.lexically_relative(from).string();
  };
  for (const Record& r : records) {
    Tree entry;
    entry.key = r.key;
    switch (r.kind) {
      case Record::Kind::Scalar:
        entry.kind = Tree::Kind::Scalar;
        entry.scalar = r.is_file ? file_text(r.texts.front()) : r.texts.front();
        break;
      case Record::Kind::List:
        entry.kind = Tree::Kind::List;
        for (const std::string& text : r.texts) {
          entry.children.emplace_back().kind = Tree::Kind::Scalar;
          entry.children.back().scalar = text;
        }
        break;
      case Record::Kind::Block: {
        const std::string key = r.key;
        entry = r.blocks.front()->resolved(folder);
        entry.key = key;
        if (entry.children.empty() && !r.written) continue;
        break;
      }
      case Record::Kind::Blocks:
        entry.kind = Tree::Kind::List;
        for (const auto& block : r.blocks) entry.children.push_back(block->resolved(folder));
        break;
    }
    out.children.push_back(std::move(entry));
  }
  return out;
}

}  // namespace pigment::config
