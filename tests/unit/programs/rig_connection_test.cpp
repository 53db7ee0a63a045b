// Which network and which delay the port brings with it. Nothing here opens a socket.

#include "programs/controller/rig_connection.hpp"

#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "tests/support/paths.hpp"

namespace levitas::controller_program {
namespace {

configuration::RigFile Rig() {
  return configuration::LoadRig(levitas::test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
}

TEST(TelemetryNetwork, IsThatOfAPortWithLcm) {
  ControllerOptions options;
  options.port = "lcm:udpm://239.255.1.2:9000?ttl=0";
  const transport::LcmNetwork network = TelemetryNetwork(options);
  EXPECT_EQ(network.group, "239.255.1.2");
  EXPECT_EQ(network.base_port, 9000);
  EXPECT_EQ(network.key, nullptr);
}

TEST(TelemetryNetwork, WithCanIsTheOneOfTheOptionOrTheDefault) {
  ControllerOptions options;
  options.port = "can";
  EXPECT_EQ(TelemetryNetwork(options).base_port, transport::LcmNetwork{}.base_port);
  options.telemetry = "lcm:udpm://239.255.1.2:9004?ttl=0";
  EXPECT_EQ(TelemetryNetwork(options).base_port, 9004);
}

// Whoever reaches the network of the frames could play the rig.
TEST(TelemetryNetwork, ThatOtherMachinesReachIsRefusedWithoutAKeyWhereFramesAreOnIt) {
  ControllerOptions options;
  options.port = "lcm:udpm://239.255.1.2:9000?ttl=1";
  try {
    (void)TelemetryNetwork(options);
    FAIL() << "taken";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kUsage);
    EXPECT_NE(std::string(problem.what()).find("play the rig"), std::string::npos)
        << problem.what();
  }
  options.port = "can";
  options.telemetry = "lcm:udpm://239.255.1.2:9000?ttl=1";
  EXPECT_EQ(TelemetryNetwork(options).ttl, 1);  // only telemetry leaves
}

TEST(TelemetryNetwork, RefusesAPortThatNobodyTakesAndNamesTheFormsOfBoth) {
  ControllerOptions options;
  options.port = "ethercat";
  try {
    (void)TelemetryNetwork(options);
    FAIL() << "taken";
  } catch (const Problem& problem) {
    const std::string text = problem.what();
    EXPECT_EQ(problem.status(), ExitStatus::kUsage);
    EXPECT_NE(text.find("ethercat"), std::string::npos) << text;
    EXPECT_NE(text.find("can:IF"), std::string::npos) << text;
    EXPECT_NE(text.find("lcm"), std::string::npos) << text;
  }
}

TEST(ApplyPort, LeavesARigOverLcmAsItsFileSays) {
  configuration::RigFile rig = Rig();
  const double delay_samples = rig.plant.delay_samples;
  ControllerOptions options;
  ApplyPort(options, rig);
  EXPECT_EQ(rig.plant.delay_samples, delay_samples);
}

}  // namespace
}  // namespace levitas::controller_program
