#include "io/trajectory_writer.h"

#include <bit>
#include <cmath>
#include <limits>

#include "io/checkpoint_file.h"
#include "io/h5.h"
#include "lib/io/io_test_support.h"

namespace pigment::io {
namespace {

using namespace test;
namespace fs = std::filesystem;

const std::vector<ObservableInfo> observables{{"thickness", Dimension::Length},
                                              {"contacts", Dimension::Number}};
const Provenance provenance{"pigment-consolidate", "seed: 1\n", {{"packing", "hash"}}};

Layer first_layer() {
  Layer layer;
  layer.cell = {4, 4, 10};
  layer.particles = {{0.5, 0.25}, {0.1, 0.2}, {0, 0}, {0, 1}};
  layer.position = {{1, 1, 1}, {2, 2, 2}};
  return layer;
}
Frame frame_at(int i) {
  Frame frame;
  frame.step = 10 * i;
  frame.time = 0.1 * i;
  frame.cell = {4, 4, 10 - 0.1 * i};
  const double x = std::sqrt(i + 2.0);
  frame.position = {{1 + x, 1, 1}, {2, 2 - x, 2}};
  frame.velocity = {{x, 0, 0}, {0, -x, 0}};
  if (i > 0) frame.angular_velocity = {{0, 0, 1e-3 * x}, {0, 0, 0}};
  return frame;
}
TrajectoryWriter open(const fs::path& output, std::size_t keep = 0) {
  return TrajectoryWriter(output, first_layer(), {"pigment"}, observables, provenance, keep);
}
void append(TrajectoryWriter& writer, int first, int last) {
  for (int i = first; i < last; ++i) writer.append(frame_at(i), {10 - 0.1 * i, static_cast<double>(i)});
}

TEST(TrajectoryWriter, FramesComeBackAsTheyWereWritten) {
  const fs::path output = fresh_folder() / "trajectory.h5";
  TrajectoryWriter writer = open(output);
  append(writer, 0, 50);
  EXPECT_FALSE(fs::exists(output)) << "nothing may stand under the final name before the end";
  writer.finish("immobile");
  EXPECT_FALSE(fs::exists(output.parent_path() / "trajectory.frames.part"));
  const ParticleFile file(output);
  EXPECT_EQ(file.outcome(), "immobile");
  ASSERT_EQ(file.frame_count(), 50u);
  EXPECT_EQ(file.observable_names(), (std::vector<std::string>{"contacts", "thickness"}));
  for (int i = 0; i < 50; ++i) {
    const Frame read = file.frame(static_cast<std::size_t>(i)), written = frame_at(i);
    EXPECT_EQ(read.step, written.step);
    EXPECT_DOUBLE_EQ(read.time, written.time);
    EXPECT_DOUBLE_EQ(read.cell.height, written.cell.height);
    for (std::size_t p = 0; p < 2; ++p)
      for (int k = 0; k < 3; ++k) {
        EXPECT_DOUBLE_EQ(read.position[p][k], written.position[p][k]);
        EXPECT_FLOAT_EQ(static_cast<float>(read.velocity[p][k]), static_cast<float>(written.velocity[p][k]));
      }
    EXPECT_FLOAT_EQ(static_cast<float>(read.angular_velocity[0].z()),
                    static_cast<float>(i > 0 ? 1e-3 * std::sqrt(i + 2.0) : 0));
    EXPECT_DOUBLE_EQ(file.observable("thickness").at(static_cast<std::size_t>(i)), 10 - 0.1 * i);
  }
  EXPECT_EQ(file.observable_time("contacts").size(), 50u);
  EXPECT_TRUE(file.observable("absent").empty());
  // The box changes with time: its schedule is position's own (H5MD 1.1).
  const h5::InputFile raw(output);
  EXPECT_EQ(raw.doubles("/particles/layer/box/edges/time"), raw.doubles("/particles/layer/position/time"));
  EXPECT_EQ(raw.type("/particles/layer/velocity/value"), h5::Type::Float32);
  EXPECT_EQ(raw.type("/particles/layer/position/value"), h5::Type::Float64);
}

TEST(TrajectoryWriter, ABrokenRunGivesTheBytesOfAnUnbrokenOne) {
  const fs::path folder = fresh_folder();
  {
    TrajectoryWriter whole = open(folder / "whole.h5");
    append(whole, 0, 30);
    whole.finish("until");
  }
  const fs::path output = folder / "broken.h5", journal = folder / "broken.frames.part";
  {
    TrajectoryWriter writer = open(output);
    append(writer, 0, 12);
  }
  // Killed while the thirteenth frame was being written: any length of it may be there.
  std::string bytes = bytes_of(journal);
  const std::size_t record = (bytes.size() - 80 - 64) / 12;
  put_bytes(journal, bytes + bytes.substr(bytes.size() - record, record - 5));
  {
    TrajectoryWriter writer = open(output, 12);
    EXPECT_EQ(writer.frame_count(), 12u);
    append(writer, 12, 20);
  }
  {  // The checkpoint is older than the journal: the frames after it are made again.
    TrajectoryWriter writer = open(output, 9);
    EXPECT_EQ(writer.frame_count(), 9u);
    append(writer, 9, 30);
    writer.finish("until");
  }
  EXPECT_EQ(bytes_of(output), bytes_of(folder / "whole.h5"));
}

TEST(TrajectoryWriter, EveryCutOfTheJournalIsNoticed) {
  const fs::path output = fresh_folder() / "t.h5", journal = output.parent_path() / "t.frames.part";
  {
    TrajectoryWriter writer = open(output);
    append(writer, 0, 3);
  }
  const std::string bytes = bytes_of(journal);
  for (std::size_t cut = 0; cut < bytes.size(); cut += 11) {
    put_bytes(journal, bytes.substr(0, cut));
    EXPECT_EQ(message_of([&] { open(output, 3); }).substr(0, 2), "3 ") << cut;
  }
  for (std::size_t at = 0; at < bytes.size(); at += 5) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    put_bytes(journal, changed);
    EXPECT_EQ(message_of([&] { open(output, 3); }).substr(0, 2), "3 ") << "byte " << at;
  }
  put_bytes(journal, bytes);
  EXPECT_EQ(message_of([&] { open(output, 3); }), "no error");
  expect_contains(message_of([&] { open(output, 4); }),
                  "holds 3 whole frames, the checkpoint goes on from 4; --restart");
  fs::remove(journal);
  expect_contains(message_of([&] { open(output, 3); }), "is missing");
}

TEST(TrajectoryWriter, DoesNotGoOnFromAnotherRunsJournal) {
  const fs::path output = fresh_folder() / "t.h5";
  {
    TrajectoryWriter writer = open(output);
    append(writer, 0, 2);
  }
  Layer other = first_layer();
  other.particles.radius[0] *= 1 + 1e-15;
  const std::string refusal =
      message_of([&] { TrajectoryWriter(output, other, {"pigment"}, observables, provenance, 2); });
  expect_contains(refusal, "belongs to another run");
  TrajectoryWriter anew(output, other, {"pigment"}, observables, provenance);
  EXPECT_EQ(anew.frame_count(), 0u);
  expect_contains(message_of([&] { open(output); }), "4 ");  // two at once
}

TEST(TrajectoryWriter, AFailedRunLeavesItsFramesUnderAnotherName) {
  const fs::path folder = fresh_folder(), output = folder / "t.h5";
  TrajectoryWriter writer = open(output);
  append(writer, 0, 4);
  writer.finish_failed("the step fell below 1e-12 s");
  EXPECT_FALSE(fs::exists(output));
  EXPECT_TRUE(fs::exists(folder / "t.frames.part"));
  const ParticleFile file(folder / "t.failed.h5");
  EXPECT_EQ(file.outcome(), "failed");
  EXPECT_EQ(file.frame_count(), 4u);
  EXPECT_EQ(h5::InputFile(folder / "t.failed.h5").text_attribute("/pigment", "reason"),
            "the step fell below 1e-12 s");
  writer.finish("until");
  EXPECT_FALSE(fs::exists(folder / "t.failed.h5"));
}

TEST(TrajectoryWriter, WritesNothingThatIsNotFinite) {
  const fs::path output = fresh_folder() / "t.h5";
  TrajectoryWriter writer = open(output);
  append(writer, 0, 1);
  Frame frame = frame_at(1);
  frame.position[1].y() = std::nan("");
  expect_contains(message_of([&] {
                    writer.append(frame, {1, 1});
                  }),
                  "1 step 10, time 0.0001 s: the position of the particle with id 1");
  frame = frame_at(1);
  frame.velocity[0].x() = 1e60;  // finite, but not in 32 bits
  expect_contains(message_of([&] {
                    writer.append(frame, {1, 1});
                  }),
                  "the velocity of the particle with id 0");
  expect_contains(message_of([&] {
                    writer.append(frame_at(1), {1, std::numeric_limits<double>::infinity()});
                  }),
                  "contacts");
  EXPECT_EQ(writer.frame_count(), 1u);
}

TEST(Checkpoint, ComesBackToTheBit) {
  const fs::path output = fresh_folder() / "t.h5";
  Checkpoint checkpoint;
  checkpoint.arrays["position"] = {0.1, -0.0, 5e-324, 1.7976931348623157e308, std::sqrt(2.0)};
  checkpoint.arrays["nothing"] = {};
  checkpoint.integers["step"] = {std::numeric_limits<std::int64_t>::max(), -1};
  checkpoint.inputs = {{"scene", "a"}, {"packing", "b"}};
  write_checkpoint(output, checkpoint);
  EXPECT_TRUE(fs::exists(output.parent_path() / "t.checkpoint.h5"));
  const auto back = read_checkpoint(output, checkpoint.inputs);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->integers, checkpoint.integers);
  ASSERT_EQ(back->arrays.at("position").size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back->arrays.at("position")[i]),
              std::bit_cast<std::uint64_t>(checkpoint.arrays.at("position")[i]));
  EXPECT_TRUE(back->arrays.at("nothing").empty());
}

TEST(Checkpoint, FallsBackToThePreviousOne) {
  const fs::path folder = fresh_folder(), output = folder / "t.h5", newest = folder / "t.checkpoint.h5";
  const std::map<std::string, std::string> inputs{{"scene", "a"}};
  EXPECT_FALSE(read_checkpoint(output, inputs).has_value());
  for (int i = 1; i <= 3; ++i) write_checkpoint(output, {{{"time", {static_cast<double>(i)}}}, {}, inputs});
  EXPECT_EQ(read_checkpoint(output, inputs)->arrays.at("time"), std::vector<double>{3});
  put_bytes(newest, bytes_of(newest).substr(0, 300));
  testing::internal::CaptureStderr();
  EXPECT_EQ(read_checkpoint(output, inputs)->arrays.at("time"), std::vector<double>{2});
  expect_contains(testing::internal::GetCapturedStderr(), "t.checkpoint.h5");
  fs::remove(newest);  // killed between the two renames
  EXPECT_EQ(read_checkpoint(output, inputs)->arrays.at("time"), std::vector<double>{2});
  remove_checkpoint(output);
  EXPECT_TRUE(fs::is_empty(folder));
}

// What a process killed while it wrote a checkpoint leaves behind goes with the checkpoints.
TEST(Checkpoint, TakesItsLeftoversAlong) {
  const fs::path folder = fresh_folder(), output = folder / "t.h5";
  write_checkpoint(output, {{}, {}, {{"scene", "a"}}});
  put_bytes(folder / "t.checkpoint.new.h5.part", "half a file");
  remove_checkpoint(output);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Checkpoint, OfOtherInputsIsSetAside) {
  const fs::path folder = fresh_folder(), output = folder / "t.h5";
  for (int i = 1; i <= 2; ++i) write_checkpoint(output, {{}, {}, {{"scene", "a"}, {"packing", "p"}}});
  testing::internal::CaptureStderr();
  EXPECT_FALSE(read_checkpoint(output, {{"scene", "a"}, {"packing", "q"}}).has_value());
  expect_contains(testing::internal::GetCapturedStderr(), "packing has changed");
  EXPECT_TRUE(fs::exists(folder / "t.checkpoint.old.h5"));
  EXPECT_FALSE(fs::exists(folder / "t.checkpoint.h5"));
  EXPECT_FALSE(read_checkpoint(output, {{"scene", "a"}, {"packing", "p"}}).has_value());
}

TEST(Checkpoint, GoesWhenTheTrajectoryIsWhole) {
  const fs::path folder = fresh_folder(), output = folder / "t.h5";
  TrajectoryWriter writer = open(output);
  append(writer, 0, 1);
  write_checkpoint(output, {});
  write_checkpoint(output, {});
  writer.finish("until");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

}  // namespace
}  // namespace pigment::io
