// Records that hold rows of another one are found, by whatever file they came.

#include "diagnosis/records/same_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "common/random.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Record Noisy(const std::string& name, std::uint64_t seed, std::size_t rows) {
  Random random(seed);
  Record record;
  record.name = name;
  record.rows.resize(rows);
  for (auto& row : record.rows) {
    row.levitated = true;
    for (double& value : row.sample.position_m) value = 1e-6 * random.Normal();
    for (double& value : row.sample.command.control_current_a) value = 0.1 * random.Normal();
  }
  return record;
}

/// What the refusal says; empty when there is none.
std::string RowsRefusal(const Record& data, const Record& other) {
  try {
    RefuseSameRows({data}, {other}, "--holdout", "give another");
  } catch (const BadInput& refused) {
    return refused.what();
  }
  return {};
}

TEST(SameRows, AreFoundInAPieceThatWasCutOut) {
  const Record whole = Noisy("whole.csv", 1, 4000);
  Record piece = whole;
  piece.name = "piece.csv";
  piece.rows.erase(piece.rows.begin(), piece.rows.begin() + 1003);
  EXPECT_THAT(RowsRefusal(whole, piece), AllOf(HasSubstr("--holdout piece.csv"), HasSubstr("100 %"),
                                               HasSubstr("whole.csv"), HasSubstr("give another")));
}

TEST(SameRows, AreFoundThoughTheLastDigitsDiffer) {
  const Record whole = Noisy("whole.lcm", 1, 4000);
  Record rounded = whole;
  for (auto& row : rounded.rows) {
    // Less than half a unit of the last place in single precision, nearly always.
    for (double& value : row.sample.position_m) value *= 1.0 + 1e-12;
  }
  EXPECT_THAT(RowsRefusal(whole, rounded), HasSubstr("of its rows"));
}

TEST(SameRows, AreNotSeenInAnotherRecordNorWhereNothingMoves) {
  EXPECT_EQ(RowsRefusal(Noisy("a", 1, 4000), Noisy("b", 2, 4000)), "");
  Record still = Noisy("still", 3, 4000);
  for (auto& row : still.rows) {
    row.sample.position_m = {};
    row.sample.command.control_current_a = {};
  }
  EXPECT_EQ(RowsRefusal(still, still), "") << "at rest all records are alike";
}

}  // namespace
}  // namespace levitas::diagnosis
