#pragma once
// Round numbers for axes, colour bars and scale bars; what to show of many times.
#include <string>
#include <vector>

namespace pigment::report {

struct Ticks {
  std::vector<double> values;       // inside [low, high], rising
  std::vector<std::string> labels;  // one each, with no more digits than the step needs
};

// Steps of 1, 2, 2.5 or 5 times a power of ten, about `wanted` of them in [low, high]. low == high gives one
// tick.
Ticks linear_ticks(double low, double high, int wanted);
// Powers of ten, with 2 and 5 between them where the range is short; low > 0.
Ticks logarithmic_ticks(double low, double high);
// The largest of 1, 2 or 5 times a power of ten that is not above `limit`.
double round_below(double limit);
// Shortest text that reads back within `digits` significant digits: "0.25", "12", "1.2e-9", with a true minus
// sign.
std::string number_text(double value, int digits = 3);
// A time in the unit that suits it: "0.12 s", "5 ms", "2 min". ms in.
std::string time_text(double milliseconds);

// Entries to show out of a list of rising times: first, last, and those nearest to equal steps of time
// between.
std::vector<std::size_t> evenly_in_time(const std::vector<double>& time, std::size_t wanted);

}  // namespace pigment::report
