#include "analysis/trajectories.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"

namespace pigment::analysis {

std::vector<std::size_t> choose_particles(const Snapshot& first, const std::vector<double>& radius,
                                          const std::vector<std::int64_t>& id, const Parameters& parameters) {
  std::vector<std::size_t> chosen;
  if (parameters.trajectories) {
    for (const std::int64_t wanted : *parameters.trajectories) {
      const auto found = std::find(id.begin(), id.end(), wanted);
      if (found == id.end())
        throw InputError("analysis.trajectories: no particle has the id " + std::to_string(wanted));
      chosen.push_back(static_cast<std::size_t>(found - id.begin()));
    }
    return chosen;
  }
  const int bands = parameters.height_bands;
  const double band = first.cell.height / bands;
  for (int b = 0; b < bands; ++b) {
    std::optional<std::pair<std::size_t, double>> best;  // size class, distance from the middle
    std::size_t particle = 0;
    for (std::size_t i = 0; i < radius.size(); ++i) {
      const double distance = std::abs(first.position[i].z() - (b + 0.5) * band);
      const std::pair candidate{parameters.size_class(2 * radius[i]), distance};
      if (distance > 0.5 * band || (best && !(candidate < *best))) continue;
      best = candidate;
      particle = i;
    }
    if (best && std::find(chosen.begin(), chosen.end(), particle) == chosen.end()) chosen.push_back(particle);
  }
  return chosen;
}

Trajectories follow_particles(const Frames& frames, const std::vector<std::size_t>& numbers,
                              const std::vector<std::size_t>& particles) {
  Trajectories result;
  result.particle = particles;
  for (const std::size_t k : numbers) {
    const Snapshot frame = frames.read(k);
    result.time.push_back(frame.time);
    result.thickness.push_back(frame.cell.height);
    result.position.emplace_back();
    for (const std::size_t i : particles) result.position.back().push_back(frame.position[i]);
  }
  return result;
}

}  // namespace pigment::analysis
