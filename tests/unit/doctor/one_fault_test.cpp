// Each way one thing of a machine can be wrong: its own check says so with a remedy that can be
// typed or done, and no other check changes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "doctor/checks.hpp"
#include "fake_probe.hpp"

namespace levitas::doctor {
namespace {

using testing::HasSubstr;

struct OneFault {
  const char* what;
  void (*spoil)(FakeProbe&);
  const char* check;
  State state;
  const char* found;
  const char* remedy;
};

const OneFault kFaults[] = {
    {"kernel not preemptible",
     [](FakeProbe& p) {
       p.files.erase("/sys/kernel/realtime");
       p.files["/proc/version"] = {"Linux version 6.1.0 SMP"};
     },
     "kernel", State::kDegraded, "not preemptible", "linux-image-rt-amd64"},
    {"kernel preemptible only",
     [](FakeProbe& p) {
       p.files["/sys/kernel/realtime"] = {"0"};
       p.files["/proc/version"] = {"Linux version 6.1.0 SMP PREEMPT_DYNAMIC"};
     },
     "kernel", State::kDegraded, "not PREEMPT_RT", "restart into it"},
    {"no SCHED_FIFO",
     [](FakeProbe& p) {
       p.fifo = {false, "EPERM"};
     },
     "scheduler", State::kMissing, "refused: EPERM", "rtprio"},
    {"no memory lock",
     [](FakeProbe& p) {
       p.memory = {false, "ENOMEM"};
     },
     "memory lock", State::kMissing, "64 MB cannot be locked: ENOMEM", "memlock unlimited"},
    {"one core", [](FakeProbe& p) { p.cores = 1; }, "cores", State::kDegraded, "shares it",
     "second core"},
    {"slow governor",
     [](FakeProbe& p) {
       p.files["/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor"] = {"schedutil"};
     },
     "frequency", State::kDegraded, "governor schedutil", "echo performance"},
    {"deep idle states forbidden to change",
     [](FakeProbe& p) { p.not_permitted = "/dev/cpu_dma_latency"; }, "idle states",
     State::kDegraded, "may not be written", "chmod"},
    {"no way to hold idle states", [](FakeProbe& p) { p.files.erase("/dev/cpu_dma_latency"); },
     "idle states", State::kDegraded, "does not exist", "processor.max_cstate=1"},
    {"real-time tasks throttled",
     [](FakeProbe& p) { p.files["/proc/sys/kernel/sched_rt_runtime_us"] = {"499999"}; },
     "throttling", State::kDegraded, "only 500 ms", "sched_rt_runtime_us=950000"},
    {"real-time tasks stopped",
     [](FakeProbe& p) { p.files["/proc/sys/kernel/sched_rt_runtime_us"] = {"0"}; }, "throttling",
     State::kMissing, "only 0 ms", "sysctl"},
    {"timer slack fixed",
     [](FakeProbe& p) {
       p.slack = {false, "EINVAL"};
     },
     "timer slack", State::kDegraded, "EINVAL", "sandbox"},
    {"late wake-ups", [](FakeProbe& p) { p.wake_ups.p99_us = 80.0; }, "wake-ups", State::kDegraded,
     "80.0 us (99 %)", "stop other load"},
    {"a third of the periods skipped", [](FakeProbe& p) { p.wake_ups.skipped_periods = 2500; },
     "wake-ups", State::kMissing, "2500 periods skipped", "machine that is not shared"},
    {"no multicast route", [](FakeProbe& p) { p.files["/proc/net/route"].resize(1); }, "route",
     State::kDegraded, "239.255.76.67", "ip route replace 224.0.0.0/4 dev lo"},
    {"multicast route to the network", [](FakeProbe& p) { p.files["/proc/net/route"].resize(2); },
     "route", State::kDegraded, "leaves through eth0", "ip route replace 224.0.0.0/4 dev lo"},
    {"group joined on a network card",
     [](FakeProbe& p) {
       p.files["/proc/net/igmp"] = {"2\teth0      :     1      V3",
                                    "\t\t\t\t434CFFEF     1 0:0\t\t0"};
     },
     "who may command", State::kDegraded, "on eth0", "--key FILE"},
    {"messages lost", [](FakeProbe& p) { p.multicast.received = 99; }, "loopback", State::kDegraded,
     "99 of 100", "stop other load"},
    {"no message came back",
     [](FakeProbe& p) {
       p.multicast = {100, 0, 0.0, "Network is unreachable"};
     },
     "loopback", State::kMissing, "0 of 100 messages came back: Network is unreachable",
     "firewall"},
    {"small socket buffer",
     [](FakeProbe& p) { p.files["/proc/sys/net/core/rmem_max"] = {"212992"}; }, "socket buffer",
     State::kDegraded, "at most 208 kB", "rmem_max=4194304"},
    {"socket buffer not visible",
     [](FakeProbe& p) { p.files.erase("/proc/sys/net/core/rmem_max"); }, "socket buffer",
     State::kDegraded, "container", "on the host"},
    {"CAN modules not loaded",
     [](FakeProbe& p) {
       p.can = {false, "EAFNOSUPPORT"};
       p.files["/lib/modules/6.1.0-rt/modules.builtin"] = {"kernel/net/can/can.ko"};
     },
     "sockets", State::kMissing, "not loaded (EAFNOSUPPORT)", "modprobe -a can"},
    {"no CAN interface",
     [](FakeProbe& p) {
       p.files.erase("/sys/class/net/can0/type");
       p.files.erase("/sys/class/net/can0/mtu");
     },
     "interfaces", State::kMissing, "no CAN interface", "vcan0"},
    {"classical CAN only", [](FakeProbe& p) { p.files["/sys/class/net/can0/mtu"] = {"16"}; },
     "interfaces", State::kDegraded, "can0: classical CAN only", "fd on"},
    {"no GPIO", [](FakeProbe& p) { p.files.erase("/dev/gpiochip0"); }, "chips", State::kMissing,
     "no /dev/gpiochip*", "CONFIG_GPIO_SIM"},
    {"GPIO forbidden", [](FakeProbe& p) { p.not_permitted = "/dev/gpiochip0"; }, "chips",
     State::kDegraded, "no permission for gpiochip0", "usermod -aG gpio"},
    {"little room on the disk", [](FakeProbe& p) { p.free_bytes = 1'799'999'999; }, "disk",
     State::kDegraded, "room for 599 s", "--record FILE"},
    {"disk full", [](FakeProbe& p) { p.free_bytes = 89'999'999; }, "disk", State::kMissing,
     "room for 29 s", "free space"},
    {"no such folder", [](FakeProbe& p) { p.free_bytes.reset(); }, "disk", State::kMissing,
     "cannot be used", "existing folder"},
};

std::map<std::string, Finding> ByName(const FakeProbe& probe) {
  std::map<std::string, Finding> found;
  for (const Finding& finding : CheckMachine(probe, "/records")) {
    EXPECT_TRUE(found.emplace(finding.check, finding).second) << finding.check << " twice";
  }
  return found;
}

TEST(OneFault, IsToldByItsOwnCheckWithARemedyAndByNoOther) {
  const auto fit = ByName(FakeProbe{});
  std::set<std::string> covered;
  for (const OneFault& fault : kFaults) {
    FakeProbe probe;
    fault.spoil(probe);
    const auto found = ByName(probe);
    ASSERT_EQ(found.size(), fit.size()) << fault.what;
    for (const auto& [check, finding] : found) {
      if (check == fault.check) {
        EXPECT_EQ(finding.state, fault.state) << fault.what;
        EXPECT_THAT(finding.found, HasSubstr(fault.found)) << fault.what;
        EXPECT_THAT(finding.remedy, HasSubstr(fault.remedy)) << fault.what;
      } else {
        EXPECT_EQ(finding.state, State::kOk) << fault.what << " also spoils " << check;
        EXPECT_EQ(finding.found, fit.at(check).found) << fault.what;
      }
    }
    covered.insert(fault.check);
  }
  for (const auto& [check, finding] : fit) {
    EXPECT_TRUE(covered.contains(check)) << check << " has no fault in this table";
  }
}

// Lockstep needs messages and room for the record; everything else is for real time or hardware.
TEST(OneFault, ForbidsLockstepOnlyWhereMessagesOrTheRecordAreLost) {
  const std::set<std::string> needed{"route", "loopback", "disk"};
  for (const OneFault& fault : kFaults) {
    FakeProbe probe;
    fault.spoil(probe);
    const bool forbids = fault.state == State::kMissing && needed.contains(fault.check);
    EXPECT_EQ(FitForLockstep(CheckMachine(probe, "/records")), !forbids) << fault.what;
  }
}

}  // namespace
}  // namespace levitas::doctor
