#include "config/node.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace pigment::config {
namespace {

std::string faults(Document& document) {
  try {
    document.check();
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

enum class Colour { Red, Green };
Colour read_colour(Node node) {
  return node.choice<Colour>("colour", {{"red", Colour::Red}, {"green", Colour::Green}}, "red");
}

TEST(Node, ValuesComeInEngineUnits) {
  Document d = Document::from_text("a: {gap: 5 nm, share: 65 wt%, n: 7, on: yes, colour: green, x: 1e-2}");
  Node a = d.root().block("a");
  EXPECT_DOUBLE_EQ(a.quantity("gap", Dimension::Length), 0.005);
  EXPECT_DOUBLE_EQ(a.quantity("share", Dimension::MassFraction), 0.65);
  EXPECT_EQ(a.integer("n", 1), 7);
  EXPECT_TRUE(a.boolean("on", false));
  EXPECT_EQ(read_colour(a), Colour::Green);
  EXPECT_EQ(a.number("x"), 0.01);
  EXPECT_EQ(faults(d), "");
}

TEST(Node, DefaultsAreReadAndRecorded) {
  Document d = Document::from_text("a: {}\n");
  Node a = d.root().block("a");
  EXPECT_DOUBLE_EQ(a.quantity("gap", Dimension::Length, "2 nm"), 0.002);
  EXPECT_EQ(a.integer("n", 4), 4);
  EXPECT_FALSE(a.boolean("on", false));
  EXPECT_EQ(a.number("x", 0.25), 0.25);
  EXPECT_EQ(read_colour(a), Colour::Red);
  EXPECT_FALSE(a.optional_quantity("other", Dimension::Length));
  EXPECT_EQ(a.quantities("list", Dimension::Length, {"1 um", "2 um"}), (std::vector<double>{1, 2}));
  EXPECT_EQ(faults(d), "");
  EXPECT_EQ(d.resolved(), "a: {gap: 2 nm, n: 4, on: false, x: 0.25, colour: red, list: [1 um, 2 um]}\n");
}

// Every fault of the scene, in order of line, each with file, line and key.
TEST(Document, ReportsAllFaultsAtOnce) {
  Document d = Document::from_text(
      "a:\n"
      "  gap: 5 nmm\n"
      "  width: 5\n"
      "  hight: 3 um\n"
      "  colour: gren\n"
      "b: 3\n"
      "e: [1 um, 2]\n",
      "scene.yaml");
  Node root = d.root();
  root.quantities("e", Dimension::Length, {});
  Node a = root.block("a");
  a.quantity("width", Dimension::Length);
  a.quantity("gap", Dimension::Length);
  a.quantity("height", Dimension::Length, "1 um");
  root.block("b").quantity("gap", Dimension::Length);
  EXPECT_EQ(faults(d),
            "scene.yaml:2: a.gap: \"5 nmm\" is not a length; write e.g. \"5 nm\"\n"
            "scene.yaml:3: a.width: \"5\" is not a length: its unit is missing; write e.g. \"5 nm\"\n"
            "scene.yaml:4: a.hight: unknown key; did you mean \"height\"?\n"
            "scene.yaml:5: a.colour: unknown key; the nearest known one is \"width\" (known here: width, gap, height)\n"
            "scene.yaml:6: b: expected a block of keys, found \"3\"\n"
            "scene.yaml:7: e: \"2\" is not a length: its unit is missing; write e.g. \"5 nm\"");
}

TEST(Document, MissingKeysAreReportedAtTheirBlock) {
  Document d = Document::from_text("x: 1\na:\n  b: {}\n", "s.yaml");
  d.root().integer("x", 1);
  d.root().block("a").block("b").quantity("gap", Dimension::Length);
  d.root().block("none").text("word");
  EXPECT_EQ(faults(d), "s.yaml:1: none.word: missing; write e.g. \"word: a word\"\n"
                       "s.yaml:3: a.b.gap: missing; write e.g. \"gap: 5 nm\"");
}

TEST(Document, WrongWordsListTheKnownOnes) {
  Document d = Document::from_text("a: {colour: gren, size: 3 um}\n", "s.yaml");
  EXPECT_EQ(read_colour(d.root().block("a")), Colour::Red);
  // `size` may belong to another colour's keys: only the word is at fault.
  EXPECT_EQ(faults(d), "s.yaml:1: a.colour: \"gren\" is not one of red, green; did you mean \"green\"?");
}

TEST(Document, RangesAreCheckedAndPrintedInSi) {
  Document d = Document::from_text("a: {gap: -5 nm, t: -300 degC, n: 0, p: 2}\n", "s.yaml");
  Node a = d.root().block("a");
  a.quantity("gap", Dimension::Length, positive());
  a.quantity("t", Dimension::Temperature, between(253.15, 383.15));
  EXPECT_EQ(a.integer("n", 5, between(1, 10)), 5);
  a.number("p", strictly_between(0, 1));
  EXPECT_EQ(faults(d),
            "s.yaml:1: a.gap: \"-5 nm\" is out of range; it must be above 0 m\n"
            "s.yaml:1: a.t: \"-300 degC\" is out of range; it must be at least 253.15 K and at most 383.15 K\n"
            "s.yaml:1: a.n: \"0\" is out of range; it must be at least 1 and at most 10\n"
            "s.yaml:1: a.p: \"2\" is out of range; it must be above 0 and below 1");
}

TEST(Document, KeysWrittenTwiceAreFaults) {
  Document d = Document::from_text("a: {x: 1}\nb: 2\na: {x: 3}\n", "s.yaml");
  d.root().block("a").number("x");
  d.root().number("b");
  EXPECT_EQ(faults(d), "s.yaml:3: a: written twice; it already stands in line 1");
}

TEST(Document, EmptyBlocksSayWhatToWrite) {
  Document d = Document::from_text("born:\n", "s.yaml");
  d.root().optional_block("born");
  EXPECT_EQ(faults(d), "s.yaml:1: born: has no value; write \"born: {}\" for its defaults, or leave the key out");
}

TEST(Document, WhatIsNotYamlNamesItsLine) {
  for (const char* text : {"a: {b: 1\nc: 2\n", "a: 1\n b: 2\n", "a: [1, 2\n", "a: 1\n\tb: 2\n"}) {
    try {
      Document::from_text(text, "s.yaml");
      ADD_FAILURE() << text;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).substr(0, 7), "s.yaml:") << e.what();
      EXPECT_NE(std::string(e.what()).find("cannot be read as YAML"), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(Document::from_text("- a\n- b\n"), InputError);
  EXPECT_THROW(Document::from_text("\"a: 1\n"), InputError);
  EXPECT_THROW(Document::from_text("just words\n"), InputError);
  EXPECT_THROW(Document::from_text("a: 1\n---\nb: 2\n"), InputError);
  EXPECT_THROW(Document::from_text("a: &x [*x]\n"), InputError);
  EXPECT_THROW(Document::from_text(std::string("a: 1\0b", 6)), InputError);
  EXPECT_THROW(Document("no/such/scene.yaml"), FileError);
  EXPECT_THROW(Document("."), FileError);
  Document empty = Document::from_text("# nothing\n");
  EXPECT_EQ(faults(empty), "");
}

TEST(Document, OverridesAreLaidOver) {
  Document d = Document::from_text("a: {gap: 5 nm}\nlist:\n  - {x: 1}\n", "s.yaml",
                                   {"a.gap=7 nm", "list.0.x=2", "list.1.x=3", "b.c.gap=1 um", "e=[1 um, 2 um]"});
  Node root = d.root();
  EXPECT_DOUBLE_EQ(root.block("a").quantity("gap", Dimension::Length), 0.007);
  auto list = root.blocks("list");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].number("x"), 2);
  EXPECT_EQ(list[1].number("x"), 3);
  EXPECT_DOUBLE_EQ(root.block("b").block("c").quantity("gap", Dimension::Length), 1);
  EXPECT_EQ(root.quantities("e", Dimension::Length, {}).size(), 2u);
  EXPECT_EQ(faults(d), "");
}

TEST(Document, OverridesCanTakeABlockOut) {
  Document d = Document::from_text("gravity: {g: 1}\nb: {c: 1}\n", "s.yaml", {"gravity=", "b.c=null", "free_surface.roughness=", "list.3="});
  EXPECT_EQ(d.root().keys(), std::vector<std::string>{"b"});
  EXPECT_FALSE(d.root().has("gravity"));
  EXPECT_TRUE(d.root().block("b").keys().empty());
}

TEST(Document, FaultsOfOverridesSaySo) {
  Document d = Document::from_text("a: {gap: 5 nm}\n", "s.yaml", {"a.gap=7", "a.gab=7 nm"});
  d.root().block("a").quantity("gap", Dimension::Length);
  EXPECT_EQ(faults(d), "--set: a.gap: \"7\" is not a length: its unit is missing; write e.g. \"5 nm\"\n"
                       "--set: a.gab: unknown key; did you mean \"gap\"?");
  for (const char* wrong : {"a", "=1", "a..b=1", "a.gap.x=1", "list.5=1", "list.x=1", "a={", "a=1\n---\n2"})
    EXPECT_THROW(Document::from_text("a: {gap: 5 nm}\nlist: [1]\n", "s.yaml", {wrong}), InputError) << wrong;
}

// What does not change the scene does not change the resolved bytes.
TEST(Document, ResolvedForgetsFormatting) {
  const auto resolved = [](const std::string& text) {
    Document d = Document::from_text(text);
    Node root = d.root();
    Node a = root.block("a");
    a.quantity("gap", Dimension::Length);
    a.number("x", 3);
    root.text("name");
    for (Node& item : root.blocks("list")) item.quantity("gap", Dimension::Length);
    EXPECT_EQ(faults(d), "");
    return d.resolved();
  };
  const std::string once = resolved("a: {gap: 5nm}\nname: 'with: colon'\nlist: [{gap: 1 um}, {gap: 2 um}]\n");
  EXPECT_EQ(once, "a: {gap: 5 nm, x: 3}\nname: \"with: colon\"\nlist:\n  - gap: 1 um\n  - gap: 2 um\n");
  EXPECT_EQ(resolved("# comment\nname: \"with: colon\"\nlist:\n- gap: 1  um\n- gap: 2 um\na:\n  gap: 5 nm # c\n"), once);
  EXPECT_EQ(resolved(once), once);
}

TEST(Document, ResolvedTextSurvivesOddWords) {
  for (const std::string word : {"~", "null", "- x", "a #b", "#b", "it's", "\"q\"", "{x", "a, b", "x:", "tab\there",
                                 "back\\slash", "\xC3\xA5", "-25", "a\nb", "@x", "%x", "? x", "..."}) {
    Document d = Document::from_text("w: x");
    d.root().text("other", word);
    Document again = Document::from_text(d.resolved());
    EXPECT_EQ(again.root().text("other"), word) << d.resolved();
  }
}

TEST(Document, SlicesHoldOnlyTheirBlocks) {
  Document d = Document::from_text("a: {x: 1}\nb: {x: 2}\n");
  d.root().block("b").number("x");
  d.root().block("a").number("x");
  EXPECT_EQ(d.resolved({"a"}), "a: {x: 1}\n");
  EXPECT_EQ(d.resolved(), "b: {x: 2}\na: {x: 1}\n");
}

TEST(Document, FilesAreRelativeToTheScene) {
  Document d = Document::from_text("a: {file: tables/F.csv}\n");
  EXPECT_EQ(d.root().block("a").file("file"), "tables/F.csv");
  ASSERT_EQ(d.files().size(), 1u);
  EXPECT_EQ(d.resolved(), "a: {file: F.csv}\n");                          // provenance: no folders
  EXPECT_EQ(d.resolved_for("tables"), "a: {file: F.csv}\n");
  EXPECT_EQ(d.resolved_for("build/x"), "a: {file: ../../tables/F.csv}\n");  // for a scene that lies elsewhere
}

TEST(Document, KeysThatExcludeEachOtherAreNotCalledUnknown) {
  Document d = Document::from_text("a: {model: x, max: 3 um}\n", "s.yaml");
  Node a = d.root().block("a");
  a.text("model");
  EXPECT_TRUE(a.has("max"));
  EXPECT_EQ(faults(d), "s.yaml:1: a.max: does not apply together with the other keys of this block");
}

}  // namespace
}  // namespace pigment::config
