// Four numbers side by side: read and written anywhere in memory, computed lane by lane.

#include "diagnosis/model/four.hpp"

#include <gtest/gtest.h>

#include <array>

namespace levitas::diagnosis {
namespace {

// From the second number on, which is no boundary of 32 bytes if the first one is.
TEST(FourNumbers, ComeBackInTheirOrderFromAnyAddressAndLeaveTheNeighboursAlone) {
  for (std::size_t at = 0; at < 4; ++at) {
    alignas(32) std::array<double, 8> from{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0};
    alignas(32) std::array<double, 8> to{};
    Four four{};
    Load(from.data() + at, four);
    Store(four, to.data() + at);
    for (std::size_t i = 0; i < to.size(); ++i) {
      const bool written = i >= at && i < at + 4;
      EXPECT_EQ(to[i], written ? from[i] : 0.0) << "from " << at;
    }
  }
}

TEST(FourNumbers, AreComputedEachByItself) {
  const std::array<double, 4> a{1.0, -2.0, 0.5, 8.0};
  const std::array<double, 4> b{4.0, 3.0, -6.0, 0.25};
  Four first{};
  Four second{};
  Load(a.data(), first);
  Load(b.data(), second);
  const Four result = first * second + 1.0;
  std::array<double, 4> found{};
  Store(result, found.data());
  EXPECT_EQ(found, (std::array<double, 4>{5.0, -5.0, -2.0, 3.0})) << "exact in binary";
}

}  // namespace
}  // namespace levitas::diagnosis
