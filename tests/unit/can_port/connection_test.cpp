// Which buses --port can names, and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "hil/socketcan/can_connection.hpp"

namespace levitas::socketcan {
namespace {

using testing::HasSubstr;

config::RigFile Rig() { return config::LoadRig(config::FindConfig("flexible_rotor", "rigs")); }
bool Real(const std::string& /*interface*/) { return false; }
bool Virtual(const std::string& /*interface*/) { return true; }

std::string RefusalOf(const config::RigFile& rig, const std::string& port, ExitStatus status,
                      bool (*is_virtual)(const std::string&) = Real) {
  try {
    static_cast<void>(PlanConnection(rig, "rig.yaml", port, is_virtual));
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), status);
    return problem.what();
  }
  return "not refused";
}

TEST(CanConnection, TakesTheInterfacesOfTheRigsFileForPortCan) {
  const CanConnection connection = PlanConnection(Rig(), "rig.yaml", "can", Real);
  ASSERT_EQ(connection.buses.size(), 2U);
  EXPECT_EQ(connection.buses[0].interface, "can0");
  EXPECT_EQ(connection.buses[1].interface, "can1");
  EXPECT_FALSE(connection.virtual_bus);
}

TEST(CanConnection, TakesNamedInterfacesInTheOrderOfTheBuses) {
  const CanConnection connection = PlanConnection(Rig(), "rig.yaml", "can:a,b", Real);
  EXPECT_EQ(connection.buses[0].interface, "a");
  EXPECT_EQ(connection.buses[1].interface, "b");
  EXPECT_EQ(connection.text, "can:a (positions),b (currents)");
}

TEST(CanConnection, OneVirtualInterfaceStandsForBothBuses) {
  const CanConnection connection = PlanConnection(Rig(), "rig.yaml", "can:vcan0", Virtual);
  ASSERT_EQ(connection.buses.size(), 2U);
  EXPECT_EQ(connection.buses[1].interface, "vcan0");
  EXPECT_TRUE(connection.virtual_bus);
  EXPECT_TRUE(connection.budget.fits());
}

TEST(CanConnection, OneRealInterfaceIsOneBusAndRefusedWithTheRateThatFits) {
  const std::string text = RefusalOf(Rig(), "can:can0", ExitStatus::kBadInput);
  EXPECT_THAT(text, HasSubstr("CAN bus positions and currents (FD, 1 / 5 Mbit/s)"));
  EXPECT_THAT(text, HasSubstr("140.7 %, allowed 80 %; at most 5684 Hz fits"));
}

TEST(CanConnection, SaysThatAnInterfaceIsMissingBeforeItJudgesItsLoad) {
  const std::string text = RefusalOf(Rig(), "can:absent0", ExitStatus::kBadInput);
  const auto missing = text.find("there is no interface absent0");
  ASSERT_NE(missing, std::string::npos) << text;
  EXPECT_LT(missing, text.find("140.7 %")) << text;
  EXPECT_THAT(text, HasSubstr("ip link add dev absent0 type vcan"));
}

TEST(CanConnection, RefusesALayoutThatDoesNotFitThoughTheInterfaceIsVirtual) {
  config::RigFile rig = Rig();
  rig.numbers.period_ns = 50'000;
  EXPECT_THAT(RefusalOf(rig, "can:vcan0", ExitStatus::kBadInput, Virtual),
              HasSubstr("the loop at 20000 Hz would load it to 145.2 %"));
}

TEST(CanConnection, RefusesARigWithoutBuses) {
  config::RigFile rig = Rig();
  rig.buses.clear();
  EXPECT_THAT(RefusalOf(rig, "can:can0", ExitStatus::kBadInput), HasSubstr("names no CAN buses"));
}

TEST(CanConnection, RefusesPortsThatCannotBeReadWithWhatIsAllowed) {
  for (const char* port :
       {"can:", "can:a,", "can:,a", "can:a b", "can:averyveryverylongname", "can:a,b,c"}) {
    EXPECT_THAT(RefusalOf(Rig(), port, ExitStatus::kUsage), HasSubstr("can:IF[,IF...]")) << port;
  }
}

TEST(CanConnection, KnowsItsOwnPorts) {
  EXPECT_TRUE(IsCanPort("can"));
  EXPECT_TRUE(IsCanPort("can:vcan0"));
  EXPECT_FALSE(IsCanPort("lcm"));
  EXPECT_FALSE(IsCanPort("canned"));
}

TEST(WireDelay, LengthensAShorterDelayAndLeavesALongerOne) {
  config::RigFile rig = Rig();
  const can::Budget budget = PlanConnection(rig, "rig.yaml", "can", Real).budget;
  ApplyWireDelay(rig, budget);
  EXPECT_NEAR(rig.plant.delay_samples, 1.372, 1e-9);  // 72.6 us and 64.6 us at 100 us
  rig.plant.delay_samples = 2.0;
  ApplyWireDelay(rig, budget);
  EXPECT_EQ(rig.plant.delay_samples, 2.0);
}

}  // namespace
}  // namespace levitas::socketcan
