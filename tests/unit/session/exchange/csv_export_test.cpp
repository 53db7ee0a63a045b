// Sessions as CSV: the contract's columns and numbers, and a part of rows and columns.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <numbers>
#include <sstream>

#include "common/problem.hpp"
#include "session/exchange/csv_export.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CsvExport : public ::testing::Test {
 protected:
  std::string Exported(const ExportSelection& selection) {
    SessionReader reader(out_);
    static_cast<void>(ExportCsv(reader, csv_, selection));
    return ReadFile(csv_);
  }
  Folder folder_;
  std::string csv_{folder_ / "data.csv"};
  std::string out_{folder_ / "s.lcmlog"};
};

TEST_F(CsvExport, WritesTheContractsColumnsAndShortestNumbers) {
  auto records = DrawRecords(3);
  records[0].in.frame.position_m[0] = 0.1;
  records[0].in.frame.speed_rad_per_s = 100.0 * std::numbers::pi;  // 3000 rpm
  records[0].in.frame.angle_rad = 1.25;
  records[1].in.frame_present = false;
  records[2].in.frame.position_m[1] = -std::numeric_limits<double>::quiet_NaN();
  WriteSession(out_, records);
  SessionReader reader(out_);
  const auto report = ExportCsv(reader, csv_);
  EXPECT_EQ(report.rows, 2U);
  EXPECT_EQ(report.cycles_without_frame, 1U);
  const std::string text = ReadFile(csv_);
  EXPECT_THAT(text, ::testing::StartsWith(
                        "time_s,rotor_angle_rad,speed_rpm,position_de_x_m,position_de_y_m,"
                        "position_nde_x_m,position_nde_y_m,control_current_de_x_a,"
                        "control_current_de_y_a,control_current_nde_x_a,control_current_nde_y_a,"
                        "excitation_de_x_a,excitation_de_y_a,excitation_nde_x_a,"
                        "excitation_nde_y_a,mode\n0,1.25,3000,0.1,"));
  EXPECT_THAT(text, HasSubstr("\n0.0002,"));
  EXPECT_THAT(text, HasSubstr(",nan,"));
}

TEST_F(CsvExport, HoldsTheModeOfEveryRow) {
  auto records = DrawRecords(2);
  records[0].out.mode = Mode::kLift;
  records[1].out.mode = Mode::kTripped;
  WriteSession(out_, records);
  EXPECT_EQ(Exported({.columns = {"mode"}}), "time_s,mode\n0,2\n0.0001,7\n");
}

TEST_F(CsvExport, TakesRowsByTimeAndCount) {
  WriteSession(out_, DrawRecords(10));
  const std::vector<std::string> columns{"mode"};
  const auto times = [&](ExportSelection selection) {
    selection.columns = columns;
    std::string text = Exported(selection);
    text.erase(0, text.find('\n') + 1);
    std::vector<std::string> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      found.push_back(line.substr(0, line.find(',')));
    return found;
  };
  EXPECT_THAT(times({.from_s = 0.0002, .to_s = 0.0004}), ElementsAre("0.0002", "0.0003", "0.0004"));
  EXPECT_THAT(times({.from_s = 0.0002, .every = 3}), ElementsAre("0.0002", "0.0005", "0.0008"));
  EXPECT_THAT(times({.from_s = 7.0}), ::testing::IsEmpty());
}

TEST_F(CsvExport, WritesTheColumnsThatAreAskedForInTheirOrder) {
  auto records = DrawRecords(1);
  records[0].in.frame.position_m[1] = 0.25;
  records[0].in.frame.speed_rad_per_s = 100.0 * std::numbers::pi;
  WriteSession(out_, records);
  EXPECT_EQ(Exported({.columns = {"position_de_y_m", "speed_rpm"}}),
            "time_s,position_de_y_m,speed_rpm\n0,0.25,3000\n");
}

TEST_F(CsvExport, SelectionOfNothingIsRefusedBeforeAFileIsMade) {
  WriteSession(out_, DrawRecords(1));
  const auto refused = [&](const ExportSelection& selection) {
    try {
      Exported(selection);
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.status(), ExitStatus::kUsage);
      return std::string(problem.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused({.columns = {"position_de_z_m"}}), HasSubstr("nearest: position_de_x_m"));
  EXPECT_THAT(refused({.columns = {"mode", "mode"}}), HasSubstr("named twice"));
  EXPECT_THAT(refused({.columns = {"time_s"}}), HasSubstr("besides the time"));
  EXPECT_THAT(refused({.from_s = 2.0, .to_s = 1.0}), HasSubstr("--from 2 s, --to 1 s"));
  EXPECT_THAT(refused({.every = 0}), HasSubstr("--every 0"));
  EXPECT_FALSE(std::filesystem::exists(csv_));
}

TEST_F(CsvExport, TimeStartsAtZeroInRealTimeAndRunsOnAcrossARigRestart) {
  auto records = DrawRecords(4);
  for (auto& record : records) record.in.frame.sample_time_ns += 77'000'000'123;
  records[2].in.frame.rig_session = 5;
  records[3].in.frame.rig_session = 5;
  records[2].in.frame.sample_time_ns = 0;
  records[3].in.frame.sample_time_ns = 100'000;
  SessionHeader header = Header();
  header.pace = "realtime";
  WriteSession(out_, records, header);
  SessionReader reader(out_);
  ExportCsv(reader, csv_);
  const std::string text = ReadFile(csv_);
  EXPECT_THAT(text, AllOf(HasSubstr("\n0,"), HasSubstr("\n0.0001,"), HasSubstr("\n0.0002,"),
                          HasSubstr("\n0.0003,")));
}

TEST_F(CsvExport, IsRefusedWhenItCannotBeWritten) {
  WriteSession(out_, DrawRecords(1));
  SessionReader reader(out_);
  EXPECT_THROW(ExportCsv(reader, "/nonexistent/x.csv"), BadInput);
}

TEST(SecondsText, HasAllDigitsAndNoneTooMany) {
  EXPECT_EQ(SecondsText(0), "0");
  EXPECT_EQ(SecondsText(1), "0.000000001");
  EXPECT_EQ(SecondsText(100'000), "0.0001");
  EXPECT_EQ(SecondsText(-1'500'000'000), "-1.5");
  EXPECT_EQ(SecondsText(3'000'000'000), "3");
}

}  // namespace
}  // namespace levitas::session
