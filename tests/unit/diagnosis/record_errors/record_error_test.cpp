// What is said of errors of a record, and of a doubt about the rig file.

#include "diagnosis/record_errors/record_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace levitas::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

RecordErrors Of(const std::string& record, RecordErrorKind kind) {
  RecordErrors out;
  out.record = record;
  out.errors.push_back({kind, {}, 1.0, 2.0, "something is wrong", "do that", false});
  return out;
}

TEST(RecordErrorSentences, TellRecordsWithTheSameErrorTogether) {
  EXPECT_THAT(RecordErrorSentences(
                  {Of("a.csv", RecordErrorKind::kSwapped), Of("b.csv", RecordErrorKind::kSwapped)}),
              ElementsAre("Error of the record a.csv, b.csv: something is wrong. To mend it: do "
                          "that."));
  EXPECT_TRUE(RecordErrorSentences({}).empty());
}

TEST(RecordErrorKind, HasTheNameOfTheAnswersFile) {
  EXPECT_STREQ(Name(RecordErrorKind::kSwapped), "swapped");
  EXPECT_STREQ(Name(RecordErrorKind::kGaps), "gaps");
}

}  // namespace
}  // namespace levitas::diagnosis
