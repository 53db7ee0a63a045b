#include "diagnosis/inference/judging.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "common/problem.hpp"

namespace levitas::diagnosis {
namespace {

using testing::HasSubstr;

TEST(Judging, EveryNumberHasOneRowWithItsSourceAndASweepThatHoldsTheShippedValue) {
  const Judging shipped;
  std::set<const double*> members;
  std::set<std::string_view> names;
  for (const JudgingRow& row : JudgingTable()) {
    members.insert(&(shipped.*row.value));
    names.insert(row.name);
    EXPECT_FALSE(row.meaning.empty() || row.source.empty() || row.unit.empty()) << row.name;
    const std::string sweep = fmt::format("--sweep {}=", row.name);
    const std::size_t at = row.again.find(sweep);
    ASSERT_NE(at, std::string::npos) << row.name;
    const std::string values = fmt::format(",{},", row.again.substr(at + sweep.size()));
    EXPECT_THAT(values, HasSubstr(fmt::format(",{:g},", shipped.*row.value))) << row.name;
  }
  EXPECT_EQ(names.size(), JudgingTable().size());
  EXPECT_EQ(members.size() * sizeof(double), sizeof(Judging)) << "a member has no row, or two";
}

TEST(Judging, AnUnknownNameIsRefusedWithTheNamesAllowed) {
  EXPECT_EQ(FindJudging("harm_nat").value, &Judging::harm_nat);
  try {
    (void)FindJudging("harm");
    FAIL() << "taken";
  } catch (const BadInput& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("found harm, allowed decisive_nat"));
    EXPECT_THAT(refusal.what(), HasSubstr("harm_nat"));
  }
}

}  // namespace
}  // namespace levitas::diagnosis
