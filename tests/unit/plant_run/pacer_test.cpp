// A paced run keeps the clock's pace, whatever the machine does in between.

#include "plant_sim/loop/pacer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <string>
#include <vector>

#include "plant_sim/loop/plant_loop.hpp"
#include "programs/plant/plant_options.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant_run {
namespace {

constexpr std::int64_t kPacedPeriodNs = 100'000;

/// A machine that takes `work_ns` for each period and does as the pacer says; the clock after so
/// many periods, which begins at `now_ns`.
std::int64_t After(Pacer& pacer, std::uint64_t first, std::uint64_t periods, std::int64_t work_ns,
                   std::int64_t now_ns) {
  for (std::uint64_t cycle = first; cycle < first + periods; ++cycle) {
    now_ns = std::max(now_ns, pacer.Due(cycle, now_ns)) + work_ns;
  }
  return now_ns;
}

TEST(Pacer, TakesAsLongAsTheFactorSaysWithinOneBurst) {
  for (const double factor : {0.1, 1.0, 3.0}) {
    Pacer pacer(factor, kPacedPeriodNs);
    const double wanted_ns = 50'000 * static_cast<double>(kPacedPeriodNs) / factor;
    EXPECT_NEAR(static_cast<double>(After(pacer, 0, 50'000, 10'000, 0)), wanted_ns,
                static_cast<double>(Pacer::kBurstNs) + static_cast<double>(kPacedPeriodNs) / factor)
        << factor;
  }
}

TEST(Pacer, NeverRunsAheadOfTheClockByMoreThanABurst) {
  Pacer pacer(1.0, kPacedPeriodNs);
  std::int64_t now_ns = 1'000;
  for (std::uint64_t cycle = 0; cycle < 5'000; ++cycle) {
    now_ns = std::max(now_ns, pacer.Due(cycle, now_ns));
    const auto rig_ns = static_cast<std::int64_t>(cycle) * kPacedPeriodNs;
    ASSERT_LE(rig_ns - (now_ns - 1'000), Pacer::kBurstNs) << cycle;
  }
}

TEST(Pacer, SleepsOncePerBurstAndNotOncePerPeriod) {
  Pacer pacer(1.0, kPacedPeriodNs);
  std::int64_t now_ns = 0;
  int sleeps = 0;
  for (std::uint64_t cycle = 0; cycle < 10'000; ++cycle) {
    const std::int64_t due_ns = pacer.Due(cycle, now_ns);
    if (due_ns > now_ns) ++sleeps;
    now_ns = std::max(now_ns, due_ns);
  }
  EXPECT_LE(sleeps, 1'000'000'000 / Pacer::kBurstNs);  // one second of the rig
  EXPECT_GT(sleeps, 0);
}

TEST(Pacer, LetsASlowMachineRunWithoutSleeping) {
  Pacer pacer(1.0, kPacedPeriodNs);
  std::int64_t now_ns = 0;
  for (std::uint64_t cycle = 0; cycle < 5'000; ++cycle) {
    ASSERT_LE(pacer.Due(cycle, now_ns), now_ns) << cycle;
    now_ns += 2 * kPacedPeriodNs;
  }
}

// Harm without it: ten thousand periods, a whole second of the rig, as fast as the machine allows.
TEST(Pacer, DoesNotRaceAfterAStall) {
  Pacer pacer(1.0, kPacedPeriodNs);
  constexpr std::int64_t kWorkNs = 1'000;
  std::int64_t now_ns = After(pacer, 0, 1'000, kWorkNs, 0);
  now_ns += 1'000'000'000;
  const std::int64_t later_ns = After(pacer, 1'000, 10'000, kWorkNs, now_ns);
  EXPECT_GE(later_ns - now_ns, 1'000'000'000 - Pacer::kBurstNs - kPacedPeriodNs);
}

/// Time passes while somebody sleeps only.
class SleepersClock final : public rt::Clock {
 public:
  std::int64_t NowNs() noexcept override { return now_ns_; }
  void SleepUntil(std::int64_t due_ns) noexcept override { now_ns_ = std::max(now_ns_, due_ns); }

 private:
  std::int64_t now_ns_{1};
};

/// Answers every frame at once.
class WillingLink final : public port::RigLink {
 public:
  bool Send(const SensorFrame& frame) noexcept override {
    cycle_ = frame.cycle;
    if (cycle_ + 1 == periods) loop->Stop();
    return true;
  }
  ReceiveResult Receive(CurrentFrame& frame, std::int64_t /*deadline_ns*/) noexcept override {
    frame = {.cycle = cycle_, .axes = 4};
    return ReceiveResult::kCurrent;
  }
  [[nodiscard]] Counters counters() const noexcept override { return {}; }

  std::uint64_t periods{};
  PlantLoop* loop{};

 private:
  std::uint64_t cycle_{};
};

std::int64_t ClockAfter(std::uint64_t periods, double pace_factor) {
  plant::Plant plant(test::QuietFlexibleRotor(), 1);
  WillingLink link;
  SleepersClock clock;
  PlantLoop loop({.pace_factor = pace_factor, .period_ns = kPacedPeriodNs, .rig_session = 1}, plant,
                 link, clock);
  link.periods = periods;
  link.loop = &loop;
  loop.Run();
  EXPECT_EQ(loop.statistics().cycles, periods);
  return clock.NowNs() - 1;
}

TEST(PacedRig, WaitsForTheClockWhereOneInLockstepDoesNot) {
  EXPECT_EQ(ClockAfter(2'000, 0.0), 0);
  EXPECT_NEAR(static_cast<double>(ClockAfter(2'000, 1.0)), 2'000.0 * kPacedPeriodNs,
              static_cast<double>(Pacer::kBurstNs + kPacedPeriodNs));
  EXPECT_NEAR(static_cast<double>(ClockAfter(2'000, 0.5)), 4'000.0 * kPacedPeriodNs,
              static_cast<double>(Pacer::kBurstNs + 2 * kPacedPeriodNs));
}

bool Reads(std::vector<std::string> words, PlantOptions& options) {
  constexpr PlantProgram kProgram{"amb-plant", "a rig", "a port", "lcm", 1000, ""};
  words.insert(words.begin(), {"amb-plant", "--rig", "flexible_rotor"});
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  ExitStatus status = ExitStatus::kDone;
  return ReadCommandLine(static_cast<int>(argv.size()), argv.data(), kProgram, options, status);
}

TEST(PlantOptions, APacedRunIsLockstepWithAFactor) {
  PlantOptions options;
  ASSERT_TRUE(Reads({"--pace", "paced"}, options));
  EXPECT_FALSE(options.realtime);
  EXPECT_EQ(options.pace_factor, 1.0);
  ASSERT_TRUE(Reads({"--pace", "paced", "--pace-factor", "0.2"}, options));
  EXPECT_EQ(options.pace_factor, 0.2);
  EXPECT_STREQ(PaceName(options), "paced");
}

TEST(PlantOptions, OtherPacesHaveNoFactorAndRefuseOne) {
  for (const char* pace : {"lockstep", "realtime"}) {
    PlantOptions options;
    ASSERT_TRUE(Reads({"--pace", pace}, options));
    EXPECT_EQ(options.pace_factor, 0.0) << pace;
    EXPECT_STREQ(PaceName(options), pace);
    EXPECT_FALSE(Reads({"--pace", pace, "--pace-factor", "2"}, options)) << pace;
  }
  PlantOptions options;
  EXPECT_FALSE(Reads({"--pace", "paced", "--pace-factor", "0"}, options));
}

}  // namespace
}  // namespace levitas::plant_run
