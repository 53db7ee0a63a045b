// The ends of a simulated rig's program: each is one exit status; nothing is thrown out of main.

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "programs/plant/plant_run.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::plant_run {
namespace {

constexpr PlantProgram kMain{"amb-plant", "a rig", "a port", "lcm", 1000, ""};

int MainWith(const std::function<ExitStatus(const PlantOptions&)>& run) {
  std::array<std::string, 3> words{"amb-plant", "--rig", "flexible_rotor"};
  std::array<char*, 3> argv{words[0].data(), words[1].data(), words[2].data()};
  return MainOf(kMain, static_cast<int>(argv.size()), argv.data(), run);
}

TEST(PlantMain, ReturnsTheStatusOfTheRun) {
  EXPECT_EQ(MainWith([](const PlantOptions&) { return ExitStatus::kDone; }), 0);
  EXPECT_EQ(MainWith([](const PlantOptions&) { return ExitStatus::kOther; }), 1);
}

TEST(PlantMain, HandsTheRunItsOptionsAndTheProgramsOwnDefaults) {
  PlantOptions seen;
  (void)MainWith([&seen](const PlantOptions& options) {
    seen = options;
    return ExitStatus::kDone;
  });
  EXPECT_EQ(seen.rig, "flexible_rotor");
  EXPECT_EQ(seen.port, "lcm");
  EXPECT_EQ(seen.watchdog_periods, 1000U);
}

TEST(PlantMain, TurnsAProblemIntoItsStatusAndAnyOtherExceptionInto1) {
  EXPECT_EQ(MainWith([](const PlantOptions&) -> ExitStatus { throw BadInput("a bad file"); }), 3);
  EXPECT_EQ(MainWith([](const PlantOptions&) -> ExitStatus {
              throw Problem(ExitStatus::kUsage, "a wrong word");
            }),
            2);
  EXPECT_EQ(
      MainWith([](const PlantOptions&) -> ExitStatus { throw std::runtime_error("unforeseen"); }),
      1);
}

TEST(PlantMain, WithoutARigRunsNothingAndSaysThatItIsAMistakeOfUse) {
  std::array<std::string, 1> words{"amb-plant"};
  std::array<char*, 1> argv{words[0].data()};
  bool ran = false;
  const int status = MainOf(kMain, 1, argv.data(), [&ran](const PlantOptions&) {
    ran = true;
    return ExitStatus::kDone;
  });
  EXPECT_EQ(status, static_cast<int>(ExitStatus::kUsage));
  EXPECT_FALSE(ran);
}

/// A line on which the same answer comes to everything.
class OneAnswer final : public port::RigLink {
 public:
  explicit OneAnswer(ReceiveResult answer) : answer_(answer) {}
  bool Send(const SensorFrame& /*frame*/) noexcept override {
    ++counters_.frames_sent;
    return true;
  }
  ReceiveResult Receive(CurrentFrame& frame, std::int64_t /*deadline_ns*/) noexcept override {
    frame = {};
    return answer_;
  }
  [[nodiscard]] Counters counters() const noexcept override { return counters_; }
  [[nodiscard]] std::string Trouble() const override { return "a loose plug"; }

 private:
  ReceiveResult answer_;
  Counters counters_;
};

class Run : public testing::Test {
 protected:
  ExitStatus With(port::RigLink& link) {
    options_.rig = "flexible_rotor";
    options_.json = folder_ / "plant.json";
    const configuration::RigFile rig =
        configuration::LoadRig(levitas::test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
    const ExitStatus status = RunPlant(
        {.program = kMain, .options = options_, .rig = rig, .link = link, .where = "nowhere"});
    std::ifstream file(options_.json);
    json_ = nlohmann::json::parse(file);
    return status;
  }
  levitas::test::ScratchFolder folder_;
  PlantOptions options_;
  nlohmann::json json_;
};

// Lockstep: without an answer the rig stands in its first period.
TEST_F(Run, WithoutAControllerEndsAfterTheTimeOutAndWritesWhatItCounted) {
  options_.partner_timeout_s = 1e-9;
  OneAnswer link(port::RigLink::ReceiveResult::kNothing);
  EXPECT_EQ(With(link), ExitStatus::kOther);
  EXPECT_EQ(json_["pace"], "lockstep");
  EXPECT_EQ(json_["cycles"], 0);
  EXPECT_GT(json_["frames_sent"], 0);
  EXPECT_EQ(json_["transport"], "a loose plug");
}

TEST_F(Run, WithAControllerThatSaysGoodbyeIsDone) {
  OneAnswer link(port::RigLink::ReceiveResult::kGoodbye);
  EXPECT_EQ(With(link), ExitStatus::kDone);
}

TEST_F(Run, RefusesAScenarioThatIsNotThere) {
  options_.scenario = "no_such_scenario";
  OneAnswer link(port::RigLink::ReceiveResult::kGoodbye);
  EXPECT_THROW((void)With(link), Problem);
}

}  // namespace
}  // namespace levitas::plant_run
