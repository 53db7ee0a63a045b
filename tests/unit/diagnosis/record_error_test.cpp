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

TEST(RecordErrorSentences, CallADoubtAboutTheRigFileNoError) {
  EXPECT_THAT(RecordErrorSentences({Of("a.csv", RecordErrorKind::kOtherRig)}),
              ElementsAre("Doubt about the record a.csv: something is wrong. If so: do that."));
}

TEST(AfterRecordErrors, SaysThatNothingWasMendedWhereThereIsOnlyADoubt) {
  const RecordErrors doubt = Of("a.csv", RecordErrorKind::kOtherRig);
  EXPECT_THAT(AfterRecordErrors({doubt}), HasSubstr("takes the rig file for the right one"));
  EXPECT_THAT(AfterRecordErrors({doubt, Of("b.csv", RecordErrorKind::kHeld)}),
              HasSubstr("as mended"));
}

TEST(RecordErrorKind, HasTheNameOfTheAnswersFile) {
  EXPECT_STREQ(Name(RecordErrorKind::kSwapped), "swapped");
  EXPECT_STREQ(Name(RecordErrorKind::kOtherRig), "other_rig");
  EXPECT_TRUE(IsRemark(RecordErrorKind::kOtherRig));
  EXPECT_FALSE(IsRemark(RecordErrorKind::kGaps));
}

}  // namespace
}  // namespace levitas::diagnosis
