#include "stepping/run_state.h"

namespace pigment::stepping {

namespace {

std::vector<double> flat(const Vec3Array& v) {
  std::vector<double> f;
  f.reserve(3 * v.size());
  for (const Vec3& x : v) f.insert(f.end(), {x.x(), x.y(), x.z()});
  return f;
}
Vec3Array vectors(const std::vector<double>& f) {
  Vec3Array v(f.size() / 3);
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = Vec3(f[3 * k], f[3 * k + 1], f[3 * k + 2]);
  return v;
}

}  // namespace

std::map<std::string, std::vector<double>> RunState::arrays() const {
  std::vector<double> redistributions;
  for (const Redistribution& r : redistribution) {
    redistributions.insert(redistributions.end(), {r.fall, r.height});
    redistributions.insert(redistributions.end(), r.residual.begin(), r.residual.end());
  }
  return {{"scalars", {time, preferred_step, last_step, frame_height, list_temperature, surface_height, surface_velocity, previous_step,
                       end_pressure[0], end_pressure[1], end_pressure[2]}},
          {"position", flat(position)},
          {"velocity", flat(velocity)},
          {"angular_velocity", flat(angular_velocity)},
          {"previous_velocity", flat(previous_velocity)},
          {"previous_angular_velocity", flat(previous_angular_velocity)},
          {"protrusion", protrusion},
          {"list_reference", flat(list_reference)},
          {"frame_position", flat(frame_position)},
          {"redistribution", redistributions},
          {"mass_centre", {mass_centre.begin(), mass_centre.end()}},
          {"interval", interval}};
}

std::map<std::string, std::vector<std::int64_t>> RunState::integers() const { return {{"counters", {step, frame, solver.stiff ? 1 : 0, solver.network_cost}}}; }

RunState RunState::from(const std::map<std::string, std::vector<double>>& a,
                        const std::map<std::string, std::vector<std::int64_t>>& i) {
  RunState s;
  const auto& scalars = a.at("scalars");
  s.time = scalars.at(0);
  s.preferred_step = scalars.at(1);
  s.last_step = scalars.at(2);
  s.frame_height = scalars.at(3);
  s.list_temperature = scalars.at(4);
  s.surface_height = scalars.at(5);
  s.surface_velocity = scalars.at(6);
  s.previous_step = scalars.at(7);
  for (std::size_t q = 0; q < 3; ++q) s.end_pressure[q] = scalars.at(8 + q);
  s.step = i.at("counters").at(0);
  s.frame = i.at("counters").at(1);
  s.solver = {i.at("counters").at(2) != 0, static_cast<int>(i.at("counters").at(3))};
  s.position = vectors(a.at("position"));
  s.velocity = vectors(a.at("velocity"));
  s.angular_velocity = vectors(a.at("angular_velocity"));
  s.previous_velocity = vectors(a.at("previous_velocity"));
  s.previous_angular_velocity = vectors(a.at("previous_angular_velocity"));
  s.protrusion = a.at("protrusion");
  s.list_reference = vectors(a.at("list_reference"));
  s.frame_position = vectors(a.at("frame_position"));
  const std::vector<double>& redistributions = a.at("redistribution");
  constexpr std::size_t slices = redistribution_slices, length = 2 + slices;
  for (std::size_t k = 0; k + length <= redistributions.size(); k += length) {
    const auto first = redistributions.begin() + static_cast<std::ptrdiff_t>(k);
    s.redistribution.push_back({{first + 2, first + length}, first[0], first[1]});
  }
  const std::vector<double>& centres = a.at("mass_centre");
  s.mass_centre.assign(centres.begin(), centres.end());
  s.interval = a.at("interval");
  return s;
}

}  // namespace pigment::stepping
