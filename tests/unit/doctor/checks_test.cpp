#include "doctor/checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_probe.hpp"

namespace levitas::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The one finding of this name; a finding named "absent" when there is none.
Finding Get(const std::vector<Finding>& findings, const std::string& check) {
  for (const Finding& finding : findings) {
    if (finding.check == check) return finding;
  }
  return {{}, "absent", State::kMissing, "", ""};
}

TEST(Doctor, FindsNothingWrongOnAFitMachine) {
  for (const Finding& finding : CheckMachine(FakeProbe{}, "/")) {
    EXPECT_EQ(finding.state, State::kOk) << finding.check << ": " << finding.found;
    EXPECT_THAT(finding.remedy, IsEmpty()) << finding.check;
  }
}

TEST(Doctor, GivesARemedyForEverythingThatIsNotAsItShouldBe) {
  FakeProbe bare;
  bare.files.clear();
  bare.cores = 1;
  bare.free_bytes = 0;
  bare.fifo = bare.memory = bare.slack = bare.can = {false, "Operation not permitted"};
  bare.wake_ups = {};
  bare.multicast = {1, 0, 0.0, "Network is unreachable"};
  const auto findings = CheckMachine(bare, "/");
  EXPECT_FALSE(FitForLockstep(findings));
  for (const Finding& finding : findings) {
    EXPECT_EQ(finding.remedy.empty(), finding.state == State::kOk) << finding.check;
  }
}

TEST(DoctorRealTime, CallsAnOrdinaryPreemptibleKernelDegraded) {
  FakeProbe probe;
  probe.files.erase("/sys/kernel/realtime");
  probe.files["/proc/version"] = {"Linux version 6.1.0 SMP PREEMPT_DYNAMIC"};
  const Finding finding = Get(CheckRealTime(probe), "kernel");
  EXPECT_EQ(finding.state, State::kDegraded);
  EXPECT_THAT(finding.found, HasSubstr("preemptible but not PREEMPT_RT"));
  EXPECT_THAT(finding.remedy, HasSubstr("linux-image-rt-amd64"));
}

TEST(DoctorRealTime, KnowsARealTimeKernelByItsVersionAlone) {
  FakeProbe probe;
  probe.files.erase("/sys/kernel/realtime");
  EXPECT_EQ(Get(CheckRealTime(probe), "kernel").state, State::kOk);
}

TEST(DoctorRealTime, SaysThatFifoIsMissingWithTheReasonOfTheSystem) {
  FakeProbe probe;
  probe.fifo = {false, "Operation not permitted"};
  const auto findings = CheckRealTime(probe);
  EXPECT_EQ(Get(findings, "scheduler").state, State::kMissing);
  EXPECT_THAT(Get(findings, "scheduler").found, HasSubstr("Operation not permitted"));
  EXPECT_THAT(Get(findings, "scheduler").remedy, HasSubstr("rtprio"));
}

TEST(DoctorRealTime, NamesTheGovernorThatIsNotPerformanceEvenOnOneCore) {
  FakeProbe probe;
  probe.files["/sys/devices/system/cpu/cpu1/cpufreq/scaling_governor"] = {"powersave"};
  const Finding finding = Get(CheckRealTime(probe), "frequency");
  EXPECT_EQ(finding.state, State::kDegraded);
  EXPECT_THAT(finding.found, HasSubstr("powersave"));
}

TEST(DoctorRealTime, TellsAForbiddenIdleStateFileFromAnAbsentOne) {
  FakeProbe probe;
  probe.not_permitted = "/dev/cpu_dma_latency";
  EXPECT_THAT(Get(CheckRealTime(probe), "idle states").remedy, HasSubstr("chmod"));
  probe.files.erase("/dev/cpu_dma_latency");
  EXPECT_THAT(Get(CheckRealTime(probe), "idle states").remedy, HasSubstr("max_cstate"));
}

TEST(DoctorRealTime, AcceptsTheKernelsUsualThrottlingAndRefusesNone) {
  FakeProbe probe;
  const auto state = [&](const char* runtime_us) {
    probe.files["/proc/sys/kernel/sched_rt_runtime_us"] = {runtime_us};
    return Get(CheckRealTime(probe), "throttling").state;
  };
  EXPECT_EQ(state("-1"), State::kOk);
  EXPECT_EQ(state("950000"), State::kOk);
  EXPECT_EQ(state("100000"), State::kDegraded);
  EXPECT_EQ(state("0"), State::kMissing);
}

TEST(DoctorRealTime, JudgesWakeUpsByLatenessAndBySkippedPeriods) {
  FakeProbe probe;
  const auto state = [&](WakeUpTrial trial) {
    probe.wake_ups = trial;
    return Get(CheckRealTime(probe), "wake-ups").state;
  };
  EXPECT_EQ(state({true, 5000, 0, 5.0, 49.0, 90.0}), State::kOk);
  EXPECT_EQ(state({true, 5000, 0, 5.0, 51.0, 90.0}), State::kDegraded);      // half a period
  EXPECT_EQ(state({true, 4990, 10, 5.0, 20.0, 900.0}), State::kDegraded);    // 2 in 1000
  EXPECT_EQ(state({true, 4000, 1000, 5.0, 20.0, 9000.0}), State::kMissing);  // 1 in 5
  EXPECT_EQ(state({false, 5000, 0, 5.0, 20.0, 60.0}), State::kDegraded);     // without SCHED_FIFO
  EXPECT_EQ(state({}), State::kMissing);                                     // never woke
}

TEST(DoctorLcm, WithoutARouteOnlyTheToolsOfOthersAreLimitedAndTheRemedyIsARoute) {
  FakeProbe probe;
  probe.files["/proc/net/route"].resize(1);
  const auto findings = CheckLcm(probe);
  EXPECT_EQ(Get(findings, "route").state, State::kDegraded);
  EXPECT_THAT(Get(findings, "route").remedy, HasSubstr("ip route replace 224.0.0.0/4 dev lo"));
  EXPECT_TRUE(FitForLockstep(findings));
}

TEST(DoctorLcm, WithoutALoopbackInterfaceLockstepIsNotPossible) {
  FakeProbe probe;
  probe.multicast = {1, 0, 0.0, "Network is unreachable"};
  EXPECT_FALSE(FitForLockstep(CheckLcm(probe)));
  EXPECT_THAT(Get(CheckLcm(probe), "loopback").remedy, HasSubstr("ip link set lo up"));
}

TEST(DoctorLcm, TakesTheNarrowestRouteForMulticastAndIgnoresThoseThatAreDown) {
  FakeProbe probe;
  const auto finding = [&](std::vector<std::string> lines) {
    lines.insert(lines.begin(), "header");
    probe.files["/proc/net/route"] = std::move(lines);
    return Get(CheckLcm(probe), "route");
  };
  // 224.0.0.0 with mask 240.0.0.0, as a little-endian kernel prints it.
  const std::string on_loopback = "lo 000000E0 00000000 0001 0 0 0 000000F0 0 0 0";
  const std::string by_default = "eth0 00000000 010200C0 0003 0 0 0 00000000 0 0 0";
  EXPECT_EQ(finding({on_loopback}).state, State::kOk);
  EXPECT_EQ(finding({by_default, on_loopback}).state, State::kOk);
  EXPECT_EQ(finding({on_loopback, by_default}).state, State::kOk);
  EXPECT_THAT(finding({by_default}).found, HasSubstr("eth0"));
  EXPECT_THAT(finding({"lo 000000E0 00000000 0000 0 0 0 000000F0 0 0 0"}).found,
              HasSubstr("no route"));  // down
  EXPECT_THAT(finding({"eth0 000200C0 00000000 0001 0 0 0 00FFFFFF 0 0 0"}).found,
              HasSubstr("no route"));  // of another network
  EXPECT_THAT(finding({"nonsense"}).found, HasSubstr("no route"));
}

TEST(DoctorLcm, SaysWhoCouldCommandAndWhichPortsAreBound) {
  FakeProbe probe;
  EXPECT_EQ(Get(CheckLcm(probe), "who may command").state, State::kOk);
  EXPECT_THAT(Get(CheckLcm(probe), "who may command").found, HasSubstr("no other machine"));
  probe.files["/proc/net/udp"] = {
      "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid",
      "  1: 434CFFEF:1DF6 00000000:0000 07 00000000:00000000 00:00000000 00000000     0",
      "  2: 0100007F:0035 00000000:0000 07 00000000:00000000 00:00000000 00000000     0",
      "  3: 434CFFEF:1DF3 00000000:0000 07 00000000:00000000 00:00000000 00000000     0"};
  EXPECT_THAT(Get(CheckLcm(probe), "who may command").found,
              HasSubstr("bound now: UDP 7667, 7670"));
}

TEST(DoctorLcm, WarnsOfAProgramThatHasJoinedTheGroupOnANetworkCard) {
  const std::vector<std::string> on_loopback{
      "Idx\tDevice    : Count Querier\tGroup    Users Timer", "1\tlo        :     2      V3",
      "\t\t\t\t434CFFEF     1 0:00000000\t\t0", "\t\t\t\t010000E0     1 0:00000000\t\t0"};
  FakeProbe probe;
  probe.files["/proc/net/igmp"] = on_loopback;
  EXPECT_EQ(Get(CheckLcm(probe), "who may command").state, State::kOk);
  auto& lines = probe.files["/proc/net/igmp"];
  lines.emplace_back("2\teth0      :     2      V3");
  lines.emplace_back("\t\t\t\t434CFFEF     1 0:00000000\t\t0");
  EXPECT_EQ(Get(CheckLcm(probe), "who may command").state, State::kDegraded);
  EXPECT_THAT(Get(CheckLcm(probe), "who may command").found, HasSubstr("on eth0"));
}

TEST(DoctorLcm, SaysHowManyMessagesCameBack) {
  FakeProbe probe;
  probe.multicast = {100, 93, 20.0, ""};
  const Finding finding = Get(CheckLcm(probe), "loopback");
  EXPECT_EQ(finding.state, State::kDegraded);
  EXPECT_THAT(finding.found, HasSubstr("93 of 100"));
}

TEST(DoctorLcm, CallsASmallSocketBufferDegraded) {
  FakeProbe probe;
  probe.files["/proc/sys/net/core/rmem_max"] = {"212992"};
  EXPECT_EQ(Get(CheckLcm(probe), "socket buffer").state, State::kDegraded);
  EXPECT_TRUE(FitForLockstep(CheckLcm(probe)));
}

TEST(DoctorCan, TellsModulesNotLoadedFromAKernelWithoutCan) {
  FakeProbe probe;
  probe.can = {false, "Address family not supported by protocol"};
  EXPECT_THAT(Get(CheckCan(probe), "sockets").remedy, HasSubstr("linux-image-amd64"));
  probe.files["/lib/modules/6.1.0-rt/modules.dep"] = {"kernel/net/can/can.ko:"};
  EXPECT_THAT(Get(CheckCan(probe), "sockets").remedy, HasSubstr("modprobe"));
}

TEST(DoctorCan, CallsAnInterfaceWithoutFdDegradedAndNamesIt) {
  FakeProbe probe;
  probe.files["/sys/class/net/can0/mtu"] = {"16"};
  const Finding finding = Get(CheckCan(probe), "interfaces");
  EXPECT_EQ(finding.state, State::kDegraded);
  EXPECT_THAT(finding.remedy, HasSubstr("ip link set can0 type can"));
}

TEST(DoctorCan, DoesNotTakeAnEthernetPortForACanInterface) {
  FakeProbe probe;
  probe.files["/sys/class/net/can0/type"] = {"1"};
  EXPECT_EQ(Get(CheckCan(probe), "interfaces").state, State::kMissing);
}

TEST(DoctorGpio, NamesTheChipsWithoutPermission) {
  FakeProbe probe;
  probe.files["/dev/gpiochip1"] = {};
  probe.not_permitted = "/dev/gpiochip1";
  const Finding finding = Get(CheckGpio(probe), "chips");
  EXPECT_EQ(finding.state, State::kDegraded);
  EXPECT_EQ(finding.found, "no permission for gpiochip1");
}

TEST(DoctorGpio, OffersTheSimulatorOnlyWhereTheKernelHasIt) {
  FakeProbe probe;
  probe.files.erase("/dev/gpiochip0");
  EXPECT_THAT(Get(CheckGpio(probe), "chips").remedy, HasSubstr("CONFIG_GPIO_SIM"));
  probe.files["/lib/modules/6.1.0-rt/modules.dep"] = {"kernel/drivers/gpio/gpio-sim.ko:"};
  EXPECT_THAT(Get(CheckGpio(probe), "chips").remedy, HasSubstr("modprobe gpio-sim"));
}

TEST(DoctorStorage, JudgesTheDiskByTheRecordingItHasRoomFor) {
  FakeProbe probe;
  const auto state = [&](std::optional<std::uint64_t> bytes) {
    probe.free_bytes = bytes;
    return Get(CheckStorage(probe, "/"), "disk").state;
  };
  EXPECT_EQ(state(10'000'000'000), State::kOk);
  EXPECT_EQ(state(200'000'000), State::kDegraded);  // a minute at 3 MB per second
  EXPECT_EQ(state(1'000'000), State::kMissing);
  EXPECT_EQ(state(std::nullopt), State::kMissing);
}

TEST(Findings, TheWorstOfAnAreaCountsAndOnlyThere) {
  const std::vector<Finding> findings{{Area::kLcm, "a", State::kOk, "", ""},
                                      {Area::kCan, "b", State::kMissing, "", ""},
                                      {Area::kLcm, "c", State::kDegraded, "", ""}};
  EXPECT_EQ(Worst(findings, Area::kLcm), State::kDegraded);
  EXPECT_EQ(Worst(findings, Area::kGpio), State::kOk);
  EXPECT_THAT(ChecksIn(findings, Area::kLcm, State::kDegraded), ElementsAre("c"));
  EXPECT_TRUE(FitForLockstep(findings));
}

}  // namespace
}  // namespace levitas::doctor
