#pragma once
// Talk goes to stderr, data to files or stdout. Progress shows a bar with rate and time left on a terminal and one
// plain line now and then in a log.
#include <chrono>
#include <string>

namespace pigment {

void set_quiet(bool quiet);           // notes and progress off; warnings stay
void note(const std::string& text);     // what was done, in one line
void warning(const std::string& text);  // what the user should know although the tool goes on

// Progress of one long piece of work, fraction 0..1. Thread-unsafe by design: only the main thread reports.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  // `detail` is a short remark ("t 0.123 s, dt 0.08 ms"); called as often as one likes, it prints when due.
  void update(double fraction, const std::string& detail = {});
  // A resumed run starts its clock at this fraction, so that rate and time left speak of this run.
  void start_at(double fraction);
  void finish(const std::string& detail = {});

 private:
  std::string what_;
  std::chrono::steady_clock::time_point begin_, last_;
  double first_fraction_ = 0;
  bool terminal_ = false, open_ = true;
};

}  // namespace pigment
