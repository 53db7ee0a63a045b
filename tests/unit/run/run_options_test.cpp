#include "cli/run/run_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

using testing::HasSubstr;

TEST(CheckPort, LeavesTheChoiceOfPortsOpenWhenNoneIsNamed) {
  EXPECT_FALSE(CheckPort("").has_value());
  ASSERT_TRUE(CheckPort("lcm").has_value());
  EXPECT_EQ(CheckPort("lcm")->base_port, 7667);
  EXPECT_EQ(CheckPort("lcm:udpm://239.255.76.67:9000?ttl=0")->base_port, 9000);
}

TEST(CheckPort, LeavesTheNetworkOfTelemetryOpenWhenTheRigIsOnCan) {
  for (const char* port : {"can", "can:can0", "can:vcan0,vcan1"}) {
    EXPECT_FALSE(CheckPort(port).has_value()) << port;
  }
}

TEST(CheckPort, RefusesAnotherTransportAsUsageWithWhatIsAllowed) {
  try {
    static_cast<void>(CheckPort("canal:can0"));
    ADD_FAILURE() << "canal:can0 was accepted";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kUsage);
    EXPECT_THAT(problem.what(), HasSubstr("lcm:udpm://"));
  }
}

configuration::RigFile Rig() {
  return configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
}

socketcan::LinkKind Wired(const std::string& interface) {
  return interface.starts_with("v") ? socketcan::LinkKind::kVirtual : socketcan::LinkKind::kReal;
}

TEST(SettleRig, SimulatesTheRigInLockstepOverLcmAndOnAVirtualBus) {
  for (const char* port : {"", "lcm", "can:vcan0"}) {
    RunOptions options;
    options.port = port;
    const RunOptions settled = SettleRig(options, Rig(), Wired);
    EXPECT_FALSE(settled.rig_is_there) << port;
    EXPECT_EQ(settled.pace, "lockstep") << port;
  }
}

TEST(SettleRig, StartsTheControllerAloneInRealTimeOnARealBus) {
  for (const char* port : {"can", "can:can0,can1", "can:vcan0,can1"}) {
    RunOptions options;
    options.port = port;
    const RunOptions settled = SettleRig(options, Rig(), Wired);
    EXPECT_TRUE(settled.rig_is_there) << port;
    EXPECT_EQ(settled.pace, "realtime") << port;
  }
}

TEST(SettleRig, RefusesLockstepOnARealBus) {
  RunOptions options;
  options.port = "can:can0,can1";
  options.pace = "lockstep";
  try {
    static_cast<void>(SettleRig(options, Rig(), Wired));
    ADD_FAILURE() << "lockstep was accepted";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kUsage);
    EXPECT_THAT(problem.what(), HasSubstr("--pace realtime"));
  }
}

TEST(SettleRig, NeedsAPortForARigThatIsSaidToBeThere) {
  RunOptions options;
  options.rig_is_there = true;
  EXPECT_THROW(static_cast<void>(SettleRig(options, Rig(), Wired)), Problem);
  options.port = "can:vcan0";
  EXPECT_EQ(SettleRig(options, Rig(), Wired).pace, "realtime");
  options.pace = "lockstep";  // somebody's simulated rig on a virtual bus
  EXPECT_EQ(SettleRig(options, Rig(), Wired).pace, "lockstep");
}

TEST(SettleRig, HoldsASimulatedRigToTheClockForThePageOrAFactor) {
  RunOptions page;
  page.page = PageWish::kAlways;
  EXPECT_EQ(SettleRig(page, Rig(), Wired).pace, "paced");
  page.pace = "lockstep";  // somebody knows better
  EXPECT_EQ(SettleRig(page, Rig(), Wired).pace, "lockstep");
  page.pace = "";
  page.port = "can:can0,can1";  // a real rig keeps its own time
  EXPECT_EQ(SettleRig(page, Rig(), Wired).pace, "realtime");
  RunOptions factor;
  factor.pace_factor = 0.2;
  EXPECT_EQ(SettleRig(factor, Rig(), Wired).pace, "paced");
}

TEST(SettleRig, RefusesAPaceThatNobodyHereCouldKeep) {
  const auto refusal = [](const RunOptions& options) -> std::string {
    try {
      static_cast<void>(SettleRig(options, Rig(), Wired));
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.status(), ExitStatus::kUsage);
      return problem.what();
    }
    return "accepted";
  };
  RunOptions factor;
  factor.pace = "realtime";
  factor.pace_factor = 2.0;
  EXPECT_THAT(refusal(factor), HasSubstr("--pace-factor is for --pace paced"));
  RunOptions elsewhere;
  elsewhere.pace = "paced";
  elsewhere.rig_is_there = true;
  elsewhere.port = "lcm";
  EXPECT_THAT(refusal(elsewhere), HasSubstr("none is started here"));
  RunOptions bus;
  bus.pace = "paced";
  bus.port = "can:can0,can1";
  EXPECT_THAT(refusal(bus), HasSubstr("--pace realtime"));
}

TEST(CheckFiles, FindsTheShippedDefaults) {
  const RunFiles files = CheckFiles(RunOptions{});
  EXPECT_EQ(files.rig.name, "flexible_rotor");
  EXPECT_EQ(files.scenario_name, "default");
  EXPECT_THAT(files.controller_path, testing::EndsWith("flexible_rotor_commissioned.yaml"));
}

TEST(CheckFiles, FindsWhatTheRigNamesUnlessOtherFilesAreAskedFor) {
  RunOptions options;
  options.rig = "geared_rotor_12dof";
  const RunFiles own = CheckFiles(options);
  EXPECT_THAT(own.controller_path, testing::EndsWith("/geared_rotor.yaml"));
  EXPECT_EQ(own.scenario_name, "geared_rotor");
  options.controller = "geared_rotor_passive";
  options.scenario = "levitate";
  const RunFiles asked = CheckFiles(options);
  EXPECT_THAT(asked.controller_path, testing::EndsWith("geared_rotor_passive.yaml"));
  EXPECT_EQ(asked.scenario_name, "levitate");
}

TEST(CheckFiles, CollectsTheProblemsOfAllFiles) {
  RunOptions options;
  options.rig = "no_rig";
  options.controller = "no_controller";
  options.scenario = "no_scenario";
  try {
    static_cast<void>(CheckFiles(options));
    FAIL() << "files that do not exist were accepted";
  } catch (const BadInput& problem) {
    for (const char* name : {"no_rig", "no_controller", "no_scenario"}) {
      EXPECT_THAT(problem.what(), HasSubstr(name));
    }
  }
}

TEST(ProgramBeside, NamesTheProgramThatIsMissing) {
  EXPECT_THROW(static_cast<void>(ProgramBeside("amb-nothing")), Problem);
}

}  // namespace
}  // namespace levitas::cli
