#include "common/enums.hpp"

#include <gtest/gtest.h>

#include <set>

namespace levitas {
namespace {

template <class Enum>
void ExpectDistinctNames(std::uint8_t count) {
  std::set<std::string_view> names;
  for (std::uint8_t i = 0; i < count; ++i) names.insert(Name(static_cast<Enum>(i)));
  EXPECT_EQ(names.size(), count);
  EXPECT_FALSE(names.contains("invalid"));
  EXPECT_EQ(Name(static_cast<Enum>(count)), "invalid");
}

TEST(Enums, EveryValueHasItsOwnNameAndOnlyThose) {
  ExpectDistinctNames<Mode>(kModeCount);
  ExpectDistinctNames<Fault>(kFaultCount);
  ExpectDistinctNames<OperatorCommand>(kOperatorCommandCount);
}

}  // namespace
}  // namespace levitas
