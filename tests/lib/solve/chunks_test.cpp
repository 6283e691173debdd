#include "solve/chunks.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace pigment::solve;

namespace {

// The most work of a chunk over the mean, a particle counting as three pairs.
double most_over_mean(const Chunks& chunks, std::size_t particles, const std::vector<std::int32_t>& pair_i) {
  double most = 0;
  for (int c = 0; c < chunks.count(); ++c) {
    const auto begin = std::lower_bound(pair_i.begin(), pair_i.end(), chunks.begin[c]), end = std::lower_bound(pair_i.begin(), pair_i.end(), chunks.begin[c + 1]);
    most = std::max(most, 3.0 * (chunks.begin[c + 1] - chunks.begin[c]) + static_cast<double>(end - begin));
  }
  return most * chunks.count() / (3.0 * static_cast<double>(particles) + static_cast<double>(pair_i.size()));
}

}  // namespace

TEST(Chunks, OfACakeUnderLiquidHaveTheSameWork) {
  for (const int particles : {1000, 1003, 30000}) {
    std::vector<std::int32_t> pair_i;
    for (int k = 0; k < particles / 3; ++k) pair_i.insert(pair_i.end(), 9, k);
    const Chunks chunks = make_chunks(particles, pair_i);
    EXPECT_LT(most_over_mean(chunks, particles, pair_i), 1.1);
    EXPECT_EQ(chunks.count(), make_chunks(particles, {}).count());
    EXPECT_EQ(chunks.begin.front(), 0);
    EXPECT_EQ(chunks.begin.back(), particles);
    for (int c = 0; c < chunks.count(); ++c) {
      EXPECT_EQ(chunks.begin[c] % 4, 0);
      EXPECT_LT(chunks.begin[c], chunks.begin[c + 1]);
    }
  }
}

TEST(Chunks, AreThereForFewParticlesAndForNone) {
  EXPECT_EQ(make_chunks(0, {}).begin, (std::vector<int>{0, 0}));
  EXPECT_EQ(make_chunks(3, {0, 0, 1}).begin, (std::vector<int>{0, 3}));
  EXPECT_EQ(make_chunks(256, {}).begin, (std::vector<int>{0, 256}));
  // All pairs with the last particles: no chunk is empty.
  EXPECT_EQ(make_chunks(600, std::vector<std::int32_t>(100000, 599)).count(), 1);
}
