#include "cli/utc_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kDayNs = 86'400 * kSecondNs;

TEST(UtcText, IsIso8601InUtc) {
  EXPECT_EQ(UtcText(0), "1970-01-01T00:00:00Z");
  EXPECT_EQ(UtcText(951'782'400 * kSecondNs + 5), "2000-02-29T00:00:00Z");  // a leap day
}

TEST(ParseUtc, ADayLastsADay) {
  const UtcSpan day = ParseUtc("2000-02-29", "--from");
  EXPECT_EQ(UtcText(day.begin_ns), "2000-02-29T00:00:00Z");
  EXPECT_EQ(day.end_ns - day.begin_ns, kDayNs);
}

TEST(ParseUtc, AMinuteLastsAMinute) {
  const UtcSpan minute = ParseUtc("2026-11-21T05:45", "--to");
  EXPECT_EQ(UtcText(minute.begin_ns), "2026-11-21T05:45:00Z");
  EXPECT_EQ(minute.end_ns - minute.begin_ns, 60 * kSecondNs);
}

TEST(ParseUtc, RefusesWhatIsNoInstantAndNamesTheOption) {
  for (const char* text : {"", "today", "2026", "2026-11", "2026-13-01", "2026-11-31", "2026-02-29",
                           "2026-11-21 ", "2026-11-21T25:00", "2026-11-21T05:45:10"}) {
    try {
      static_cast<void>(ParseUtc(text, "--from"));
      ADD_FAILURE() << text;
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.status(), ExitStatus::kUsage);
      EXPECT_THAT(problem.what(), HasSubstr("--from"));
    }
  }
}

}  // namespace
}  // namespace levitas::cli
