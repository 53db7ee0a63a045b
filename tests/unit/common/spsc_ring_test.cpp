#include "common/spsc_ring.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace levitas {
namespace {

TEST(SpscRing, LosesAndCountsWhenFullAndKeepsTheOldest) {
  SpscRing<int> ring(4);
  for (int i = 0; i < 6; ++i) ring.Post(i);
  EXPECT_EQ(ring.lost(), 2U);
  int value = -1;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(ring.Take(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.Take(value));
}

TEST(SpscRing, HandsEverythingOverInOrderBetweenTwoThreads) {
  constexpr std::uint64_t kCount = 200'000;
  SpscRing<std::uint64_t> ring(1024);
  std::thread writer([&ring] {
    for (std::uint64_t i = 0; i < kCount;) {
      if (ring.Post(i)) ++i;
    }
  });
  std::uint64_t expected = 0;
  std::uint64_t value = 0;
  bool ordered = true;
  while (expected < kCount) {
    if (!ring.Take(value)) continue;
    ordered = ordered && value == expected;
    ++expected;
  }
  writer.join();
  EXPECT_TRUE(ordered);
}

}  // namespace
}  // namespace levitas
