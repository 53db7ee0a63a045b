// amb run as a person starts it: bad input, trips, and programs that die or hang.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "tests/process/run/amb_run.hpp"
#include "tests/support/paths.hpp"

namespace levitas::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RunFailureTest : public testing::Test {
 protected:
  /// A copy of a shipped file with `from` replaced by `to`.
  std::string Changed(const std::string& shipped, const std::regex& from, const std::string& to) {
    const std::string path = scratch_ / std::regex_replace(shipped, std::regex("/"), "_");
    const std::string text = ReadAll(levitas::test::SourceFolder() + "/config/" + shipped);
    const std::string changed = std::regex_replace(text, from, to);
    EXPECT_NE(text, changed);
    std::ofstream(path) << changed;
    return path;
  }

  test::ScratchFolder scratch_;
};

TEST_F(RunFailureTest, ListsTheProblemsOfAllThreeFilesAtOnce) {
  const std::string rig =
      Changed("rigs/flexible_rotor.yaml", std::regex("noise_rms_um: 1"), "noise_rms_um: -1");
  const std::string controller =
      Changed("controllers/flexible_rotor.yaml", std::regex("lift_ramp_s"), "lift_rmap_s");
  std::ofstream(scratch_ / "scenario.yaml") << "kind: scenario\nname: bad\nsteps:\n  - do: fly\n";
  AmbRun run(scratch_, "run",
             {"--rig", rig, "--controller", controller, "--scenario", scratch_ / "scenario.yaml"});
  EXPECT_EQ(run.Status(), 3);
  EXPECT_THAT(run.Said(), AllOf(HasSubstr("noise_rms_um"), HasSubstr("lift_rmap_s"),
                                HasSubstr("fly"), HasSubstr("scenario.yaml")));
  EXPECT_THAT(run.Said(), Not(HasSubstr("self_test")));  // nothing was started
}

TEST_F(RunFailureTest, NamesFilesThatDoNotExist) {
  AmbRun run(scratch_, "run", {"--rig", "flexible_rotr", "--scenario", "nowhere"});
  EXPECT_EQ(run.Status(), 3);
  EXPECT_THAT(run.Said(), AllOf(HasSubstr("flexible_rotr"), HasSubstr("nowhere")));
}

// Both directions of 10 kHz on one bus of 5 Mbit/s; the budget's own figures are in its unit tests.
TEST_F(RunFailureTest, RefusesABusThatCannotCarryTheLoopBeforeAnythingStarts) {
  AmbRun run(scratch_, "run", {"--port", "can:can0"});
  EXPECT_EQ(run.Status(), 3);
  EXPECT_THAT(run.Said(), AllOf(HasSubstr("10000 Hz would load it"), HasSubstr("Hz fits")));
  EXPECT_THAT(run.Said(), Not(HasSubstr("self_test")));
}

TEST_F(RunFailureTest, RefusesOptionsThatMakeNoSense) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--pace", "hurry"},
                                                    {"--duration", "-1"},
                                                    {"--duration", "nan"},
                                                    {"--port", "tcp:7"},
                                                    {"--seed", "x"},
                                                    {"--seed", "9223372036854775808"},
                                                    {"--nonsense"}}) {
    AmbRun run(scratch_, "run", arguments);
    EXPECT_EQ(run.Status(), 2) << arguments.front() << "\n" << run.Said();
  }
}

// The loopback interface is no virtual CAN bus: for what may be a rig, like any chip's.
TEST_F(RunFailureTest, LockstepIsRefusedWhereARealRigMayBe) {
  AmbRun run(scratch_, "run", {"--port", "can:lo", "--pace", "lockstep"});
  EXPECT_EQ(run.Status(), 2) << run.Said();
  EXPECT_THAT(run.Said(), HasSubstr("allowed: --pace realtime"));
  AmbRun nowhere(scratch_, "run", {"--no-simulated-rig"});
  EXPECT_EQ(nowhere.Status(), 2) << nowhere.Said();
  EXPECT_THAT(nowhere.Said(), HasSubstr("needs --port"));
}

// Without a law that exceeds the magnets' negative stiffness nothing lifts (ki Kp < ks); the other
// half of the pair is RunTest.LevitatesJudgesAndLeavesNothingBehind.
TEST_F(RunFailureTest, ATripIsStatusFourAndItsRecordIsKeptAndNamed) {
  const std::string controller = Changed("controllers/flexible_rotor.yaml",
                                         std::regex("kp_a_per_m: [0-9.]+"), "kp_a_per_m: 1000");
  AmbRun run(scratch_, "run", {"--controller", controller, "--json", scratch_ / "verdict.json"});
  EXPECT_EQ(run.Status(), 4) << run.Said();
  EXPECT_THAT(run.Said(), HasSubstr("\nTRIPPED"));
  const auto json = nlohmann::json::parse(ReadAll(scratch_ / "verdict.json"));
  EXPECT_EQ(json["verdict"], "tripped");
  EXPECT_TRUE(std::filesystem::exists(json["provenance"]["session_file"].get<std::string>()));
  EXPECT_TRUE(std::filesystem::exists(json["trip"]["file"].get<std::string>()));
  // A trip file starts in the middle of a run: it is exported, not replayed.
  EXPECT_THAT(run.Said(), HasSubstr("amb export " + json["trip"]["file"].get<std::string>()));
}

TEST_F(RunFailureTest, ARecordThatNamesAFolderIsRefusedBeforeAnythingStarts) {
  AmbRun run(scratch_, "run", {"--record", scratch_ / ""});
  EXPECT_EQ(run.Status(), 3) << run.Said();
  EXPECT_THAT(run.Said(), HasSubstr("it is a folder. Name a file in it."));
}

TEST_F(RunFailureTest, AKilledRigIsOneClearMessage) {
  AmbRun run(scratch_, "run", {"--scenario", "run_up_6000"});
  ASSERT_TRUE(run.Await("\nlevitating ")) << run.Said();
  const pid_t plant = run.ChildNamed("amb-plant");
  ASSERT_GT(plant, 0);
  kill(plant, SIGKILL);
  EXPECT_EQ(run.Status(), 1) << run.Said();
  EXPECT_THAT(run.Said(), HasSubstr("amb-plant was ended by signal 9 (Killed)"));
}

TEST_F(RunFailureTest, AKilledControllerIsOneClearMessageAndEndsTheRig) {
  AmbRun run(scratch_, "run", {"--scenario", "run_up_6000"});
  ASSERT_TRUE(run.Await("\nlevitating ")) << run.Said();
  const pid_t plant = run.ChildNamed("amb-plant");
  const pid_t controller = run.ChildNamed("amb-controller");
  ASSERT_GT(controller, 0);
  kill(controller, SIGKILL);
  EXPECT_EQ(run.Status(), 1) << run.Said();
  EXPECT_THAT(run.Said(), HasSubstr("amb-controller was ended by signal 9 (Killed)"));
  EXPECT_NE(kill(plant, 0), 0);
}

TEST_F(RunFailureTest, ChildrenDieWithARunThatIsKilled) {
  AmbRun run(scratch_, "run", {"--scenario", "run_up_6000"});
  ASSERT_TRUE(run.Await("\nlift ")) << run.Said();
  const pid_t plant = run.ChildNamed("amb-plant");
  const pid_t controller = run.ChildNamed("amb-controller");
  ASSERT_GT(plant, 0);
  ASSERT_GT(controller, 0);
  run.Signal(SIGKILL);
  EXPECT_EQ(run.Status(), 1009);
  const auto lives = [](pid_t pid) {
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string number;
    std::string name;
    std::string state;
    return (stat >> number >> name >> state) && state != "Z";
  };
  EXPECT_TRUE(test::Eventually([&] { return !lives(plant) && !lives(controller); }));
}

}  // namespace
}  // namespace levitas::cli
