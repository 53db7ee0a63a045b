// Which buses --port can names, and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "hil/socketcan/can_connection.hpp"

namespace levitas::socketcan {
namespace {

using testing::HasSubstr;

configuration::RigFile Rig() {
  return configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
}
bool Real(const std::string& /*interface*/) { return false; }
bool Virtual(const std::string& /*interface*/) { return true; }

std::string RefusalOf(const configuration::RigFile& rig, const std::string& port, ExitStatus status,
                      bool (*is_virtual)(const std::string&) = Real) {
  try {
    static_cast<void>(PlanConnection(rig.numbers, rig.buses, "rig.yaml", port, is_virtual));
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), status);
    return problem.what();
  }
  return "not refused";
}

CanConnection Planned(const configuration::RigFile& rig, const std::string& port,
                      bool (*is_virtual)(const std::string&)) {
  return PlanConnection(rig.numbers, rig.buses, "rig.yaml", port, is_virtual);
}

/// The rig's delay in periods with its buses between.
double DelayOf(const configuration::RigFile& rig) {
  return DelayOnBuses(rig.plant.delay_samples, rig.numbers, Planned(rig, "can", Real).budget);
}

TEST(CanConnection, TakesTheInterfacesOfTheRigsFileForPortCan) {
  const CanConnection connection = Planned(Rig(), "can", Real);
  ASSERT_EQ(connection.buses.size(), 2U);
  EXPECT_EQ(connection.buses[0].interface, "can0");
  EXPECT_EQ(connection.buses[1].interface, "can1");
  EXPECT_FALSE(connection.virtual_bus);
}

TEST(CanConnection, TakesNamedInterfacesInTheOrderOfTheBuses) {
  const CanConnection connection = Planned(Rig(), "can:a,b", Real);
  EXPECT_EQ(connection.buses[0].interface, "a");
  EXPECT_EQ(connection.buses[1].interface, "b");
  EXPECT_EQ(connection.text, "can:a (positions),b (currents)");
}

TEST(CanConnection, OneVirtualInterfaceStandsForBothBuses) {
  const CanConnection connection = Planned(Rig(), "can:vcan0", Virtual);
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
  configuration::RigFile rig = Rig();
  rig.numbers.period_ns = 50'000;
  EXPECT_THAT(RefusalOf(rig, "can:vcan0", ExitStatus::kBadInput, Virtual),
              HasSubstr("the loop at 20000 Hz would load it to 145.2 %"));
}

TEST(CanConnection, RefusesARigWithoutBuses) {
  configuration::RigFile rig = Rig();
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

// The instants of docs/real_rig.md at 100 us: 72.6 us of positions, 30 us until the controller
// wakes, 5 us until it has answered, 64.6 us of currents.
TEST(BusDelay, OfACurrentThatActsOnArrivalHoldsTheWayThereAndTheController) {
  configuration::RigFile rig = Rig();
  rig.buses[1].current_acts = can::Acts::kOnArrival;
  EXPECT_NEAR(DelayOf(rig), 1.722, 1e-9);
}

TEST(BusDelay, OfACurrentThatActsAtTheNextSampleIsWholePeriods) { EXPECT_EQ(DelayOf(Rig()), 2.0); }

TEST(BusDelay, LeavesALongerDelayOfTheRigsFile) {
  configuration::RigFile rig = Rig();
  rig.plant.delay_samples = 2.5;
  EXPECT_EQ(DelayOf(rig), 2.5);
}

TEST(BusDelay, OfOneBusForBothDirectionsTakesWhatTheCurrentsBusSays) {
  configuration::RigFile rig = Rig();
  rig.numbers.period_ns = 500'000;  // one bus carries that
  rig.buses[1].current_acts = can::Acts::kOnArrival;
  const can::LoopDelay delay = can::DelayOf(Planned(rig, "can:a", Real).budget);
  EXPECT_EQ(delay.hold_s, 0.0);
  EXPECT_NEAR(delay.total_s(), 172.2e-6, 1e-9);
}

LinkKind Wired(const std::string& interface) {
  if (interface.starts_with("no")) return LinkKind::kAbsent;
  return interface.starts_with("v") ? LinkKind::kVirtual : LinkKind::kReal;
}

TEST(LinkKind, IsVirtualOnlyByTheDriversVcanAndVxcan) {
  EXPECT_EQ(KindOf("vcan"), LinkKind::kVirtual);
  EXPECT_EQ(KindOf("vxcan"), LinkKind::kVirtual);
  for (const char* driver : {"", "can", "slcan", "dummy", "veth", "vcan0"}) {
    EXPECT_EQ(KindOf(driver), LinkKind::kReal) << driver;
  }
}

// The loopback interface is there on every machine, and sysfs lists it among the virtual devices.
TEST(LinkKind, IsAskedOfTheKernel) {
  EXPECT_EQ(FindLink("lo"), LinkKind::kReal);
  EXPECT_EQ(FindLink("nolink0"), LinkKind::kAbsent);
  EXPECT_FALSE(IsVirtual("lo"));
  EXPECT_FALSE(IsVirtual("nolink0"));
}

TEST(RealInterface, IsTheFirstThatIsThereAndNotVirtual) {
  EXPECT_EQ(RealInterface(Rig().buses, "can:v0,can5", Wired), "can5");
  EXPECT_EQ(RealInterface(Rig().buses, "can", Wired), "can0");  // of the rig's file
  EXPECT_EQ(RealInterface(Rig().buses, "can:v0,v1", Wired), "");
  EXPECT_EQ(RealInterface(Rig().buses, "can:no0,v1", Wired), "");
}

TEST(Lockstep, IsRefusedOnAWireAndNamesThePaceThatIsAllowed) {
  try {
    RefuseLockstep(Rig().buses, "can:v0,can5", Wired);
    FAIL() << "not refused";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kUsage);
    EXPECT_THAT(problem.what(), HasSubstr("can5 is no virtual CAN bus"));
    EXPECT_THAT(problem.what(), HasSubstr("allowed: --pace realtime"));
  }
  EXPECT_NO_THROW(RefuseLockstep(Rig().buses, "can:v0", Wired));
}

}  // namespace
}  // namespace levitas::socketcan
