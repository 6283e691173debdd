#include "stepping/run_state.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

using namespace pigment;
using stepping::RunState;

namespace {

// Numbers that a text or a unit conversion would spoil.
double awkward(int k) {
  const double values[] = {1.0 / 3, -0.0, std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::max(),
                           std::nextafter(1.0, 2.0), 6.02214076e23, -1e-300};
  return k % 8 == 7 ? 0.1 * k : values[k % 8 % 7];
}

Vec3Array vectors(int n, int first) {
  Vec3Array v;
  for (int k = 0; k < n; ++k) v.emplace_back(awkward(first + 3 * k), awkward(first + 3 * k + 1), awkward(first + 3 * k + 2));
  return v;
}

RunState full_state() {
  RunState s;
  s.step = (std::int64_t{1} << 53) + 1;  // not a double
  s.frame = 17;
  s.time = 1.0 / 3;
  s.preferred_step = 0.1;
  s.last_step = std::nextafter(0.1, 1.0);
  s.previous_step = std::nextafter(0.1, 1.0) * 2;
  s.end_pressure = {std::nextafter(0.2, 1.0), 1.0 / 3, -1e-9};
  s.position = vectors(5, 0);
  s.velocity = vectors(5, 1);
  s.angular_velocity = vectors(5, 2);
  s.previous_velocity = vectors(5, 3);
  s.previous_angular_velocity = vectors(5, 4);
  s.protrusion = {awkward(0), awkward(1), awkward(2), awkward(3), awkward(4)};
  s.list_reference = vectors(5, 5);
  s.list_temperature = 301.7;
  s.frame_position = vectors(5, 6);
  s.frame_height = 24.9;
  s.surface_height = awkward(4);
  s.surface_velocity = awkward(5);
  s.solver = {true, 171};
  for (int r = 0; r < 3; ++r) {
    Redistribution part;
    for (int b = 0; b < redistribution_slices; ++b) part.residual.push_back(awkward(r + b));
    part.fall = awkward(r + 3);
    part.height = awkward(r + 4);
    s.redistribution.push_back(part);
  }
  s.mass_centre = {1.5, 1.0 / 3};
  s.interval = {1, awkward(1), awkward(2)};
  return s;
}

bool same(double a, double b) { return std::bit_cast<std::int64_t>(a) == std::bit_cast<std::int64_t>(b); }
bool same(std::int64_t a, std::int64_t b) { return a == b; }
bool same(const Vec3& a, const Vec3& b) { return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z()); }
template <typename Container>
bool same(const Container& a, const Container& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return same(x, y); });
}
bool same(const Redistribution& a, const Redistribution& b) { return same(a.residual, b.residual) && same(a.fall, b.fall) && same(a.height, b.height); }

// Every member: one that is added and forgotten here does not compile.
void expect_same(const RunState& a, const RunState& b) {
  const auto& [step, frame, time, preferred_step, last_step, previous_step, position, velocity, angular_velocity, previous_velocity,
               previous_angular_velocity, surface_height, surface_velocity, end_pressure, solver, protrusion, list_reference, list_temperature, frame_position, frame_height,
               redistribution, mass_centre, interval] = a;
  EXPECT_TRUE(same(step, b.step) && same(frame, b.frame));
  EXPECT_TRUE(same(time, b.time) && same(preferred_step, b.preferred_step) && same(last_step, b.last_step) && same(previous_step, b.previous_step));
  EXPECT_TRUE(same(position, b.position));
  EXPECT_TRUE(same(velocity, b.velocity));
  EXPECT_TRUE(same(angular_velocity, b.angular_velocity));
  EXPECT_TRUE(same(previous_velocity, b.previous_velocity));
  EXPECT_TRUE(same(previous_angular_velocity, b.previous_angular_velocity));
  EXPECT_TRUE(same(surface_height, b.surface_height) && same(surface_velocity, b.surface_velocity));
  EXPECT_TRUE(same(end_pressure, b.end_pressure));
  EXPECT_TRUE(same(protrusion, b.protrusion));
  EXPECT_TRUE(same(list_reference, b.list_reference) && same(list_temperature, b.list_temperature));
  EXPECT_TRUE(same(frame_position, b.frame_position) && same(frame_height, b.frame_height));
  EXPECT_EQ(solver, b.solver);
  ASSERT_EQ(redistribution.size(), b.redistribution.size());
  for (std::size_t k = 0; k < redistribution.size(); ++k) EXPECT_TRUE(same(redistribution[k], b.redistribution[k]));
  EXPECT_TRUE(same(mass_centre, b.mass_centre));
  EXPECT_TRUE(same(interval, b.interval));
}

}  // namespace

TEST(RunState, ComesBackToTheBit) {
  const RunState s = full_state();
  expect_same(s, RunState::from(s.arrays(), s.integers()));
}

TEST(RunState, ComesBackEmptyWhereItWasEmpty) {
  const RunState s;
  expect_same(s, RunState::from(s.arrays(), s.integers()));
}
