#include "doctor/system_probe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace levitas::doctor {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class SystemProbeFiles : public testing::Test {
 protected:
  SystemProbeFiles()
      : root_(std::filesystem::temp_directory_path() /
              ("levitas_probe_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(root_ / "sys/net");
    std::ofstream(root_ / "sys/net/can0") << "280\nsecond line\n";
    std::ofstream(root_ / "sys/net/eth0") << "";
  }
  ~SystemProbeFiles() override { std::filesystem::remove_all(root_); }

  std::filesystem::path root_;
};

TEST_F(SystemProbeFiles, ReadsBelowTheGivenRootOnly) {
  const SystemProbe probe(root_.string());
  EXPECT_EQ(probe.ReadLine("/sys/net/can0"), "280");
  EXPECT_THAT(probe.ReadLines("/sys/net/can0"), ElementsAre("280", "second line"));
  EXPECT_FALSE(probe.Exists("/proc/version"));
}

TEST_F(SystemProbeFiles, AnEmptyOrAbsentFileHasNoLine) {
  const SystemProbe probe(root_.string());
  EXPECT_EQ(probe.ReadLine("/sys/net/eth0"), std::nullopt);
  EXPECT_EQ(probe.ReadLine("/sys/net/absent"), std::nullopt);
  EXPECT_THAT(probe.ReadLines("/sys/net/absent"), IsEmpty());
}

TEST_F(SystemProbeFiles, ListsByPrefixInOrderAndAnAbsentFolderAsEmpty) {
  const SystemProbe probe(root_.string());
  EXPECT_THAT(probe.List("/sys/net", ""), ElementsAre("can0", "eth0"));
  EXPECT_THAT(probe.List("/sys/net", "can"), ElementsAre("can0"));
  EXPECT_THAT(probe.List("/nowhere", ""), IsEmpty());
}

TEST_F(SystemProbeFiles, KnowsTheRoomOfAFolderAndNoneOfAnAbsentOne) {
  const SystemProbe probe(root_.string());
  EXPECT_TRUE(probe.FreeBytes("/sys").has_value());
  EXPECT_FALSE(probe.FreeBytes("/absent").has_value());
}

TEST(SystemProbe, LeavesSchedulerAndTimerSlackOfTheCallerAsTheyWere) {
  const int scheduler_before = sched_getscheduler(0);
  const int slack_before = prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL);
  const SystemProbe probe;
  (void)probe.TakeFifo(80);
  (void)probe.SetTimerSlack();
  (void)probe.WakeUps(100'000, 1'000'000);
  EXPECT_EQ(sched_getscheduler(0), scheduler_before);
  EXPECT_EQ(prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL), slack_before);
}

TEST(SystemProbe, ARefusedTrialGivesTheReason) {
  const Trial trial = SystemProbe{}.TakeFifo(1000);  // priorities end at 99
  EXPECT_FALSE(trial.worked);
  EXPECT_EQ(trial.reason, "Invalid argument");
}

TEST(SystemProbe, CountsEveryPeriodOfTheTrialOnceAsWakeUpOrAsSkipped) {
  const WakeUpTrial trial = SystemProbe{}.WakeUps(100'000, 10'000'000);
  // 10 ms hold the grid points 1 to 99; a late last wake-up may skip points beyond the end.
  EXPECT_GE(trial.wake_ups + trial.skipped_periods, 99U);
  EXPECT_LE(trial.wake_ups, 99U);
  EXPECT_LE(trial.p50_us, trial.p99_us);
  EXPECT_LE(trial.p99_us, trial.max_us);
}

TEST(SystemProbe, NeverReceivesMoreThanItSent) {
  const MulticastTrial trial = SystemProbe{}.RoundTrips(5);
  EXPECT_LE(trial.sent, 5);
  EXPECT_LE(trial.received, trial.sent);
  EXPECT_EQ(trial.received == 0, !trial.reason.empty());
}

}  // namespace
}  // namespace levitas::doctor
