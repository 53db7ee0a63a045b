#include "dashboard/scope_controller.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "batches.hpp"

namespace levitas::dashboard {
namespace {

using nlohmann::json;
using testing::HasSubstr;

RigNumbers RangedRig() {
  RigNumbers rig = SmallRig();
  rig.sensor_range_m = 400e-6;
  rig.max_coil_current_a = 6.0;
  return rig;
}

json Armed() {
  return {{"do", "arm"},       {"source", "position"}, {"channel", "de_y"},     {"level_um", -5.0},
          {"edge", "falling"}, {"length_ms", 20.0},    {"before_percent", 25.0}};
}

TEST(UnderstandScope, TurnsTimesIntoSamplesOfTheRig) {
  const ScopeSettings settings = UnderstandScope(Armed().dump(), RangedRig());
  EXPECT_EQ(settings.axis, 1U);
  EXPECT_DOUBLE_EQ(settings.level, -5e-6);
  EXPECT_EQ(settings.edge, ScopeEdge::kFalling);
  EXPECT_EQ(settings.samples, 201U);  // 20 ms at 10 kHz, both ends
  EXPECT_EQ(settings.before, 50U);
}

TEST(UnderstandScope, NamesTheOneThingThatIsWrong) {
  struct Bad {
    const char* key;
    json value;
    const char* words;
  };
  for (const auto& [key, value, words] :
       {Bad{"source", "magic", "position, current, trip, now"},
        Bad{"channel", "top_x", "de_x, de_y"}, Bad{"channel", 3, "channel"},
        Bad{"level_um", 401.0, "allowed -400 to 400"}, Bad{"level_um", "5", "level_um"},
        Bad{"level_um", nullptr, "level_um"}, Bad{"edge", "sharp", "rising, falling, either"},
        Bad{"length_ms", 0.0, "0.1 to"}, Bad{"length_ms", -1.0, "length_ms"},
        Bad{"length_ms", 1e9, "length_ms"}, Bad{"length_ms", 4000.0, "32768 samples"},
        Bad{"before_percent", 96.0, "allowed 0 to 95"}, Bad{"colour", "red", "not known"}}) {
    json request = Armed();
    request[key] = value;
    try {
      (void)UnderstandScope(request.dump(), RangedRig());
      ADD_FAILURE() << request;
    } catch (const std::invalid_argument& problem) {
      EXPECT_THAT(problem.what(), HasSubstr(words)) << request;
    }
  }
}

TEST(ScopeController, RefusesBeforeAnyRunIsKnown) {
  ScopeController desk;
  EXPECT_EQ(desk.Ask(Armed().dump()).status, 409);
  EXPECT_EQ(desk.CaptureJson().status, 404);
  EXPECT_EQ(desk.CaptureCsv().status, 404);
}

TEST(ScopeController, AnswersNonsenseWithOneMessage) {
  ScopeController desk;
  desk.RunIs(RangedRig());
  for (const char* bad : {"", "{", "[]", "7", "{}", R"({"do":"dance"})", R"({"do":"arm"})",
                          "{\"do\":\"\xff\"}", R"({"do":{"do":{"do":{"do":{"do":1}}}}})"}) {
    const HttpAnswer answer = desk.Ask(bad);
    EXPECT_EQ(answer.status, 400) << bad;
    EXPECT_FALSE(json::parse(answer.body)["text"].get<std::string>().empty()) << bad;
  }
}

/// A desk that has captured the step of 10 um at cycle 700.
struct Captured {
  SampleStore store{RangedRig()};
  ScopeController desk;
  Captured() {
    desk.RunIs(RangedRig());
    json request = Armed();
    request.update({{"channel", "de_x"}, {"level_um", 5.0}, {"edge", "rising"}});
    EXPECT_EQ(desk.Ask(request.dump()).status, 200);
    for (std::int64_t first = 0; first < 1280; first += 128) {
      store.Add(
          Batch(first, 128, [](std::int64_t cycle, int) { return cycle >= 700 ? 10e-6 : 0.0; }));
      desk.Advance(store);
    }
  }
};

TEST(ScopeController, GivesThePageWhatWasCaptured) {
  const Captured captured;
  const HttpAnswer answer = captured.desk.CaptureJson();
  ASSERT_EQ(answer.status, 200);
  const json capture = json::parse(answer.body);
  EXPECT_EQ(capture["trigger_cycle"], 700);
  EXPECT_EQ(capture["channels"], (json{"de_x", "de_y"}));
  EXPECT_EQ(capture["position_nm"][0].size(), 201U);
  EXPECT_EQ(capture["position_nm"][0][49], 0);
  EXPECT_EQ(capture["position_nm"][0][50], 10'000);
  EXPECT_EQ(capture["current_ua"][1][50], 10'000);  // batches carry 1000 A/m
}

TEST(ScopeController, GivesTheSameAsCsvInSiUnitsWithTimeFromTheTrigger) {
  const Captured captured;
  std::istringstream lines(captured.desk.CaptureCsv().body);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "cycle,time_s,speed_rad_per_s,position_de_x_m,position_de_y_m,"
            "control_current_de_x_a,control_current_de_y_a");
  std::getline(lines, line);
  EXPECT_EQ(line, "650,-0.005,100,0,0,0,0");
  for (int i = 0; i < 50; ++i) std::getline(lines, line);
  EXPECT_EQ(line, "700,0,100,1e-05,1e-05,0.01,0.01");
  int rows = 51;
  while (std::getline(lines, line)) ++rows;
  EXPECT_EQ(rows, 201);
}

TEST(ScopeController, TellsAChangeOnce) {
  Captured captured;
  const auto news = captured.desk.News();
  ASSERT_TRUE(news);
  const json state = json::parse(*news);
  EXPECT_EQ(state["state"], "captured");
  EXPECT_EQ(state["capture"], 1);
  EXPECT_FALSE(captured.desk.News());
  EXPECT_EQ(captured.desk.Ask(R"({"do":"stop"})").status, 200);
  EXPECT_EQ(json::parse(*captured.desk.News())["state"], "idle");
}

TEST(ScopeController, KeepsTheNewestCaptureAcrossAnotherRun) {
  Captured captured;
  RigNumbers other = RangedRig();
  other.channels = {"up", "down"};
  captured.desk.RunIs(other);
  const json capture = json::parse(captured.desk.CaptureJson().body);
  EXPECT_EQ(capture["channels"], (json{"de_x", "de_y"}));  // of the run it was taken from
}

}  // namespace
}  // namespace levitas::dashboard
