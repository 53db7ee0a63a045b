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
