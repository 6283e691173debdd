#include "config/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "config/node_data.h"

namespace pigment::config {
namespace {

// "25um" and "25   um" are one quantity: they must not make two provenances.
std::string tidy(const std::string& text) {
  std::string words;
  for (const char c : text) {
    const bool space = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (!space)
      words += c;
    else if (!words.empty() && words.back() != ' ')
      words += ' ';
  }
  if (!words.empty() && words.back() == ' ') words.pop_back();
  double value = 0;
  const char* const begin = words.data() + (words.starts_with('+') ? 1 : 0);
  const char* const last = words.data() + words.size();
  const auto [end, status] = std::from_chars(begin, last, value);
  if (status != std::errc{} || end == last) return words;
  const std::string number(begin, end), unit(end, last);
  return unit.front() == ' ' ? number + unit : number + " " + unit;
}

bool inside(double v, const Range& r) {
  return (r.min_allowed ? v >= r.min : v > r.min) && (r.max_allowed ? v <= r.max : v < r.max);
}

std::string describe(const Range& r, Dimension d) {
  const std::string si = info(d).si_unit, unit = si == "1" ? "" : " " + si;
  std::string text;
  if (std::isfinite(r.min)) text += fmt::format("{} {}{}", r.min_allowed ? "at least" : "above", r.min, unit);
  if (std::isfinite(r.max))
    text += fmt::format("{}{} {}{}", text.empty() ? "" : " and ", r.max_allowed ? "at most" : "below", r.max, unit);
  return text;
}

// Stands in for a value that could not be read.
double stand_in(const Range& r) {
  if (std::isfinite(r.min) && r.min_allowed) return r.min;
  if (std::isfinite(r.max) && r.max_allowed) return r.max;
  if (std::isfinite(r.min)) return std::isfinite(r.max) ? 0.5 * (r.min + r.max) : r.min + 1;
  return std::isfinite(r.max) ? r.max - 1 : 0;
}

// The SI value of a text, or nothing and a fault.
std::optional<double> checked(Node::Data& block, const std::string& key, const std::string& text, Dimension d,
                              const Range& range) {
  const ParsedQuantity parsed = parse_quantity(text, d);
  if (!parsed.ok) {
    block.fault(key, parsed.error);
    return std::nullopt;
  }
  if (!inside(parsed.si, range)) {
    block.fault(key, fmt::format("\"{}\" is out of range; it must be {}", text, describe(range, d)));
    return std::nullopt;
  }
  return parsed.si;
}

std::string expected_quantity(Dimension d) {
  const std::string name = info(d).name;
  const bool vowel = std::string("aeiou").find(name.front()) != std::string::npos;
  return fmt::format("{} {} like \"{}\"", vowel ? "an" : "a", name, info(d).example);
}

// Reads a scalar that is written, or the default text, or faults. `required`: absence is a fault.
double read_quantity(Node::Data& block, const std::string& key, Dimension d, const Range& range,
                     const std::string* default_text) {
  const Tree* value = block.scalar(key, expected_quantity(d));
  std::string text;
  if (value != nullptr) {
    text = tidy(value->scalar);
  } else if (block.find(key) == nullptr && default_text != nullptr) {
    text = *default_text;
  } else {
    if (block.find(key) == nullptr) block.missing(key, key + ": " + info(d).example);
    text.clear();
  }
  if (!text.empty() || value != nullptr) {
    block.record(key, text);
    if (const auto si = checked(block, key, text, d, range)) return to_engine(d, *si);
    if (default_text != nullptr)
      if (const ParsedQuantity fallback = parse_quantity(*default_text, d); fallback.ok) return to_engine(d, fallback.si);
  }
  return to_engine(d, stand_in(range));
}

std::optional<bool> as_boolean(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* word : {"true", "yes", "on"})
    if (text == word) return true;
  for (const char* word : {"false", "no", "off"})
    if (text == word) return false;
  return std::nullopt;
}

}  // namespace

bool Node::has(const std::string& key) const {
  data_->know(key);
  return data_->find(key) != nullptr;
}

double Node::quantity(const std::string& key, Dimension d, Range range) {
  return read_quantity(*data_, key, d, range, nullptr);
}

double Node::quantity(const std::string& key, Dimension d, const std::string& default_text, Range range) {
  return read_quantity(*data_, key, d, range, &default_text);
}

std::optional<double> Node::optional_quantity(const std::string& key, Dimension d, Range range) {
  data_->know(key);
  if (data_->find(key) == nullptr) return std::nullopt;
  return read_quantity(*data_, key, d, range, nullptr);
}

std::vector<double> Node::quantities(const std::string& key, Dimension d, const std::vector<std::string>& default_texts,
                                     Range range) {
  data_->mark_read(key);
  const Tree* list = data_->find(key);
  std::vector<std::string> texts = default_texts;
  if (list != nullptr) {
    texts.clear();
    if (list->kind != Tree::Kind::List)
      data_->fault(key, fmt::format("expected a list like [{}]", info(d).example));
    for (const Tree& item : list->children) {
      if (item.kind == Tree::Kind::Scalar)
        texts.push_back(tidy(item.scalar));
      else
        data_->fault(key, fmt::format("expected a list like [{}]; one entry is no plain value", info(d).example));
    }
  }
  Record& r = data_->record_entry(key);
  r.kind = Record::Kind::List;
  r.texts = texts;
  std::vector<double> values;
  for (const std::string& text : texts) {
    const auto si = checked(*data_, key, text, d, range);
    values.push_back(to_engine(d, si ? *si : stand_in(range)));
  }
  return values;
}

double Node::number(const std::string& key, Range range) { return quantity(key, Dimension::Number, range); }

double Node::number(const std::string& key, double default_value, Range range) {
  return quantity(key, Dimension::Number, fmt::format("{}", default_value), range);
}

std::int64_t Node::integer(const std::string& key, std::int64_t default_value, Range range) {
  const Tree* value = data_->scalar(key, "a whole number");
  if (value == nullptr) {
    if (data_->find(key) == nullptr) data_->record(key, std::to_string(default_value));
    return default_value;
  }
  const std::string text = tidy(value->scalar);
  data_->record(key, text);
  std::int64_t result = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), result);
  if (status != std::errc{} || end != text.data() + text.size()) {
    data_->fault(key, fmt::format("\"{}\" is not a whole number; write e.g. \"{}\"", text, default_value));
    return default_value;
  }
  if (!inside(static_cast<double>(result), range)) {
    data_->fault(key, fmt::format("\"{}\" is out of range; it must be {}", text, describe(range, Dimension::Number)));
    return default_value;
  }
  return result;
}

bool Node::boolean(const std::string& key, bool default_value) {
  const Tree* value = data_->scalar(key, "true or false");
  if (value == nullptr) {
    if (data_->find(key) == nullptr) data_->record(key, default_value ? "true" : "false");
    return default_value;
  }
  const std::optional<bool> result = as_boolean(value->scalar);
  if (!result) data_->fault(key, fmt::format("\"{}\" is neither true nor false", value->scalar));
  data_->record(key, result.value_or(default_value) ? "true" : "false");
  return result.value_or(default_value);
}

std::string Node::text(const std::string& key) {
  const Tree* value = data_->scalar(key, "a word");
  if (value == nullptr) {
    if (data_->find(key) == nullptr) data_->missing(key, key + ": a word");
    return {};
  }
  data_->record(key, value->scalar);
  if (value->scalar.empty()) data_->fault(key, "is empty");
  return value->scalar;
}

std::string Node::text(const std::string& key, const std::string& default_text) {
  if (data_->find(key) != nullptr) return text(key);
  data_->mark_read(key);
  data_->record(key, default_text);
  return default_text;
}

std::filesystem::path Node::file(const std::string& key) {
  const Tree* value = data_->scalar(key, "the name of a file");
  if (value == nullptr || value->scalar.empty()) {
    if (data_->find(key) == nullptr)
      data_->missing(key, key + ": F.csv");
    else
      data_->fault(key, "expected the name of a file");
    return {};
  }
  data_->record(key, value->scalar, true);
  const std::filesystem::path file = data_->source->folder / value->scalar;
  const std::string path = data_->path_of(key), block = path.substr(0, path.find('.'));
  auto& files = data_->source->files;
  if (std::none_of(files.begin(), files.end(), [&](const auto& f) { return f.block == block && f.file == file; }))
    files.push_back({block, file});
  return file;
}

bool Node::is_word(const std::string& key, const std::string& word) const {
  data_->know(key);
  const Tree* value = data_->find(key);
  return value != nullptr && value->kind == Tree::Kind::Scalar && value->scalar == word;
}

void Node::accept_word(const std::string& key, const std::string& word) {
  data_->mark_read(key);
  data_->record(key, word);
}

Node Node::block(const std::string& key) {
  data_->mark_read(key);
  Record& r = data_->record_entry(key);
  if (!r.blocks.empty()) return Node(r.blocks.front());  // read before: the same block
  r.kind = Record::Kind::Block;
  const Tree* value = data_->find(key);
  r.written = value != nullptr;
  if (value != nullptr && value->kind != Tree::Kind::Map) {
    data_->fault(key, value->kind == Tree::Kind::Null
                          ? fmt::format("has no value; write \"{}: {{}}\" for its defaults, or leave the key out", key)
                      : value->kind == Tree::Kind::List
                          ? std::string("expected a block of keys, found a list")
                          : fmt::format("expected a block of keys, found \"{}\"", value->scalar));
    value = nullptr;
    auto made = data_->child(key, nullptr);
    made->undecided = true;  // nothing in it can be judged
    r.blocks.push_back(std::move(made));
  } else {
    r.blocks.push_back(data_->child(key, value));
  }
  return Node(r.blocks.front());
}

std::optional<Node> Node::optional_block(const std::string& key) {
  data_->know(key);
  if (data_->find(key) == nullptr) return std::nullopt;
  return block(key);
}

std::vector<Node> Node::blocks(const std::string& key) {
  data_->mark_read(key);
  const Tree* value = data_->find(key);
  if (value == nullptr) return {};
  std::vector<Node> result;
  Record& r = data_->record_entry(key);
  r.kind = Record::Kind::Blocks;
  if (r.blocks.empty()) {
    if (value->kind != Tree::Kind::List) data_->fault(key, "expected a list: entries that begin with \"- \"");
    if (value->kind == Tree::Kind::List && value->children.empty()) data_->fault(key, "the list is empty");
    for (std::size_t i = 0; value->kind == Tree::Kind::List && i < value->children.size(); ++i) {
      const Tree& item = value->children[i];
      const std::string name = key + "." + std::to_string(i);
      auto made = data_->child(name, item.kind == Tree::Kind::Map ? &item : nullptr);
      made->line = item.line;
      if (item.kind != Tree::Kind::Map) {
        data_->source->add(item.line, data_->path_of(name), "expected a block of keys");
        made->undecided = true;
      }
      r.blocks.push_back(std::move(made));
    }
  }
  for (const auto& block : r.blocks) result.emplace_back(block);
  return result;
}

std::vector<std::string> Node::keys() const {
  std::vector<std::string> names;
  if (data_->tree != nullptr)
    for (const Tree& child : data_->tree->children) names.push_back(child.key);
  return names;
}

void Node::error(const std::string& key, const std::string& message) {
  if (!key.empty()) data_->know(key);
  data_->fault(key, message);
}

bool Node::failed(const std::string& key) const { return data_->source->faulty_paths.contains(data_->path_of(key)); }

std::string Node::path() const { return data_->path; }

std::size_t Node::choose(const std::string& key, const std::vector<std::string>& words, std::optional<std::string> def) {
  const auto index_of = [&](const std::string& word) {
    return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
  };
  const std::size_t fallback = def ? index_of(*def) : 0;
  const Tree* value = data_->scalar(key, "one of " + joined(words));
  if (value == nullptr) {
    if (data_->find(key) != nullptr) {
      data_->undecided = true;
    } else if (def) {
      data_->record(key, *def);
    } else {
      data_->missing(key, key + ": " + words.front());
      data_->undecided = true;
    }
    return fallback;
  }
  const std::size_t index = index_of(value->scalar);
  if (index < words.size()) {
    data_->record(key, value->scalar);
    return index;
  }
  const std::string nearest = nearest_word(value->scalar, words);
  const bool close = edit_distance(value->scalar, nearest) <= std::max<std::size_t>(2, value->scalar.size() / 3);
  data_->fault(key, fmt::format("\"{}\" is not one of {}{}", value->scalar, joined(words),
                                close ? "; did you mean \"" + nearest + "\"?" : ""));
  data_->undecided = true;
  return fallback;
}

}  // namespace pigment::config
