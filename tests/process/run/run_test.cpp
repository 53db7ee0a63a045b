// amb run as a person starts it: orderly runs.

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/log/record_codec.hpp"
#include "session/log/session_reader.hpp"
#include "tests/process/run/amb_run.hpp"

namespace levitas::cli {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class RunTest : public testing::Test {
 protected:
  RunTest() { std::ofstream(scratch_ / "short.yaml") << kShortScenario; }
  [[nodiscard]] std::vector<std::string> Short(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"--scenario", scratch_ / "short.yaml"});
    return more;
  }

  test::ScratchFolder scratch_;
};

/// All records of a session; the number the rig draws at each start is not part of the physics.
std::vector<cycle::CycleRecord> RecordsOf(const std::string& path) {
  session::SessionReader reader(path);
  std::vector<cycle::CycleRecord> records;
  cycle::CycleRecord record;
  while (reader.Next(record)) {
    record.in.frame.rig_session = 0;
    records.push_back(record);
  }
  return records;
}

TEST_F(RunTest, LevitatesJudgesAndLeavesNothingBehind) {
  AmbRun run(scratch_, "run", Short({"--json", scratch_ / "verdict.json"}));
  ASSERT_EQ(run.Status(), 0) << run.Said();
  EXPECT_THAT(run.Said(), HasSubstr(" of 6000 rpm: orbit standing "));
  for (const char* mode : {"lift ", "levitating ", "spinning ", "landing "}) {
    EXPECT_THAT(run.Said(), HasSubstr(std::string("\n") + mode));
  }
  EXPECT_THAT(run.Said(), Not(HasSubstr("\x1b")));  // no terminal, no control codes
  EXPECT_THAT(run.Said(), Not(HasSubstr("\r")));
  for (const auto& entry : std::filesystem::directory_iterator(scratch_ / "")) {
    EXPECT_THAT(entry.path().filename().string(), Not(testing::StartsWith("amb-run-")));
  }
  const auto json = nlohmann::json::parse(ReadAll(scratch_ / "verdict.json"));
  EXPECT_EQ(json["verdict"], "accepted");
  EXPECT_EQ(json["orbits"].size(), 4U);
  EXPECT_EQ(json["provenance"]["seed"], 1);
  EXPECT_EQ(json["provenance"]["session_file"], "");
  const double shown_rpm = json["speed_range"]["shown_rpm"].get<double>();
  EXPECT_NEAR(shown_rpm, 300.0, 6.0);  // within standstill_rpm, one frame before the last
  EXPECT_NEAR(json["speed_range"]["shown_share"].get<double>(), shown_rpm / 6000.0, 1e-12);
  EXPECT_THAT(run.Said(), HasSubstr(fmt::format("\nACCEPTED up to {:.0f} of 6000 rpm", shown_rpm)));
  EXPECT_GT(json["timing"]["cycles_per_s"].get<double>(), 0.0);
  EXPECT_NEAR(json["top_speed_rpm"].get<double>(), 300.0, 5.0);  // reached: within standstill_rpm
}

TEST_F(RunTest, RepeatsTheSameRecordForTheSameSeedAndAnotherForAnother) {
  const auto record = [&](const std::string& file, const std::string& seed,
                          const std::string& pace = "lockstep") {
    AmbRun run(scratch_, file,
               Short({"--record", scratch_ / file, "--seed", seed, "--pace", pace}));
    EXPECT_EQ(run.Status(), 0) << run.Said();
    EXPECT_THAT(run.Said(), HasSubstr("amb replay " + (scratch_ / file)));
    return RecordsOf(scratch_ / file);
  };
  const auto first = record("first.lcmlog", "7");
  const auto second = record("second.lcmlog", "7", "paced");  // the clock changes nothing
  const auto other = record("other.lcmlog", "8");
  ASSERT_EQ(first.size(), second.size());
  ASSERT_GT(first.size(), 10'000U);
  std::size_t different = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool same =
        first[i].in.cycle == second[i].in.cycle &&
        first[i].in.frame.position_m == second[i].in.frame.position_m &&
        first[i].in.frame.angle_rad == second[i].in.frame.angle_rad &&
        first[i].out.current.control_current_a == second[i].out.current.control_current_a &&
        first[i].out.mode == second[i].out.mode;
    if (!same) ++different;
  }
  EXPECT_EQ(different, 0U);
  EXPECT_NE(first[5'000].in.frame.position_m, other[5'000].in.frame.position_m);
}

TEST_F(RunTest, TwoRunsAtOnceDoNotDisturbEachOther) {
  AmbRun first(scratch_, "first", Short({"--json", scratch_ / "first.json"}));
  AmbRun second(scratch_, "second", Short({"--json", scratch_ / "second.json", "--seed", "2"}));
  EXPECT_EQ(first.Status(), 0) << first.Said();
  EXPECT_EQ(second.Status(), 0) << second.Said();
  const auto one = nlohmann::json::parse(ReadAll(scratch_ / "first.json"));
  const auto two = nlohmann::json::parse(ReadAll(scratch_ / "second.json"));
  EXPECT_NE(one["provenance"]["port"], two["provenance"]["port"]);
  for (const auto& json : {one, two}) {
    EXPECT_EQ(json["timing"]["lost_messages"], 0);
    EXPECT_EQ(json["timing"]["rejected_frames"], 0);
    EXPECT_EQ(json["timing"]["missing_frames"], 0);
  }
}

// 1.5 s is in the middle of levitation: the rotor must be landed and the amplifiers off.
TEST_F(RunTest, DurationCutsTheScenarioWithALanding) {
  AmbRun run(scratch_, "run", Short({"--duration", "1.5", "--record", scratch_ / "cut.lcmlog"}));
  ASSERT_EQ(run.Status(), 0) << run.Said();
  const auto records = RecordsOf(scratch_ / "cut.lcmlog");
  ASSERT_FALSE(records.empty());
  EXPECT_EQ(records.back().out.mode, Mode::kOff);
  EXPECT_FALSE(records.back().out.current.amplifiers_enabled);
  bool landed = false;
  bool spun = false;
  for (const auto& record : records) {
    landed = landed || record.out.mode == Mode::kLanding;
    spun = spun || record.out.mode == Mode::kSpinning;
  }
  EXPECT_TRUE(landed);
  EXPECT_FALSE(spun);
}

TEST_F(RunTest, CtrlCLandsTheRotor) {
  AmbRun run(scratch_, "run",
             {"--scenario", "run_up_6000", "--record", scratch_ / "stopped.lcmlog"});
  ASSERT_TRUE(run.Await("\nspinning ")) << run.Said();
  run.Signal(SIGINT);
  EXPECT_EQ(run.Status(), 1) << run.Said();
  EXPECT_THAT(run.Said(), HasSubstr("INCOMPLETE: stopped by the operator"));
  const auto records = RecordsOf(scratch_ / "stopped.lcmlog");
  ASSERT_FALSE(records.empty());
  EXPECT_EQ(records.back().out.mode, Mode::kOff);
  bool landed = false;
  for (const auto& record : records) landed = landed || record.out.mode == Mode::kLanding;
  EXPECT_TRUE(landed);
}

}  // namespace
}  // namespace levitas::cli
