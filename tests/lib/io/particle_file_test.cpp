#include "io/particle_file.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "io/h5.h"
#include "lib/io/io_test_support.h"

namespace pigment::io {
namespace {

using namespace test;
namespace fs = std::filesystem;

Layer example_layer() {
  Layer layer;
  layer.cell = {5, 5.5, 25.25};
  layer.particles.radius = {0.5, 0.25, 1};
  layer.particles.mass = {0.1, 0.2, 0.3};
  layer.particles.species = {0, 1, 0};
  layer.particles.id = {7, 3, 100};
  layer.position = {{1, 2, 3}, {-4.5, 1e-3, 20.125}, {12, 2, 10}};
  return layer;
}

// A file as somebody would make it with a few lines of h5py: nothing but what must be there, SI without
// units.
struct ByHand {
  h5::Extent position_shape{2, 3}, edges_shape{3};
  std::vector<double> position{1e-6, 1e-6, 1e-6, 3e-6, 3e-6, 2e-6}, edges{5e-6, 6e-6, 10e-6},
      radius{0.5e-6, 0.25e-6};
  std::string position_path = "/particles/layer/position", edges_path = "/particles/layer/box/edges";

  fs::path write(const std::function<void(h5::OutputFile&)>& more = {}) const {
    const fs::path name = fresh_folder() / "by_hand.h5";
    h5::OutputFile file(name);
    file.write(position_path, position_shape, position.data());
    file.write(edges_path, edges_shape, edges.data());
    file.write("/particles/layer/radius", {radius.size()}, radius.data());
    if (more) more(file);
    file.commit();
    return name;
  }
  std::string refusal() const {
    const fs::path name = write();
    return message_of([&] { ParticleFile file(name); });
  }
};

TEST(ParticleFile, PackingComesBackAsItWasWritten) {
  const fs::path name = fresh_folder() / "packing.h5";
  const Layer layer = example_layer();
  const Provenance provenance{"pigment-pack", "seed: 1\n", {{"size table", "abc"}}};
  write_packing(name, layer, {"pigment", "latex"},
                {{"/packing/profile", {2}, {0.4, 0.5}, Dimension::VolumeFraction, Dataset::Storage::Float64}},
                provenance);
  const ParticleFile file(name);
  EXPECT_EQ(file.particle_count(), 3u);
  EXPECT_EQ(file.frame_count(), 1u);
  EXPECT_TRUE(file.has_mass());
  EXPECT_EQ(file.species_names(), (std::vector<std::string>{"pigment", "latex"}));
  EXPECT_EQ(file.particles().id, layer.particles.id);
  EXPECT_EQ(file.particles().species, layer.particles.species);
  EXPECT_EQ(file.outcome(), "");
  EXPECT_EQ(file.provenance().scene, provenance.scene);
  EXPECT_EQ(file.provenance().inputs, provenance.inputs);
  const Layer back = file.layer();
  // SI and back is one rounding each way.
  EXPECT_DOUBLE_EQ(back.cell.width_x, 5);
  EXPECT_DOUBLE_EQ(back.cell.width_y, 5.5);
  EXPECT_DOUBLE_EQ(back.cell.height, 25.25);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(back.particles.radius[i], layer.particles.radius[i]);
    EXPECT_DOUBLE_EQ(back.particles.mass[i], layer.particles.mass[i]);
    for (int k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(back.position[i][k], layer.position[i][k]);
  }
  EXPECT_TRUE(file.frame(0).velocity.empty());
  EXPECT_EQ(file.frame(0).time, 0);
}

// What is read and written again stays the same to the bit, so that frame 0 of a trajectory is the packing as
// given.
TEST(ParticleFile, WritingWhatWasReadChangesNoBit) {
  const fs::path folder = fresh_folder();
  Layer layer = example_layer();
  layer.particles = {};
  layer.position.clear();
  for (int i = 0; i < 3000; ++i) {
    layer.particles.radius.push_back(0.001);
    layer.particles.mass.push_back(1e-3 * std::sqrt(i + 1.0));
    layer.particles.species.push_back(0);
    layer.particles.id.push_back(i);
    layer.position.emplace_back(5 * std::sin(i * 1.0), 3 * std::cos(i * 1.7),
                                1 + std::fmod(i * 0.61803398875, 24.0));
  }
  write_packing(folder / "a.h5", layer, {}, {}, {});
  const ParticleFile first(folder / "a.h5");
  write_packing(folder / "b.h5", first.layer(), {}, {}, {});
  EXPECT_EQ(bytes_of(folder / "a.h5"), bytes_of(folder / "b.h5"));
}

TEST(ParticleFile, FollowsH5md) {
  const fs::path name = fresh_folder() / "packing.h5";
  write_packing(name, example_layer(), {"pigment"}, {}, {"pigment-pack", "", {}});
  const h5::InputFile raw(name);
  EXPECT_EQ(raw.number_attribute("/h5md", "version"), (std::vector<double>{1, 1}));
  EXPECT_TRUE(raw.text_attribute("/h5md/author", "name").has_value());
  EXPECT_EQ(raw.text_attribute("/h5md/creator", "name"), "pigment-pack");
  EXPECT_TRUE(raw.text_attribute("/h5md/creator", "version").has_value());
  EXPECT_EQ(raw.number_attribute("/particles/layer/box", "dimension"), std::vector<double>{3});
  EXPECT_EQ(raw.texts_attribute("/particles/layer/box", "boundary"),
            (std::vector<std::string>{"periodic", "periodic", "none"}));
  EXPECT_EQ(raw.shape("/particles/layer/position/value"), (h5::Extent{1, 3, 3}));
  EXPECT_EQ(raw.shape("/particles/layer/box/edges/value"), (h5::Extent{1, 3}));
  EXPECT_EQ(raw.type("/particles/layer/position/step"), h5::Type::Int64);
  EXPECT_EQ(raw.text_attribute("/particles/layer/position/value", "unit"), "m");
  EXPECT_EQ(raw.text_attribute("/particles/layer/position/time", "unit"), "s");
  EXPECT_EQ(raw.text_attribute("/particles/layer/mass", "unit"), "kg");
  EXPECT_EQ(raw.doubles("/particles/layer/radius"), (std::vector<double>{0.5e-6, 0.25e-6, 1e-6}));
}

TEST(ParticleFile, BoxPositionAndRadiusAreEnough) {
  const ParticleFile file(ByHand{}.write());
  EXPECT_EQ(file.particle_count(), 2u);
  EXPECT_EQ(file.frame_count(), 1u);
  EXPECT_FALSE(file.has_mass());
  EXPECT_EQ(file.particles().mass, (std::vector<double>{0, 0}));
  EXPECT_EQ(file.particles().id, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(file.particles().species, (std::vector<int>{0, 0}));
  EXPECT_TRUE(file.species_names().empty());
  EXPECT_DOUBLE_EQ(file.layer().position[1].z(), 2);
  EXPECT_DOUBLE_EQ(file.layer().cell.width_y, 6);
}

TEST(ParticleFile, TakesEdgesAndPositionsInAnyOfTheirForms) {
  const auto check = [](const ByHand& hand, std::size_t frames, double last_height) {
    const ParticleFile file(hand.write());
    EXPECT_EQ(file.frame_count(), frames);
    const Frame last = file.frame(frames - 1);
    EXPECT_DOUBLE_EQ(last.cell.width_x, 5);
    EXPECT_DOUBLE_EQ(last.cell.width_y, 6);
    EXPECT_DOUBLE_EQ(last.cell.height, last_height);
  };
  ByHand hand;
  hand.edges_shape = {3, 3};
  hand.edges = {5e-6, 0, 0, 0, 6e-6, 0, 0, 0, 10e-6};
  check(hand, 1, 10);
  hand.edges_path += "/value";
  check(hand, 1, 10);
  hand.edges_shape = {1, 3, 3};
  check(hand, 1, 10);
  hand.edges_shape = {1, 3};
  hand.edges = {5e-6, 6e-6, 10e-6};
  check(hand, 1, 10);

  hand.position_path += "/value";
  check(hand, 1, 10);
  hand.position_shape = {3, 2, 3};
  for (int copy = 0; copy < 2; ++copy)
    for (int i = 0; i < 6; ++i) hand.position.push_back(hand.position[static_cast<std::size_t>(i)] + 1e-7);
  check(hand, 3, 10);
  hand.edges_shape = {3};
  check(hand, 3, 10);
  // Three frames of three edges, which is not a matrix.
  hand.edges_shape = {3, 3};
  hand.edges = {5e-6, 6e-6, 10e-6, 5e-6, 6e-6, 9e-6, 5e-6, 6e-6, 8e-6};
  check(hand, 3, 8);
  hand.edges = {5e-6, 0, 0, 0, 6e-6, 0, 0, 0, 10e-6};
  check(hand, 3, 10);
  hand.edges_shape = {3, 3, 3};
  for (int copy = 0; copy < 2; ++copy)
    for (std::size_t i = 0; i < 9; ++i) hand.edges.push_back(hand.edges[i]);
  hand.edges.back() = 7e-6;
  check(hand, 3, 7);
}

TEST(ParticleFile, ConvertsUnitsOfTheRightDimension) {
  ByHand hand;
  hand.position = {1, 1, 1, 3, 3, 2};
  hand.radius = {500, 250};
  const double mass[] = {1, 2}, time[] = {4};
  const auto units = [&](const std::string& unit_of_radius) {
    return [&mass, &time, unit_of_radius](h5::OutputFile& file) {
      file.attribute("/particles/layer/position/value", "unit", std::string("um"));
      file.attribute("/particles/layer/radius", "unit", unit_of_radius);
      file.write("/particles/layer/mass", {2}, mass);
      file.attribute("/particles/layer/mass", "unit", std::string("pg"));
      file.write("/particles/layer/position/time", {1}, time);
      file.attribute("/particles/layer/position/time", "unit", std::string("ms"));
    };
  };
  hand.position_path += "/value";
  hand.position_shape = {1, 2, 3};
  const ParticleFile file(hand.write(units("nm")));
  EXPECT_DOUBLE_EQ(file.layer().position[1].x(), 3);
  EXPECT_DOUBLE_EQ(file.particles().radius[1], 0.25);
  EXPECT_DOUBLE_EQ(file.particles().mass[1], 2e-3);  // 1 pg = 1e-15 kg = 1e-3 engine units
  EXPECT_DOUBLE_EQ(file.frame(0).time, 4);
  const fs::path wrong = hand.write(units("kg"));
  const std::string refusal = message_of([&] { ParticleFile again(wrong); });
  expect_contains(
      refusal, "3 " + wrong.string() + ": /particles/layer/radius: its unit \"kg\" is not a unit of length");
}

TEST(ParticleFile, SaysWhatIsWrongWithAFileMadeByHand) {
  ByHand hand;
  hand.position[5] = 0;
  expect_contains(hand.refusal(), "particle 1 (id 1) is centred at z = 0 m");
  hand = {};
  hand.position[3] = std::nan("");
  expect_contains(hand.refusal(), "/particles/layer/position: entry 3");
  hand = {};
  hand.radius[0] = -0.5e-6;
  expect_contains(hand.refusal(), "/particles/layer/radius: entry 0 is -5e-07 m, expected a positive radius");
  hand = {};
  hand.radius.push_back(1e-6);
  expect_contains(hand.refusal(), "/particles/layer/radius: its shape is [3], expected [2]");
  hand = {};
  hand.position_shape = {3, 2};
  expect_contains(hand.refusal(), "/particles/layer/position: its shape is [3, 2], expected [N, 3]");
  hand = {};
  hand.position_shape = {6};
  expect_contains(hand.refusal(), "/particles/layer/position: its shape is [6]");
  hand = {};
  hand.edges[2] = 0;
  expect_contains(hand.refusal(), "not all positive");
  hand = {};
  hand.edges_shape = {3, 3};
  hand.edges = {5e-6, 1e-6, 0, 0, 6e-6, 0, 0, 0, 10e-6};
  expect_contains(hand.refusal(), "the box is not rectangular");
  hand = {};
  hand.edges_shape = {2};
  hand.edges = {5e-6, 6e-6};
  expect_contains(hand.refusal(), "/particles/layer/box/edges: its shape is [2]");
  hand = {};
  hand.position_path = "/particles/layer/positions";
  expect_contains(hand.refusal(), "/particles/layer/position: is missing; there is box, positions, radius");
  hand = {};
  hand.position_path = "/particles/all/position";
  hand.edges_path = "/particles/layer/box/edge";
  expect_contains(hand.refusal(), "/particles/layer/position: is missing");
}

TEST(ParticleFile, RefusesDoubledNamesAndShapesThatDoNotFit) {
  const std::int64_t ids[] = {4, 4};
  fs::path name = ByHand{}.write([&](h5::OutputFile& f) { f.write("/particles/layer/id", {2}, ids); });
  expect_contains(message_of([&] { ParticleFile file(name); }),
                  "/particles/layer/id: entry 1 is 4, which another");
  const std::int64_t species[] = {0, -1};
  name = ByHand{}.write([&](h5::OutputFile& f) { f.write("/particles/layer/species", {2}, species); });
  expect_contains(message_of([&] { ParticleFile file(name); }), "/particles/layer/species: entry 1 is -1");
  const double velocity[] = {1, 2, 3};
  name = ByHand{}.write([&](h5::OutputFile& f) { f.write("/particles/layer/velocity", {1, 3}, velocity); });
  expect_contains(message_of([&] { ParticleFile file(name); }),
                  "/particles/layer/velocity: its shape is [1, 3]");
}

TEST(ParticleFile, WarnsOfOverlapsAndGoesOn) {
  ByHand hand;
  hand.position = {0.1e-6, 1e-6, 1e-6,
                   4.9e-6, 1e-6, 1e-6};  // 0.2 um apart through the periodic side, radii 0.5 and 0.25
  testing::internal::CaptureStderr();
  const ParticleFile file(hand.write());
  const std::string said = testing::internal::GetCapturedStderr();
  expect_contains(said, "1 pair of particles overlaps; the deepest is 550 nm, ids ");
  EXPECT_EQ(file.particle_count(), 2u);
  testing::internal::CaptureStderr();
  const ParticleFile apart(ByHand{}.write());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// Against every pair looked at, in a layer so dense that most particles overlap several others.
TEST(ParticleFile, CountsAllOverlaps) {
  ByHand hand;
  hand.position.clear();
  hand.radius.clear();
  hand.position_shape = {300, 3};
  const double edges[] = {5e-6, 6e-6, 4e-6};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(0, 1);
  for (int k = 0; k < 300; ++k) {
    for (double edge : edges) hand.position.push_back(1e-9 + edge * along(random));
    hand.radius.push_back(0.1e-6 + 0.4e-6 * along(random));
  }
  int expected = 0;
  for (std::size_t a = 0; a < hand.radius.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      double squared = 0;
      for (std::size_t d = 0; d < 3; ++d) {
        double apart = std::abs(hand.position[3 * a + d] - hand.position[3 * b + d]);
        if (d < 2) apart = std::min(apart, edges[d] - apart);
        squared += apart * apart;
      }
      expected += std::sqrt(squared) < hand.radius[a] + hand.radius[b];
    }
  ASSERT_GT(expected, 300);
  testing::internal::CaptureStderr();
  const ParticleFile file(hand.write());
  expect_contains(testing::internal::GetCapturedStderr(), std::to_string(expected) + " pairs of particles overlap; ");
}

TEST(ParticleFile, RefusesDamageAndOtherKinds) {
  const fs::path folder = fresh_folder(), name = folder / "packing.h5";
  Layer layer = example_layer();
  write_packing(name, layer, {}, {}, {});
  const std::string bytes = bytes_of(name);
  for (const double part : {0.1, 0.5, 0.9, 0.999}) {
    put_bytes(folder / "cut.h5",
              bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
    EXPECT_THROW(ParticleFile(folder / "cut.h5"), FileError) << part;
  }
  ResultFile result;
  result.kind = "dewatering";
  write_result(folder / "dewatering.h5", result);
  expect_contains(message_of([&] { ParticleFile file(folder / "dewatering.h5"); }),
                  "is a dewatering file, expected a packing or a trajectory");
}

}  // namespace
}  // namespace pigment::io
