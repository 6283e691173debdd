#pragma once
// The frames that an analysis looks at, wherever they come from, and the loop over them.
#include <algorithm>
#include <exception>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "model/cell.h"
#include "model/height_field.h"

namespace pigment::analysis {

// Positions at one instant; x and y unwrapped, so that a displacement is a difference.
struct Snapshot {
  double time = 0;  // ms
  Cell cell;
  Vec3Array position;
  std::shared_ptr<const HeightField> substrate = nullptr;  // null: the plane z = 0
  // Volume over area between the substrate and the plane z, um.
  double space_below(double z) const { return substrate ? substrate->space_below(z) : z; }
};

// `read` is called from one thread at a time, with rising numbers below count; positions must be finite.
struct Frames {
  std::size_t count = 0;
  std::function<Snapshot(std::size_t)> read;
};

// work(k) for k below count, side by side; the first exception by number is thrown again at the end.
template <typename Work>
void side_by_side(std::size_t count, const Work& work) {
  std::vector<std::exception_ptr> failures(count);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t k = 0; k < count; ++k) {
    try {
      work(k);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

// measure(snapshot) of every frame, in order. Frames are read one after the other and measured side by side,
// a batch at a time; a result depends on its own frame alone, so the number of threads changes nothing.
template <typename Measure>
auto measure_frames(const Frames& frames, const Measure& measure) {
  using Result = decltype(measure(std::declval<const Snapshot&>()));
  constexpr std::size_t batch = 16;
  std::vector<Result> results(frames.count);
  std::vector<Snapshot> snapshots;
  for (std::size_t first = 0; first < frames.count; first += batch) {
    const std::size_t size = std::min(batch, frames.count - first);
    snapshots.clear();
    for (std::size_t k = 0; k < size; ++k) snapshots.push_back(frames.read(first + k));
    side_by_side(size, [&](std::size_t k) { results[first + k] = measure(snapshots[k]); });
  }
  return results;
}

// measure(before, after) of successive frames out of `numbers` (rising), one result for each but the last.
template <typename Measure>
auto measure_intervals(const Frames& frames, const std::vector<std::size_t>& numbers,
                       const Measure& measure) {
  using Result = decltype(measure(std::declval<const Snapshot&>(), std::declval<const Snapshot&>()));
  constexpr std::size_t batch = 16;
  const std::size_t intervals = numbers.empty() ? 0 : numbers.size() - 1;
  std::vector<Result> results(intervals);
  std::vector<Snapshot> snapshots;  // of the ends of this batch's intervals
  for (std::size_t first = 0; first < intervals; first += batch) {
    const std::size_t size = std::min(batch, intervals - first);
    if (snapshots.empty())
      snapshots.push_back(frames.read(numbers[0]));
    else
      snapshots = {std::move(snapshots.back())};
    for (std::size_t k = 0; k < size; ++k) snapshots.push_back(frames.read(numbers[first + k + 1]));
    side_by_side(size, [&](std::size_t k) { results[first + k] = measure(snapshots[k], snapshots[k + 1]); });
  }
  return results;
}

}  // namespace pigment::analysis
