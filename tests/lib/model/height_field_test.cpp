#include "model/height_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace pigment;

namespace {

const Cell cell{4, 5, 10};
const HeightMap rough = height_map({1.2, 1.3, {}});  // three periods along x, four along y

// The surface on a fine grid about a point: an answer that shares nothing with Newton's method.
struct Nearest {
  double distance = 0;
  int valleys = 0;  // strict local minima of the distance no farther than reach
};
// How far its distance can lie above the true one: its point is within 0.71 step of the foot, on the surface within 0.71 step times
// sqrt(1 + slope^2), slope <= sqrt(2) A k/4 = 2.1; distance grows from the foot as s^2/2 (1/distance + curvature), curvature < 8.
double grid_error(double distance, double step) { return 0.25 * step * step * (1 + 2.1 * 2.1) * (1 / distance + 8); }

Nearest brute_force(const HeightField& field, const Vec3& p, double reach, double step) {
  const int n = static_cast<int>(std::ceil(reach / step)) + 2, width = 2 * n + 1;
  std::vector<double> d(static_cast<std::size_t>(width) * width);
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j) {
      const double x = p.x() + i * step, y = p.y() + j * step;
      d[(i + n) * width + j + n] = (Vec3(x, y, field.height(x, y)) - p).norm();
    }
  Nearest out{d[0], 0};
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j) {
      const double own = d[i * width + j];
      out.distance = std::min(out.distance, own);
      if (i == 0 || j == 0 || i == width - 1 || j == width - 1 || own > reach) continue;
      bool least = true;
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b) least = least && ((a == 0 && b == 0) || own < d[(i + a) * width + j + b]);
      out.valleys += least;
    }
  return out;
}

}  // namespace

TEST(HeightField, FitsAWholeNumberOfPeriodsIntoTheCell) {
  const HeightField field(rough, cell);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 5);
  double lowest = 1, highest = 0, sum = 0;
  const int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double z = field.height(cell.width_x * i / n, cell.width_y * j / n);
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
      sum += z;
    }
  EXPECT_NEAR(lowest, 0, 1e-3);  // the grid misses the deepest point by less than a 400th of the width
  EXPECT_NEAR(highest, field.crest(), 1e-3);
  EXPECT_NEAR(field.crest(), 1.2, 1e-3);
  EXPECT_NEAR(sum / (n * n), field.mean_height(), 1e-12);  // a sum over whole periods is exact
  for (int k = 0; k < 100; ++k) {
    const double x = uniform(random), y = uniform(random);
    EXPECT_NEAR(field.height(x, y), field.height(x + 3 * cell.width_x, y - 2 * cell.width_y), 1e-12);
    EXPECT_NEAR(field.height(x, y), field.height(x + cell.width_x / 3, y + cell.width_y / 4), 1e-12);
  }
}

TEST(HeightField, FeetAreThoseThatAFineGridFinds) {
  const HeightField field(rough, cell);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> x(-3, 8), above(0.02, 1.5);
  int several = 0;
  for (int k = 0; k < 150; ++k) {
    Vec3 p(x(random), x(random), 0);
    p.z() = field.height(p.x(), p.y()) + above(random);
    const double reach = 1.2, step = 0.01;
    const Nearest nearest = brute_force(field, p, reach, step);
    const auto feet = field.feet(p, reach);
    double least = 10;
    for (const auto& foot : feet) {
      least = std::min(least, foot.distance);
      const Vec3 at(foot.x, foot.y, field.height(foot.x, foot.y));
      EXPECT_NEAR((p - at).norm(), foot.distance, 1e-12);
      EXPECT_LT((p - at - foot.distance * foot.normal).norm(), 1e-6);  // the line to the foot is the normal
      for (double turn = 0; turn < 6; turn += 0.5) {
        const double qx = foot.x + 1e-3 * std::cos(turn), qy = foot.y + 1e-3 * std::sin(turn);
        EXPECT_GT((Vec3(qx, qy, field.height(qx, qy)) - p).norm(), foot.distance - 1e-12);
      }
    }
    if (nearest.distance < reach - step) {
      ASSERT_FALSE(feet.empty()) << p.transpose();
      EXPECT_LE(least, nearest.distance + 1e-12);
      EXPECT_GT(least, nearest.distance - grid_error(least, step));
    }
    several += feet.size() > 1;
    // A grid may split a shallow minimum or miss one at the rim of its reach, hence one more or less; never the deep ones.
    EXPECT_NEAR(static_cast<double>(feet.size()), nearest.valleys, 1);
  }
  EXPECT_GT(several, 20);  // many of these points hang over a valley between several slopes
}

// Over the middle of a groove, at its radius of curvature and on either side of it, one foot parts into two: the distance is flat there.
TEST(HeightField, FeetAreNormalWhereTheyPart) {
  HeightMap groove{12, 1, 1, 1, {}};
  for (int i = 0; i < 12; ++i) groove.height.push_back(0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / 12));
  const HeightField field(groove, Cell{1, 1, 10});
  const double radius = 1 / (0.5 * std::pow(2 * std::numbers::pi, 2));  // of the cosine; the spline's is 2 % less
  for (const double off : {0.0, 1e-9, 1e-6, 1e-3})
    for (double z = 0.5 * radius; z < 4 * radius; z += 0.02 * radius) {
      const Vec3 p(off, 0.3, z);
      const auto feet = field.feet(p, 2 * z);
      ASSERT_FALSE(feet.empty());
      for (const auto& foot : feet) {
        const Vec3 at(foot.x, foot.y, field.height(foot.x, foot.y));
        EXPECT_LT((p - at - foot.distance * foot.normal).norm(), 1e-6 * z) << z / radius << " " << off;
        const auto again = field.follow(foot, p + Vec3(0, 0, 1e-12));
        EXPECT_NEAR(again.distance, foot.distance, 1e-9);
      }
    }
}

TEST(HeightField, APointInsideHasANegativeDistance) {
  const HeightField field(rough, cell);
  for (double depth : {0.01, 0.1, 0.3, 0.8}) {
    const Vec3 p(0.4, 1.1, field.height(0.4, 1.1) - depth);
    const auto feet = field.feet(p, 1);
    ASSERT_EQ(feet.size(), 1u);
    EXPECT_EQ(field.feet(p, 1e-3).size(), 1u);  // however far
    EXPECT_LT(feet[0].distance, 0);
    EXPECT_NEAR(-feet[0].distance, brute_force(field, p, 1, 0.002).distance, grid_error(-feet[0].distance, 0.002));
    EXPECT_GE(depth, -feet[0].distance);
    EXPECT_GT(-feet[0].distance, depth / 2.6);  // at most this steep: sqrt(1 + 2.1^2) and its change on the way
  }
}

// Crests and valleys of A (2 + cos kx x + cos ky y)/4 have the curvatures A k^2/4; those of the spline through points h apart
// 6 (1 - cos kh)/((2 + cos kh) (kh)^2) of that, 2 % more at twelve a wavelength.
TEST(HeightField, CurvatureIsPositiveOnCrestsAndNegativeInValleys) {
  const HeightField field(height_map({1.2, 1, {}}), Cell{4, 4, 10});
  const double kh = 2 * std::numbers::pi / 12, spline = 6 * (1 - std::cos(kh)) / ((2 + std::cos(kh)) * kh * kh);
  const double expected = spline * 1.2 * std::pow(2 * std::numbers::pi, 2) / 4;
  const auto crest = field.feet({0, 0, 1.5}, 0.4), valley = field.feet({0.5, 0.5, 0.03}, 0.1);
  ASSERT_EQ(crest.size(), 1u);
  ASSERT_EQ(valley.size(), 1u);
  EXPECT_NEAR(crest[0].curvature, expected, 1e-6 * expected);
  EXPECT_NEAR(valley[0].curvature, -expected, 1e-6 * expected);
  EXPECT_NEAR(crest[0].distance, 0.3, 1e-4);
}
