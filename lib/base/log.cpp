#include "base/log.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pigment {
namespace {

bool quiet_ = false;
bool bar_on_screen_ = false;  // a bar stands on the terminal's current line

constexpr double terminal_period = 0.2;  // s between redraws of the bar
constexpr double log_period = 20;        // s between lines of a log

void write_line(const std::string& text) {
  if (bar_on_screen_) std::fputs("\r\033[K", stderr);
  bar_on_screen_ = false;
  std::fputs((text + "\n").c_str(), stderr);
  std::fflush(stderr);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds > 100 * 24 * 3600.0) return "long";
  const auto s = static_cast<long>(std::lround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
  return fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

double seconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

void set_quiet(bool quiet) { quiet_ = quiet; }

void note(const std::string& text) {
  if (!quiet_) write_line(text);
}

void warning(const std::string& text) { write_line("warning: " + text); }

Progress::Progress(std::string what)
    : what_(std::move(what)),
      begin_(std::chrono::steady_clock::now()),
      last_(begin_),
      terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (open_ && bar_on_screen_) {  // left by an exception: keep the last state readable above its message
    std::fputs("\n", stderr);
    bar_on_screen_ = false;
  }
}

void Progress::start_at(double fraction) {
  first_fraction_ = fraction;
  begin_ = last_ = std::chrono::steady_clock::now();
}

void Progress::update(double fraction, const std::string& detail) {
  if (quiet_ || !open_) return;
  const auto now = std::chrono::steady_clock::now();
  if (seconds_between(last_, now) < (terminal_ ? terminal_period : log_period)) return;
  last_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double spent = seconds_between(begin_, now), done = fraction - first_fraction_;
  const std::string pace = done > 0 ? fmt::format("{:.3g} %/min, {} left", 100 * done / spent * 60,
                                                  duration_text(spent * (1 - fraction) / done))
                                    : "starting";
  const std::string tail = detail.empty() ? "" : ", " + detail;
  if (terminal_) {
    constexpr int width = 24;
    const int filled = static_cast<int>(fraction * width);
    std::fputs(fmt::format("\r\033[K{} [{}{}] {:3.0f} %, {}{}", what_, std::string(filled, '#'),
                           std::string(width - filled, '.'), std::floor(100 * fraction), pace, tail)
                   .c_str(),
               stderr);
    std::fflush(stderr);
    bar_on_screen_ = true;
  } else {
    write_line(fmt::format("{}: {:.1f} %, {}{}", what_, 100 * fraction, pace, tail));
  }
}

void Progress::finish(const std::string& detail) {
  if (!open_) return;
  open_ = false;
  if (quiet_) return;
  const double spent = seconds_between(begin_, std::chrono::steady_clock::now());
  write_line(fmt::format("{}: done in {}{}", what_, duration_text(spent), detail.empty() ? "" : ", " + detail));
}

}  // namespace pigment
