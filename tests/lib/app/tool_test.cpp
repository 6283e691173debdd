#include "app/tool.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "base/error.h"

namespace pigment::app {
namespace {

struct Outcome {
  int status = -1;
  bool ran = false;
  CommonOptions common;
  path scene;
  double relative = 0;
  std::string out, err;
};

Outcome run(std::vector<std::string> words, const std::function<void()>& work = [] {}) {
  Outcome r;
  words.insert(words.begin(), "pigment-try");
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  r.status = run_tool(
      "try", static_cast<int>(argv.size()), argv.data(),
      [&](CommandLine& line) {
        line.describe("Tries.", "pigment-try scene.yaml -o out.h5");
        line.references("[sand2010]");
        line.positional("scene", r.scene, "the scene");
        line.option("--relative", r.relative, "a tolerance");
        line.output_required();
        line.has_threads();
      },
      [&](CommandLine& line) {
        r.ran = true;
        r.common = line.common;
        work();
      });
  r.out = testing::internal::GetCapturedStdout();
  r.err = testing::internal::GetCapturedStderr();
  return r;
}

TEST(Tool, ReadsItsCommandLine) {
  const Outcome r = run({"--set", "a.b=1 um", "s.yaml", "-o", "x.h5", "--set", "c=[1, 2]", "--threads", "1", "--quiet",
                     "--relative", "-1e-3"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.scene, "s.yaml");
  EXPECT_EQ(r.common.output, "x.h5");
  EXPECT_EQ(r.common.set, (std::vector<std::string>{"a.b=1 um", "c=[1, 2]"}));
  EXPECT_EQ(r.common.threads, 1);
  EXPECT_TRUE(r.common.quiet);
  EXPECT_EQ(r.relative, -1e-3);
}

TEST(Tool, HelpShowsExampleAndReferences) {
  const Outcome r = run({"--help"});
  EXPECT_EQ(r.status, 0);
  EXPECT_FALSE(r.ran);
  EXPECT_NE(r.out.find("pigment-try scene.yaml -o out.h5"), std::string::npos);
  EXPECT_NE(r.out.find("[sand2010]"), std::string::npos);
  EXPECT_EQ(run({"--version"}).out.substr(0, 12), "pigment-try ");
}

TEST(Tool, WrongUsageIsTwo) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"s.yaml"},
      {"s.yaml", "-o"},
      {"s.yaml", "-o", ""},
      {"s.yaml", "-o", "x", "--bogus"},
      {"s.yaml", "t.yaml", "-o", "x"},
      {"s.yaml", "-o", "x", "--threads", "0"},
      {"s.yaml", "-o", "x", "--threads", "two"},
      {"s.yaml", "-o", "x", "--threads", "99999999999999999999"},
      {"s.yaml", "-o", "x", "--relative", "nan"},
      {"s.yaml", "-o", "x", "--relative", "1e-3x"},
      {"s.yaml", "-o", "x", "--set"},
  };
  for (const auto& words : wrong) {
    const Outcome r = run(words);
    EXPECT_EQ(r.status, 2) << r.err;
    EXPECT_FALSE(r.ran);
    EXPECT_FALSE(r.err.empty());
  }
}

// Before the work begins, not after an hour of it.
TEST(Tool, UnwritableOutputIsFour) {
  for (const char* output : {"no/such/folder/x.h5", ".", "/dev/null", "folder/"}) {
    const Outcome r = run({"s.yaml", "-o", output});
    EXPECT_EQ(r.status, 4) << output << r.err;
    EXPECT_FALSE(r.ran);
  }
}

TEST(Tool, OutputNeverReplacesAnInput) {
  std::ofstream("tool_test_scene.yaml") << "seed: 1\n";
  const Outcome r = run({"tool_test_scene.yaml", "-o", "./tool_test_scene.yaml"});
  EXPECT_EQ(r.status, 2);
  EXPECT_FALSE(r.ran);
}

TEST(Tool, ErrorsBecomeStatuses) {
  const std::vector<std::string> words = {"s.yaml", "-o", "x.h5"};
  EXPECT_EQ(run(words, [] { throw InputError("s.yaml:1: a: no"); }).status, 2);
  EXPECT_EQ(run(words, [] { throw FileError("f: no"); }).status, 3);
  EXPECT_EQ(run(words, [] { throw OutputError("o: no"); }).status, 4);
  EXPECT_EQ(run(words, [] { throw NumericsError("blew up"); }).status, 1);
  EXPECT_EQ(run(words, [] { throw std::runtime_error("odd"); }).status, 1);
  EXPECT_EQ(run(words, [] { throw std::bad_alloc(); }).status, 1);
  EXPECT_EQ(run(words, [] { throw Interrupted{SIGTERM}; }).status, 143);
  EXPECT_EQ(run(words, [] { throw InputError("s.yaml:1: a: no"); }).err, "s.yaml:1: a: no\n");
}

TEST(Tool, SignalsEndAtOnce) {
  const auto die = [] {
    char name[] = "pigment-try";
    char* argv[] = {name, nullptr};
    run_tool("try", 1, argv, [](CommandLine&) {}, [](CommandLine&) { std::raise(SIGTERM); });
  };
  EXPECT_EXIT(die(), testing::ExitedWithCode(143), "");
}

TEST(Tool, HandledSignalsAreRemembered) {
  const Outcome r = run({"s.yaml", "-o", "x"}, [] {
    handle_signals();
    EXPECT_EQ(stop_requested(), 0);
    std::raise(SIGINT);
    EXPECT_EQ(stop_requested(), SIGINT);
    throw Interrupted{stop_requested()};
  });
  EXPECT_EQ(r.status, 130);
}

}  // namespace
}  // namespace pigment::app
