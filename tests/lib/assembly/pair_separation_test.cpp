// Four pairs at a time give what one at a time gives, to the last bit.
#include "assembly/pair_separation.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace pigment::assembly {
namespace {

const Cell cell{6, 5, 8};
constexpr std::size_t particles = 90;

Vec3 at(const Sphere& s) { return {s.x, s.y, s.z}; }

// Anywhere within some periods.
std::vector<Sphere> spheres(std::uint64_t seed) {
  std::vector<Sphere> s;
  for (std::size_t k = 0; k < particles; ++k) {
    const auto u = random_uniforms({seed, Stream::Tests}, k);
    s.push_back({40 * u[0] - 17, 30 * u[1] - 12, 8 * u[2], 0.1 + u[3]});
  }
  return s;
}

std::vector<Sphere> moved(const std::vector<Sphere>& from, double by, std::uint64_t seed) {
  std::vector<Sphere> s = from;
  for (std::size_t k = 0; k < s.size(); ++k) {
    const auto u = random_uniforms({seed, Stream::Tests}, k);
    s[k].x += by * (u[0] - 0.5);
    s[k].y += by * (u[1] - 0.5);
    s[k].z += by * (u[2] - 0.5);
  }
  return s;
}

// As many as leave every remainder of four once.
std::vector<neighbours::IndexPair> some_pairs(std::size_t count) {
  std::vector<neighbours::IndexPair> pairs;
  for (std::size_t p = 0; p < count; ++p) {
    const auto u = random_uniforms({7, Stream::Tests}, p);
    const auto i = static_cast<std::int32_t>(u[0] * (particles - 1));
    pairs.push_back({i, i + 1 + static_cast<std::int32_t>(u[1] * static_cast<double>(particles - 1 - static_cast<std::size_t>(i)))});
  }
  return pairs;
}

struct Shapes {
  explicit Shapes(std::size_t n) : separation(n), normal(n), gap(n) {}
  std::vector<Vec3> separation, normal;
  std::vector<double> gap;
};

TEST(PairSeparation, IsThatOfTheNearestImage) {
  const auto s = spheres(1);
  for (const std::size_t count : {0, 1, 2, 3, 64, 401}) {
    const auto pairs = some_pairs(count);
    Shapes shapes(count);
    separations(cell, s, pairs, shapes.normal, shapes.gap, shapes.separation);
    for (std::size_t p = 0; p < count; ++p) {
      const Sphere &a = s[pairs[p].i], &b = s[pairs[p].j];
      const Vec3 d = cell.minimum_image(at(b) - at(a));
      EXPECT_EQ(shapes.separation[p], d);
      EXPECT_EQ(shapes.normal[p], Vec3(d / d.norm()));
      EXPECT_EQ(shapes.gap[p], d.norm() - a.radius - b.radius);
    }
  }
}

TEST(PairSeparation, KeepsOneImageThroughTwoSteps) {
  const auto now = spheres(1), before = moved(now, 0.1, 2), from = moved(now, 0.1, 3), predicted = moved(now, 0.1, 4);
  const std::size_t count = 402;
  const auto pairs = some_pairs(count);
  Shapes shapes(count);
  std::vector<double> gap_before(count), gap_from(count), gap_predicted(count), turn(count);
  separations(cell, {now, before, from, predicted}, pairs, {shapes.separation, shapes.normal, shapes.gap, gap_before, gap_from, gap_predicted, turn});
  for (std::size_t p = 0; p < count; ++p) {
    const auto [i, j] = pairs[p];
    const auto apart = [&, i = i, j = j](const std::vector<Sphere>& s) { return Vec3(at(s[j]) - at(s[i])); };
    const Vec3 image = cell.minimum_image(apart(now)) - apart(now);
    const double contact = now[i].radius + now[j].radius;
    const Vec3 foretold = apart(predicted) + image, start = apart(from) + image, n = foretold / foretold.norm();
    EXPECT_EQ(shapes.separation[p], start);
    EXPECT_EQ(shapes.normal[p], n);
    EXPECT_EQ(shapes.gap[p], Vec3(apart(now) + image).norm() - contact);
    EXPECT_EQ(gap_before[p], Vec3(apart(before) + image).norm() - contact);
    EXPECT_EQ(gap_from[p], start.norm() - contact);
    EXPECT_EQ(gap_predicted[p], foretold.norm() - contact);
    EXPECT_EQ(turn[p], n.dot(start) - start.norm());
  }
}

TEST(PairSeparation, MovesWithItsSpheres) {
  const auto s = spheres(1);
  const std::size_t count = 403;
  const auto pairs = some_pairs(count);
  Shapes shapes(count);
  separations(cell, s, pairs, shapes.normal, shapes.gap, shapes.separation);
  const double dt = 0.3;
  std::vector<double> velocity(4 * particles), gap(count), along(count), straight(count), unused(count), least(count);
  for (std::size_t k = 0; k < particles; ++k) {
    const auto u = random_uniforms({5, Stream::Tests}, k);
    for (std::size_t d = 0; d < 3; ++d) velocity[4 * k + d] = u[d] - 0.5;
  }
  moved_gaps(velocity.data(), dt, s, pairs, shapes.separation, shapes.normal, gap, along);
  moved_gaps(velocity.data(), dt, s, pairs, shapes.gap, shapes.normal, straight, unused);
  least_gaps(velocity.data(), dt, pairs, shapes.gap, shapes.normal, least);
  for (std::size_t p = 0; p < count; ++p) {
    const auto [i, j] = pairs[p];
    const double a = s[i].radius, b = s[j].radius;
    Vec3 motion;
    for (int d = 0; d < 3; ++d) motion[d] = dt * (velocity[4 * static_cast<std::size_t>(j) + d] - velocity[4 * static_cast<std::size_t>(i) + d]);
    const Vec3 &n = shapes.normal[p], line = n * (shapes.gap[p] + a + b);
    EXPECT_EQ(gap[p], Vec3(shapes.separation[p] + motion).norm() - a - b);
    EXPECT_EQ(along[p], n.dot(motion));
    EXPECT_EQ(straight[p], Vec3(line + motion).norm() - a - b);
    EXPECT_EQ(least[p], shapes.gap[p] + n.dot(motion));
    EXPECT_LE(least[p], gap[p] + 1e-14);  // rounding of lengths of some 10
  }
}

}  // namespace
}  // namespace pigment::assembly
