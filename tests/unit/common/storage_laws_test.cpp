// Check sum, ring and histogram against slower models of themselves, on written seeds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

#include "common/crc32.hpp"
#include "common/histogram.hpp"
#include "common/random.hpp"
#include "common/spsc_ring.hpp"

namespace levitas {
namespace {

std::vector<std::uint8_t> RandomBytes(Random& random, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.Bits());
  return bytes;
}

// The definition: division of the message by the polynomial, bit by bit, reflected.
std::uint32_t ByDivision(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t rest = 0xFFFFFFFF;
  for (const std::uint8_t byte : bytes) {
    rest ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      rest = (rest >> 1) ^ ((rest & 1U) != 0U ? 0xEDB88320U : 0U);
    }
  }
  return ~rest;
}

TEST(Crc32, IsTheRemainderOfTheDivisionForAnyLengthAndAlignment) {
  Random random(1);
  const auto bytes = RandomBytes(random, 600);
  for (std::size_t size = 0; size < 300; ++size) {
    const std::size_t from = random.Bits() % 300;
    const auto start = bytes.begin() + static_cast<std::ptrdiff_t>(from);
    const std::vector<std::uint8_t> piece(start, start + static_cast<std::ptrdiff_t>(size));
    ASSERT_EQ(Crc32(bytes.data() + from, size), ByDivision(piece)) << size << " from " << from;
  }
}

TEST(Crc32, NoticesEveryBurstOfUpTo32Bits) {
  // Peterson and Brown (1961): a polynomial of degree 32 misses no burst that short.
  Random random(2);
  const auto good = RandomBytes(random, 200);
  const std::uint32_t expected = Crc32(good.data(), good.size());
  for (int draw = 0; draw < 20'000; ++draw) {
    auto bad = good;
    const std::size_t at = random.Bits() % (8 * good.size() - 32);
    const auto burst = static_cast<std::uint32_t>(random.Bits()) | 1U;
    for (std::size_t bit = 0; bit < 32; ++bit) {
      const std::size_t place = at + bit;
      bad[place / 8] ^= static_cast<std::uint8_t>(((burst >> bit) & 1U) << (place % 8));
    }
    ASSERT_NE(Crc32(bad.data(), bad.size()), expected) << at;
  }
}

TEST(SpscRing, BehavesAsAQueueThatForgetsTheNewestWhenFull) {
  Random random(3);
  for (const std::size_t wanted : {1U, 2U, 3U, 7U, 64U}) {
    SpscRing<std::uint64_t> ring(wanted);
    ASSERT_GE(ring.capacity(), wanted);
    ASSERT_LT(ring.capacity(), 2 * wanted + 1);
    std::deque<std::uint64_t> model;
    std::uint64_t lost = 0;
    for (std::uint64_t step = 0; step < 20'000; ++step) {
      // Bursts either way, so that the ring is often full, often empty and wraps round.
      if (random.Uniform() < ((step / 100) % 2 == 0 ? 0.7 : 0.3)) {
        const bool room = model.size() < ring.capacity();
        ASSERT_EQ(ring.Post(step), room);
        if (room) {
          model.push_back(step);
        } else {
          ++lost;
        }
      } else {
        std::uint64_t value = 0;
        ASSERT_EQ(ring.Take(value), !model.empty());
        if (model.empty()) continue;
        ASSERT_EQ(value, model.front());
        model.pop_front();
      }
      ASSERT_EQ(ring.lost(), lost);
    }
    EXPECT_GT(lost, 0U);
  }
}

TEST(Histogram, PutsEveryDurationIntoTheBinThatReachesUpToIt) {
  Random random(4);
  for (int draw = 0; draw < 50'000; ++draw) {
    const auto value = static_cast<std::int64_t>(std::exp2(39.9 * random.Uniform()));
    Histogram histogram;
    histogram.Add(value);
    const auto bin = static_cast<std::size_t>(
        std::find(histogram.bins().begin(), histogram.bins().end(), 1U) - histogram.bins().begin());
    ASSERT_LE(static_cast<double>(value), Histogram::UpperEdge(bin)) << value;
    if (bin > 0) {
      ASSERT_GT(static_cast<double>(value), Histogram::UpperEdge(bin - 1)) << value;
    }
  }
}

TEST(Histogram, HasEdgesThatRiseByNoMoreThanASixteenth) {
  for (std::size_t bin = 1; bin + 1 < Histogram::kBins; ++bin) {
    const double below = Histogram::UpperEdge(bin - 1);
    const double edge = Histogram::UpperEdge(bin);
    EXPECT_GE(edge, below + 1.0) << bin;  // whole nanoseconds
    EXPECT_LE(edge, below * 17.0 / 16.0 + 1.0) << bin;
  }
}

TEST(Histogram, NeverLowersAPercentileWhenMoreIsAskedNorExceedsTheLargest) {
  Random random(5);
  Histogram histogram;
  for (int i = 0; i < 1000; ++i) {
    histogram.Add(static_cast<std::int64_t>(1e4 * -std::log(1.0 - random.Uniform())));
  }
  double before = 0.0;
  for (double p = 0.0; p <= 1.0; p += 0.001) {
    const double now = histogram.Percentile(p);
    EXPECT_GE(now, before) << p;
    EXPECT_LE(now, static_cast<double>(histogram.max_ns())) << p;
    before = now;
  }
  EXPECT_EQ(histogram.Percentile(1.0), static_cast<double>(histogram.max_ns()));
}

}  // namespace
}  // namespace levitas
