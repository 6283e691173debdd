#include "base/log.h"

#include <gtest/gtest.h>

#include <functional>

namespace pigment {
namespace {

std::string said(const std::function<void()>& talk) {
  testing::internal::CaptureStderr();
  talk();
  set_quiet(false);
  return testing::internal::GetCapturedStderr();
}

TEST(Log, QuietSilencesNotesAndProgressButNoWarnings) {
  EXPECT_EQ(said([] { note("done"); }), "done\n");
  EXPECT_EQ(said([] { warning("odd"); }), "warning: odd\n");
  EXPECT_EQ(said([] {
              set_quiet(true);
              note("done");
              warning("odd");
              Progress p("work");
              p.update(0.5);
              p.finish("all of it");
            }),
            "warning: odd\n");
}

// In a log (stderr is no terminal here): nothing until a line is due, one line at the end, no control characters.
TEST(Progress, SpeaksSparinglyInALog) {
  const std::string text = said([] {
    Progress p("pack");
    for (int i = 0; i < 1000; ++i) p.update(i / 1000.0, "detail");
    p.finish("10 particles");
    p.finish("twice");
  });
  EXPECT_EQ(text, "pack: done in 0 s, 10 particles\n");
}

}  // namespace
}  // namespace pigment
