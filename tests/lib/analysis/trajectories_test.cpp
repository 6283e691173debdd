#include "analysis/trajectories.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace pigment::analysis {
namespace {

// Two bands of 5 um: fine particles at 1, 2 (band 0) and none in band 1; coarse ones at 2.5 and 6, 7.6. All drift.
Frames drifting() {
  return {5, [](std::size_t k) {
            Snapshot s;
            s.time = 2.0 * static_cast<double>(k);
            s.cell = {10, 10, 10 - 0.5 * static_cast<double>(k)};
            const double x = 3.0 * static_cast<double>(k);
            s.position = {{x, 1, 1}, {x, 2, 2}, {x, 3, 2.5}, {x, 4, 6}, {x, 5, 7.6}};
            return s;
          }};
}
const std::vector<double> radius{0.125, 0.125, 0.4, 0.4, 0.4};
const std::vector<std::int64_t> id{10, 20, 30, 40, 50};

TEST(Trajectories, FollowParticlesById) {
  Parameters parameters;
  parameters.trajectories = std::vector<std::int64_t>{40, 10};
  const auto chosen = choose_particles(drifting().read(0), radius, id, parameters);
  EXPECT_EQ(chosen, (std::vector<std::size_t>{3, 0}));
  const Trajectories t = follow_particles(drifting(), {1, 2, 4}, chosen);
  EXPECT_EQ(t.time, (std::vector<double>{2, 4, 8}));
  EXPECT_EQ(t.thickness, (std::vector<double>{9.5, 9, 8}));
  EXPECT_EQ(t.position[2][0], Vec3(12, 4, 6));  // unwrapped
  EXPECT_EQ(t.position[2][1], Vec3(12, 1, 1));
}

TEST(Trajectories, ChooseTheFinestOfEachBandThemselves) {
  Parameters parameters;
  parameters.height_bands = 2;
  // Band 0: of the fine ones that nearer to 2.5; band 1: the coarse one nearer to 7.5.
  EXPECT_EQ(choose_particles(drifting().read(0), radius, id, parameters), (std::vector<std::size_t>{1, 4}));
  EXPECT_TRUE(choose_particles({0, {5, 5, 5}, {}}, {}, {}, parameters).empty());
}

TEST(Trajectories, RefuseAnIdThatIsNotThere) {
  Parameters parameters;
  parameters.trajectories = std::vector<std::int64_t>{40, 11};
  EXPECT_THROW(choose_particles(drifting().read(0), radius, id, parameters), InputError);
}

}  // namespace
}  // namespace pigment::analysis
