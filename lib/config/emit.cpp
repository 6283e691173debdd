// A tree as YAML, always in the same bytes.
#include <fmt/format.h>

#include <algorithm>

#include "config/tree.h"

namespace pigment::config {
namespace {

constexpr std::size_t line_width = 110;

bool reads_as_null(const std::string& s) {
  return s.empty() || s == "~" || s == "null" || s == "Null" || s == "NULL";
}

bool needs_quotes(const std::string& s) {
  if (reads_as_null(s) || s.front() == ' ' || s.back() == ' ' || s.back() == ':') return true;
  if (std::string("?:,[]{}#&*!|>'\"%@`=<").find(s.front()) != s.npos) return true;
  if (s.front() == '-' && (s.size() == 1 || s[1] == ' ' || s[1] == '-')) return true;
  if (s.starts_with("...")) return true;
  if (s.find(": ") != s.npos || s.find(" #") != s.npos) return true;
  return std::any_of(s.begin(), s.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || std::string(",[]{}\"\\").find(c) != std::string::npos;
  });
}

std::string scalar_text(const std::string& s) {
  if (!needs_quotes(s)) return s;
  std::string out = "\"";
  for (const char c : s) {
    const auto u = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (u < 0x20 || u == 0x7f)
      out += fmt::format("\\x{:02x}", u);
    else
      out += c;
  }
  return out + "\"";
}

std::string flow_text(const Tree& tree) {
  const auto joined = [&](char open, char close) {
    std::string out(1, open);
    for (const Tree& child : tree.children) {
      if (out.size() > 1) out += ", ";
      if (tree.kind == Tree::Kind::Map) out += scalar_text(child.key) + ": ";
      out += flow_text(child);
    }
    return out + close;
  };
  switch (tree.kind) {
    case Tree::Kind::List: return joined('[', ']');
    case Tree::Kind::Map: return joined('{', '}');
    case Tree::Kind::Scalar: return scalar_text(tree.scalar);
    case Tree::Kind::Null: break;
  }
  return "~";
}

bool holds_maps(const Tree& tree) {
  return std::any_of(tree.children.begin(), tree.children.end(), [](const Tree& c) {
    return (c.kind == Tree::Kind::Map && !c.children.empty()) || holds_maps(c);
  });
}

void emit_block(const Tree& tree, std::size_t indent, std::string& out);

// What follows "key:" or "-": on the same line where it is short and flat, else a block below.
void emit_value(const Tree& tree, std::size_t indent, std::size_t column, std::string& out) {
  const std::string flow = flow_text(tree);
  const bool flat = tree.children.empty() || (!holds_maps(tree) && column + 1 + flow.size() <= line_width);
  if (flat) {
    out += " " + flow + "\n";
    return;
  }
  out += "\n";
  emit_block(tree, indent + 2, out);
}

void emit_block(const Tree& tree, std::size_t indent, std::string& out) {
  const std::string margin(indent, ' ');
  for (const Tree& child : tree.children) {
    if (tree.kind == Tree::Kind::Map) {
      const std::string head = margin + scalar_text(child.key) + ":";
      out += head;
      emit_value(child, indent, head.size(), out);
    } else if (child.kind == Tree::Kind::Map && !child.children.empty()) {
      std::string item;
      emit_block(child, indent + 2, item);
      item.replace(indent, 1, "-");
      out += item;
    } else {
      out += margin + "-";
      emit_value(child, indent, indent + 1, out);
    }
  }
}

}  // namespace

std::string emit_yaml(const Tree& root) {
  std::string out;
  emit_block(root, 0, out);
  return out;
}

}  // namespace pigment::config
