#include "diagnosis/report/forecast_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "diagnosis/report/build_report.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kOpen = std::numeric_limits<double>::infinity();

/// An answer that leaves 20 times the noise on validation records; fit expected: 20 to 60 %.
DiagnosisResult Forecasted(double measured_percent) {
  DiagnosisResult s = NothingFound();
  s.separate_validation = true;
  s.fitted.extended_over_noise = 1.0;
  s.validation.extended_over_noise = 400.0;
  Forecast forecast;
  forecast.fit_percent = {20.0, 60.0};
  forecast.fit_measured_percent = measured_percent;
  forecast.by_speed.push_back({});
  s.forecast = forecast;
  return s;
}

TEST(ForecastRange, SaysWhichEndIsOpen) {
  EXPECT_EQ(RangeText({1.5, 20.25, 3.0, true}, 3), "1.5 to 20.2");
  EXPECT_EQ(RangeText({-kOpen, 20.25, 3.0, true}, 3), "at most 20.2");
  EXPECT_EQ(RangeText({1.5, kOpen, 3.0, true}, 3), "at least 1.5");
  EXPECT_EQ(RangeText({-kOpen, kOpen, 3.0, true}, 3), "anything");
}

TEST(ForecastSentenceTest, SaysWhetherTheIntervalHadRoomForAnAnswerThatDoesNotCarryOver) {
  EXPECT_THAT(BuildReport(Forecasted(35.0)).verdict_sentence,
              AllOf(HasSubstr("does not carry over"), HasSubstr("35 % there is within"),
                    HasSubstr("(20 to 60 %)"), HasSubstr("leave that much open")));
  EXPECT_THAT(BuildReport(Forecasted(-5.0)).verdict_sentence,
              AllOf(HasSubstr("-5 % there is below"), HasSubstr("lacks something"),
                    Not(HasSubstr("leave that much open"))));
  EXPECT_THAT(BuildReport(Forecasted(75.0)).verdict_sentence,
              AllOf(HasSubstr("75 % there is above"), HasSubstr("better than")));
}

TEST(ForecastSentenceTest, IsLeftOutOfAnAnswerThatCarriesOverAndWithoutAForecast) {
  DiagnosisResult holds = Forecasted(35.0);
  holds.validation.extended_over_noise = 1.1;
  EXPECT_THAT(BuildReport(holds).verdict_sentence, Not(HasSubstr("interval of the forecast")));
  DiagnosisResult none = Forecasted(35.0);
  none.forecast.reset();
  EXPECT_THAT(BuildReport(none).verdict_sentence,
              AllOf(HasSubstr("does not carry over"), Not(HasSubstr("interval of the forecast"))));
  EXPECT_THAT(ForecastSentence(BuildReport(none)), IsEmpty());
}

}  // namespace
}  // namespace levitas::diagnosis
