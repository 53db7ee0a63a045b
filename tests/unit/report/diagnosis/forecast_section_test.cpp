#include "report/diagnosis/forecast_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "report/diagnosis/diagnosis_page.hpp"

namespace levitas::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Two bands: 3.5 um measured, 2 to 5 um expected; `measured_um`, 6 to `high_um` expected.
diagnosis::DiagnosisReport WithForecast(double measured_um, double high_um) {
  diagnosis::DiagnosisReport report;
  report.rig_name = "rig";
  diagnosis::ReportForecast forecast;
  forecast.fit_percent = {40.0, 70.0, 55.0, true};
  forecast.better_than_file = 0.85;
  const bool covered = 6.0 <= measured_um && measured_um <= high_um;
  forecast.by_speed = {
      {500.0, 1000.0, {10.0, 20.0, 15.0, true}, {2.0, 5.0, 3.5, true}},
      {1000.0, 1500.0, {30.0, 40.0, 35.0, true}, {6.0, high_um, measured_um, covered}}};
  report.forecast = forecast;
  return report;
}

std::string Section(const diagnosis::DiagnosisReport& report) {
  return ForecastSection(report, diagnosis::SentencesOf(report));
}

std::size_t Times(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(ForecastSectionTest, HasForEverySpeedTheIntervalAndWhatWasMeasured) {
  const std::string page = DiagnosisPage(WithForecast(7.5, 9.0));
  EXPECT_THAT(page, AllOf(HasSubstr("<h2>Forecast"), HasSubstr("500 to 1000"), HasSubstr("2 to 5"),
                          HasSubstr(">3.5<"), HasSubstr("1000 to 1500"), HasSubstr("6 to 9"),
                          HasSubstr(">7.5<"), HasSubstr("40 to 70 %"), HasSubstr("85 %"),
                          HasSubstr("<svg")));
}

TEST(ForecastSectionTest, MarksTheBandsThatTheIntervalDoesNotCover) {
  EXPECT_THAT(Section(WithForecast(7.5, 9.0)), Not(HasSubstr("above")));
  const std::string above = Section(WithForecast(12.0, 9.0));
  EXPECT_EQ(Times(above, "<td>above</td>"), 1U);
  EXPECT_EQ(Times(Section(WithForecast(5.0, 9.0)), "<td>below</td>"), 1U);
}

TEST(ForecastSectionTest, DrawsAnIntervalWithAnOpenEnd) {
  const double open = std::numeric_limits<double>::infinity();
  const std::string section = Section(WithForecast(7.5, open));
  EXPECT_THAT(section,
              AllOf(HasSubstr("at least 6"), Not(HasSubstr("inf")), Not(HasSubstr("nan"))));
}

TEST(ForecastSectionTest, IsNotThereWithoutValidationRecords) {
  diagnosis::DiagnosisReport report = WithForecast(7.5, 9.0);
  report.forecast.reset();
  EXPECT_THAT(Section(report), IsEmpty());
  EXPECT_THAT(DiagnosisPage(report), Not(HasSubstr("Forecast")));
}

}  // namespace
}  // namespace levitas::report
