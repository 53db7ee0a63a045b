#include "diagnosis/model/longest_first.hpp"

#include <gtest/gtest.h>

namespace levitas::diagnosis {
namespace {

TEST(LongestFirst, CallsEveryIndexOnce) {
  for (const std::size_t count : {0U, 1U, 2U, 9U}) {
    std::vector<std::size_t> lengths(count);
    for (std::size_t i = 0; i < count; ++i) lengths[i] = (7 * i) % 5;
    std::vector<std::atomic<int>> calls(count);
    LongestFirst(lengths, [&](std::size_t i) { ++calls[i]; });
    for (const auto& of_index : calls) EXPECT_EQ(of_index, 1);
  }
}

}  // namespace
}  // namespace levitas::diagnosis
