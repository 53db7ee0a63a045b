// Which of the currents that arrive acts in the simulated rig in real time: the newest, late too.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "plant_sim/loop/plant_loop.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant_run {
namespace {

constexpr std::int64_t kPeriodNs = 100'000;
constexpr std::uint32_t kWatchdog = 20;
using Cycles = std::vector<std::uint64_t>;

class QuickClock final : public rt::Clock {
 public:
  std::int64_t NowNs() noexcept override { return now_ns_; }
  void SleepUntil(std::int64_t due_ns) noexcept override { now_ns_ = std::max(now_ns_, due_ns); }

 private:
  std::int64_t now_ns_{1};
};

/// After each frame of the rig the currents that a test wants arrive, named by the frame that they
/// answer. Those of an even frame run the drive, those of an odd one do not.
class ScriptedLink final : public port::RigLink {
 public:
  bool Send(const SensorFrame& frame) noexcept override {
    frames.push_back(frame);
    if (on_send) on_send(frame.cycle);
    return true;
  }
  ReceiveResult Receive(CurrentFrame& frame, std::int64_t /*deadline_ns*/) noexcept override {
    if (arrived.empty()) return ReceiveResult::kNothing;
    frame = {.cycle = arrived.front(), .axes = 4};
    frame.amplifiers_enabled = true;
    frame.drive_enabled = frame.cycle % 2 == 0;
    arrived.pop_front();
    return ReceiveResult::kCurrent;
  }
  [[nodiscard]] Counters counters() const noexcept override { return {}; }

  std::function<void(std::uint64_t)> on_send;
  std::deque<std::uint64_t> arrived;
  std::vector<SensorFrame> frames;
};

struct Seen {
  PlantStatistics statistics;
  std::vector<SensorFrame> frames;
  bool driven{};
  bool energised{};
};

/// So many periods; `arrive`: the currents that are there in the period of a frame, oldest first.
Seen After(std::uint64_t periods, const std::function<Cycles(std::uint64_t)>& arrive) {
  plant::Plant plant(test::QuietFlexibleRotor(), 1);
  ScriptedLink link;
  QuickClock clock;
  PlantLoop loop(
      {.realtime = true, .period_ns = kPeriodNs, .rig_session = 1, .watchdog_periods = kWatchdog},
      plant, link, clock);
  link.on_send = [&](std::uint64_t cycle) {
    for (const std::uint64_t answered : arrive(cycle)) link.arrived.push_back(answered);
    if (cycle + 1 == periods) loop.Stop();  // this period is finished
  };
  loop.Run();
  return {loop.statistics(), link.frames, loop.driven(), loop.energised()};
}

TEST(NewestCurrent, InTimeIsHeldInNoPeriod) {
  const Seen seen = After(40, [](std::uint64_t n) { return Cycles{n}; });
  EXPECT_EQ(seen.statistics.cycles, 40U);
  EXPECT_EQ(seen.statistics.held_currents, 0U);
  EXPECT_EQ(seen.statistics.watchdog_trips, 0U);
  EXPECT_TRUE(seen.energised);
  EXPECT_FALSE(seen.driven);  // of frame 39
}

// Each current comes a period late. Every period counts as held, but somebody is there.
TEST(NewestCurrent, LateActsAndKeepsTheWatchdogAtRest) {
  const Seen seen = After(100, [](std::uint64_t n) { return n > 0 ? Cycles{n - 1} : Cycles{}; });
  EXPECT_EQ(seen.statistics.held_currents, 99U);  // before the first nobody is there
  EXPECT_EQ(seen.frames.back().held_currents, 98U);
  EXPECT_NE(seen.frames.back().rig_status & kRigCurrentHeld, 0U);
  EXPECT_EQ(seen.statistics.watchdog_trips, 0U);
  EXPECT_TRUE(seen.energised);
  EXPECT_TRUE(seen.driven);  // of frame 98
}

// The other half of the pair: a current that is not new, however often it comes, is none.
TEST(NewestCurrent, TheSameAgainLeavesTheRotorToTheWatchdog) {
  const auto again = [](std::uint64_t n) { return Cycles{std::min<std::uint64_t>(n, 4)}; };
  EXPECT_TRUE(After(5 + kWatchdog - 1, again).energised);
  const Seen seen = After(5 + kWatchdog, again);
  EXPECT_EQ(seen.statistics.watchdog_trips, 1U);
  EXPECT_FALSE(seen.energised);
}

TEST(NewestCurrent, IsNotOvertakenByAnOlderOneThatComesBehindIt) {
  for (const bool newest_first : {true, false}) {
    const Seen seen = After(12, [=](std::uint64_t n) {
      if (n < 11) return Cycles{n};
      return newest_first ? Cycles{10, 9} : Cycles{9, 10};
    });
    EXPECT_TRUE(seen.driven) << newest_first;  // of frame 10, in time in its own period
  }
  for (const bool newest_first : {true, false}) {
    const Seen seen = After(12, [=](std::uint64_t n) {
      if (n < 9) return Cycles{n};
      if (n < 11) return Cycles{};
      return newest_first ? Cycles{10, 9} : Cycles{9, 10};
    });
    EXPECT_TRUE(seen.driven) << newest_first;  // of frame 10, late
    EXPECT_EQ(seen.statistics.stale_currents, 2U);
  }
}

// What was already overtaken when it arrives is no sign of life: frames 9 and older, again and
// again, after frame 10 has been answered.
TEST(NewestCurrent, OlderThanTheOneThatActsIsNoNews) {
  const auto older = [](std::uint64_t n) { return Cycles{n <= 10 ? n : n % 10}; };
  const Seen seen = After(11 + kWatchdog, older);
  EXPECT_EQ(seen.statistics.watchdog_trips, 1U);
  EXPECT_FALSE(seen.energised);
  EXPECT_TRUE(After(11 + kWatchdog - 1, older).energised);
}

TEST(NewestCurrent, InTimeBehindLateOnesIsInTime) {
  const Seen seen = After(50, [](std::uint64_t n) {
    return n > 2 ? Cycles{n - 2, n - 1, n} : Cycles{n};
  });
  EXPECT_EQ(seen.statistics.held_currents, 0U);
  EXPECT_FALSE(seen.driven);  // of frame 49
}

}  // namespace
}  // namespace levitas::plant_run
