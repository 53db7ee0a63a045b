#include "programs/controller/report.hpp"

#include <gtest/gtest.h>

#include <string>

namespace levitas::controller_program {
namespace {

/// A run of which nothing is to be told but its cycles.
class Report : public testing::Test {
 protected:
  [[nodiscard]] RunFacts Facts() const {
    return {.options = options_,
            .statistics = statistics_,
            .port = {},
            .transport = {},
            .commands = {},
            .trip_file = {},
            .scenario_problem = {},
            .real_time = real_time_};
  }
  [[nodiscard]] static bool Holds(const RunFacts& facts, const std::string& text) {
    return ReportText(facts).find(text) != std::string::npos;
  }

  ControllerOptions options_;
  loop::LoopStatistics statistics_;
  std::vector<rt::RealTimeFact> real_time_;
};

TEST_F(Report, OfAQuietRunSaysCyclesAndComputationAndNothingElse) {
  statistics_.cycles = 1234;
  const std::string text = ReportText(Facts());
  EXPECT_TRUE(text.starts_with("1234 cycles, 0 skipped")) << text;
  EXPECT_NE(text.find("computation"), std::string::npos);
  for (const char* absent : {"wake-up", "tripped", "reduced", "overruns", "lines"}) {
    EXPECT_EQ(text.find(absent), std::string::npos) << absent << ": " << text;
  }
}

TEST_F(Report, SpeaksOfWakeUpsOnlyAtTheRealTimePace) {
  options_.realtime = true;
  EXPECT_TRUE(Holds(Facts(), "wake-up error"));
  EXPECT_EQ(ReportJson(Facts())["pace"], "realtime");
  options_.realtime = false;
  EXPECT_FALSE(Holds(Facts(), "wake-up error"));
  EXPECT_EQ(ReportJson(Facts())["pace"], "lockstep");
}

TEST_F(Report, NamesTheFirstFaultAndWhereItsTripIsRecorded) {
  RunFacts facts = Facts();
  facts.trips = 2;
  facts.first_fault = Fault::kOrbitExceeded;
  facts.trip_file = "trips/a.levitas";
  EXPECT_TRUE(Holds(facts, "tripped: orbit_exceeded, recorded in trips/a.levitas"));
  EXPECT_EQ(ReportJson(facts)["first_fault"], "orbit_exceeded");
  EXPECT_EQ(ReportJson(facts)["trips"], 2);
  facts.trip_file = "";
  EXPECT_FALSE(Holds(facts, "recorded in"));
}

TEST_F(Report, AddsTheTwoSumsOfReducedTestSignals) {
  RunFacts facts = Facts();
  const auto at = [](scenario::Reduced why) { return static_cast<std::size_t>(why); };
  facts.signals_reduced.cycles[at(scenario::Reduced::kCurrentSum)] = 10;
  facts.signals_reduced.cycles[at(scenario::Reduced::kShiftSum)] = 4;
  facts.signals_reduced.cycles[at(scenario::Reduced::kRadius)] = 3;
  EXPECT_TRUE(Holds(facts, "sum too large 14, cut off 3, orbit limit 0 cycles"))
      << ReportText(facts);
  const auto json = ReportJson(facts)["test_signals"];
  EXPECT_EQ(json["cycles_reduced_current_sum"], 10);
  EXPECT_EQ(json["cycles_reduced_shift_sum"], 4);
  EXPECT_EQ(json["cycles_cut_off"], 3);
  EXPECT_EQ(json["cycles_beyond_orbit_limit"], 0);
}

TEST_F(Report, BlamesTheStagesThatCausedOverrunsAndNoOther) {
  statistics_.overruns = 3;
  statistics_.blamed[static_cast<std::size_t>(cycle::Stage::kLaw)] = 3;
  const std::string text = ReportText(Facts());
  const std::size_t line = text.find("overruns");
  ASSERT_NE(line, std::string::npos) << text;
  const std::string blamed = text.substr(line, text.find('\n', line) - line);
  EXPECT_NE(blamed.find("law"), std::string::npos) << blamed;
  EXPECT_EQ(blamed.find("write"), std::string::npos) << blamed;
  EXPECT_EQ(ReportJson(Facts())["timing"]["blamed"]["law"], 3);
}

TEST_F(Report, TakesTimeFromTheFirstCycleToTheLast) {
  statistics_.first_ns = 1'000'000'000;
  statistics_.last_ns = 3'500'000'000;
  EXPECT_DOUBLE_EQ(ReportJson(Facts())["wall_s"].get<double>(), 2.5);
}

TEST_F(Report, CountsWhatThePortAndTheNetworkLost) {
  RunFacts facts = Facts();
  facts.port = {.frames_read = 1,
                .frames_skipped = 2,
                .frames_rejected = 3,
                .frames_refused = 4,
                .frames_lost = 5,
                .currents_written = 6,
                .write_failures = 7};
  facts.commands = {.rejected = 8, .old = 9, .overtaken = 10, .dropped = 11};
  const auto json = ReportJson(facts);
  EXPECT_EQ(json["frames_read"], 1);
  EXPECT_EQ(json["frames_skipped"], 2);
  EXPECT_EQ(json["frames_rejected"], 3);
  EXPECT_EQ(json["frames_refused"], 4);
  EXPECT_EQ(json["messages_lost"], 5);
  EXPECT_EQ(json["currents_written"], 6);
  EXPECT_EQ(json["write_failures"], 7);
  EXPECT_EQ(json["commands_rejected"], 8);
  EXPECT_EQ(json["commands_old"], 9);
  EXPECT_EQ(json["commands_overtaken"], 10);
  EXPECT_EQ(json["commands_dropped"], 11);
}

TEST_F(Report, HoldsLinesAndDelayOnlyWhereThereAreAny) {
  EXPECT_FALSE(ReportJson(Facts()).contains("lines"));
  EXPECT_FALSE(ReportJson(Facts()).contains("delay"));
  RunFacts facts = Facts();
  const gpio::LineCounters lines{.stops = 2, .enables = 1, .pulses = {}};
  facts.lines = &lines;
  EXPECT_EQ(ReportJson(facts)["lines"]["stops"], 2);
  EXPECT_EQ(ReportJson(facts)["lines"]["enables"], 1);
}

TEST_F(Report, EndsWithWhatWentWrongInTheScenario) {
  RunFacts facts = Facts();
  facts.scenario_problem = "scenario lift, step 1 of 2 (lift): refused";
  EXPECT_TRUE(ReportText(facts).ends_with("scenario lift, step 1 of 2 (lift): refused\n"));
}

}  // namespace
}  // namespace levitas::controller_program
