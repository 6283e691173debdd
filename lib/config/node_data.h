#pragma once
// What stands behind Node and Document; for this room only.
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "config/node.h"
#include "config/tree.h"

namespace pigment::config {

// One per document, shared by its nodes.
struct Source {
  std::string name;               // in messages: the path as it was given
  std::filesystem::path folder;   // of the scene
  Tree tree;                      // does not change once nodes point into it
  struct Fault {
    int line;
    std::string path, message;
  };
  std::vector<Fault> faults;
  std::set<std::string> faulty_paths;
  struct NamedFile {
    std::string block;  // top-level key
    std::filesystem::path file;
  };
  std::vector<NamedFile> files;

  // The first fault of a path stands; what follows from it is not reported.
  void add(int line, const std::string& path, const std::string& message);
  std::string report() const;
};

// One value that was read: a scalar, a list of scalars, a block, or a list of blocks.
struct Record {
  enum class Kind { Scalar, List, Block, Blocks };
  std::string key;
  Kind kind = Kind::Scalar;
  std::vector<std::string> texts;
  bool is_file = false;
  bool written = true;  // by the scene; a default block without values is left out of the resolved scene
  std::vector<std::shared_ptr<Node::Data>> blocks;
};

struct Node::Data {
  std::shared_ptr<Source> source;
  const Tree* tree = nullptr;  // nullptr: the block is absent
  std::string path;
  int line = 0;                // of the block's key, or of the nearest block around it that is written
  bool undecided = false;      // a word that decides which keys belong here was wrong
  std::vector<Record> records;       // in order of reading
  std::vector<std::string> known;    // keys that readers asked for, in order
  std::set<std::string> read;

  const Tree* find(const std::string& key) const { return tree != nullptr ? tree->find(key) : nullptr; }
  std::string path_of(const std::string& key) const;
  int line_of(const std::string& key) const;
  void know(const std::string& key);
  void mark_read(const std::string& key);
  // The first reading of a key stands: a later reader that looks at the same key does not rewrite it.
  void record(const std::string& key, const std::string& text, bool is_file = false);
  Record& record_entry(const std::string& key);
  void fault(const std::string& key, const std::string& message);
  void missing(const std::string& key, const std::string& hint);
  // The text of a scalar; nothing where the key is absent or not a scalar (then the fault is on record).
  const Tree* scalar(const std::string& key, const std::string& expected);
  std::shared_ptr<Node::Data> child(const std::string& key, const Tree* subtree) const;
  void find_unknown_keys() const;
  Tree resolved(const std::filesystem::path* folder) const;
};

// The nearest of the words by edit distance; empty where there are none.
std::string nearest_word(const std::string& word, const std::vector<std::string>& words);
std::size_t edit_distance(const std::string& a, const std::string& b);
std::string joined(const std::vector<std::string>& words);

}  // namespace pigment::config
