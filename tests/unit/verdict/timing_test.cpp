#include "verdict/timing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/problem.hpp"

namespace levitas::verdict {
namespace {

/// A file of this test only, removed at its end.
class ReportFile {
 public:
  explicit ReportFile(const std::string& text)
      : path_(testing::TempDir() + "report-" + std::to_string(getpid()) + ".json") {
    std::ofstream(path_) << text;
  }
  ~ReportFile() { std::remove(path_.c_str()); }
  ReportFile(const ReportFile&) = delete;
  ReportFile& operator=(const ReportFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

nlohmann::json Duration(double p50_ns) {
  return {{"count", 10}, {"p50_ns", p50_ns}, {"p99_ns", 2.0}, {"p999_ns", 3.0}, {"max_ns", 4}};
}

nlohmann::json ControllerReport() {
  nlohmann::json json{{"cycles", 50'000},       {"wall_s", 2.0},
                      {"records_lost", 1},      {"messages_lost", 2},
                      {"frames_rejected", 3},   {"realtime", "SCHED_FIFO: 80"},
                      {"trip_file", "t.lcmlog"}};
  for (const char* name : {"wakeup", "compute", "latency"}) json["timing"][name] = Duration(1.0);
  for (const char* stage : {"wait", "read", "check", "supervise", "law", "write", "record"}) {
    json["timing"]["stage"][stage] = Duration(5.0);
    json["timing"]["blamed"][stage] = 0;
  }
  return json;
}

TEST(ReadControllerReport, GivesRatesAgainstTheRigsPeriod) {
  const ReportFile file(ControllerReport().dump());
  const auto figures = ReadControllerReport(file.path(), 1e-4);
  ASSERT_TRUE(figures);
  EXPECT_DOUBLE_EQ(figures->cycles_per_s, 25'000.0);
  EXPECT_DOUBLE_EQ(figures->times_real_time, 2.5);  // 50 000 cycles of 100 us in 2 s
  EXPECT_EQ(figures->lost_records, 1U);
  EXPECT_EQ(figures->lost_messages, 2U);
  EXPECT_EQ(figures->rejected_frames, 3U);
  EXPECT_EQ(figures->real_time, "SCHED_FIFO: 80");
  EXPECT_EQ(figures->trip_file, "t.lcmlog");
  ASSERT_EQ(figures->durations.size(), 10U);  // three of the loop, seven stages
  EXPECT_EQ(figures->durations[1].name, "compute");
  EXPECT_EQ(figures->durations[3].name, "wait");
  EXPECT_EQ(figures->durations[3].p50_ns, 5.0);
}

TEST(ReadControllerReport, BlamesTheStageWithMostOverruns) {
  nlohmann::json json = ControllerReport();
  EXPECT_EQ(ReadControllerReport(ReportFile(json.dump()).path(), 1e-4)->blamed_stage, "");
  json["timing"]["blamed"]["read"] = 2;
  json["timing"]["blamed"]["law"] = 7;
  json["timing"]["blamed"]["write"] = 7;
  EXPECT_EQ(ReadControllerReport(ReportFile(json.dump()).path(), 1e-4)->blamed_stage, "law");
}

TEST(ReadControllerReport, IsEmptyWhenTheProgramWasKilledBeforeItWroteOne) {
  EXPECT_FALSE(ReadControllerReport("/nowhere/report.json", 1e-4));
  EXPECT_FALSE(ReadControllerReport("", 1e-4));
  EXPECT_FALSE(ReadRigReport("/nowhere/report.json"));
}

TEST(ReadControllerReport, NamesTheFileThatIsNoReport) {
  for (const char* text : {"", "{", "[1, 2]", R"({"cycles": 5})", R"({"cycles": "five"})"}) {
    const ReportFile file(text);
    try {
      static_cast<void>(ReadControllerReport(file.path(), 1e-4));
      ADD_FAILURE() << "accepted: " << text;
    } catch (const BadInput& problem) {
      EXPECT_THAT(problem.what(), testing::StartsWith(file.path() + ": is not a report"));
    }
  }
}

TEST(ReadControllerReport, HasNoRateWithoutTime) {
  nlohmann::json json = ControllerReport();
  json["wall_s"] = 0.0;
  EXPECT_EQ(ReadControllerReport(ReportFile(json.dump()).path(), 1e-4)->times_real_time, 0.0);
}

TEST(ReadRigReport, TellsWhatTheRigHeldAndHowLongAPeriodTook) {
  const nlohmann::json json{{"cycles", 9},
                            {"held_currents", 4},
                            {"messages_lost", 5},
                            {"watchdog_trips", 1},
                            {"advance", Duration(17.0)}};
  const ReportFile file(json.dump());
  const auto figures = ReadRigReport(file.path());
  ASSERT_TRUE(figures);
  EXPECT_EQ(figures->held_currents, 4U);
  EXPECT_EQ(figures->lost_messages, 5U);
  EXPECT_EQ(figures->watchdog_trips, 1U);
  EXPECT_EQ(figures->advance.p50_ns, 17.0);
}

}  // namespace
}  // namespace levitas::verdict
