#include "controller/loop/control_loop.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <optional>
#include <thread>
#include <vector>

#include "configuration/rig_file.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/loop/fakes.hpp"

namespace levitas::loop {
namespace {

using test::FakeClock;
using test::FakePort;
using test::FakeSink;
using test::FakeSource;
constexpr std::int64_t kPeriod = 100'000;

cycle::CycleConfig ShippedConfig() {
  const auto rig =
      configuration::LoadRig(levitas::test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  const auto controller = configuration::LoadController(
      levitas::test::SourceFolder() + "/config/controllers/flexible_rotor.yaml", rig.numbers);
  return {rig.numbers, controller.law, controller.supervisor, controller.synchronous,
          controller.bias};
}

// A loop on a fake rig; each test spoils one thing.
struct Bench {
  explicit Bench(Pace pace, std::uint64_t cycles) : source(cycles) {
    port.lockstep = pace == Pace::kLockstep;
    loop.emplace(LoopOptions{.pace = pace, .period_ns = kPeriod}, port, cycle, source, sink, clock);
  }
  [[nodiscard]] const LoopStatistics& Run() {
    loop->Run();
    return loop->statistics();
  }
  FakeClock clock;
  FakePort port{clock, kPeriod};
  cycle::ControlCycle cycle{ShippedConfig()};
  FakeSource source;
  FakeSink sink;
  std::optional<ControlLoop> loop;
};

TEST(ControlLoopLockstep, MakesOneCycleOfEachFrameAndAnswersIt) {
  Bench bench(Pace::kLockstep, 100);
  EXPECT_EQ(bench.Run().cycles, 100U);
  ASSERT_EQ(bench.port.written.size(), 100U);
  for (std::size_t n = 0; n < 100; ++n) {
    EXPECT_EQ(bench.port.written[n], n + 1);  // the fake rig counts from 1
    EXPECT_EQ(bench.sink.records[n].in.cycle, n);
    EXPECT_TRUE(bench.sink.records[n].in.frame_present);
  }
}

TEST(ControlLoopLockstep, AnswersARepeatedFrameAgainWithoutANewCycle) {
  Bench bench(Pace::kLockstep, 100);
  bench.port.on_read = [&] { bench.port.repeat = bench.port.reads == 50; };
  const auto& statistics = bench.Run();
  EXPECT_EQ(statistics.cycles, 100U);
  EXPECT_EQ(statistics.repeated_frames, 1U);
  EXPECT_EQ(bench.sink.records.size(), 100U);
  ASSERT_EQ(bench.port.written.size(), 101U);
  EXPECT_EQ(bench.port.written[49], bench.port.written[48]);
}

TEST(ControlLoopLockstep, WaitsForASilentRigWithoutCountingCycles) {
  Bench bench(Pace::kLockstep, 10);
  bench.port.silent = [&] { return bench.port.reads > 5 && bench.port.reads < 500; };
  const auto& statistics = bench.Run();
  EXPECT_EQ(statistics.cycles, 10U);
  EXPECT_EQ(statistics.missing_frames, 0U);
}

TEST(ControlLoop, EndsOnAbortAlthoughTheRigIsSilent) {
  for (const Pace pace : {Pace::kLockstep, Pace::kRealtime}) {
    Bench bench(pace, 1'000'000);
    bench.port.silent = [&] {
      if (bench.port.reads == 20) bench.loop->Abort();
      return true;
    };
    EXPECT_EQ(bench.Run().cycles, 0U);
    EXPECT_EQ(bench.loop->frames_heard(), 0U);
  }
}

TEST(ControlLoop, ComputesInStandardArithmeticWhateverItsThreadWasSetTo) {
  std::vector<int> rounding;
  std::thread([&] {
    Bench bench(Pace::kLockstep, 3);
    bench.port.on_write = [&] { rounding.push_back(std::fegetround()); };
    std::fesetround(FE_UPWARD);
    (void)bench.Run();
  }).join();
  EXPECT_EQ(rounding, (std::vector<int>{FE_TONEAREST, FE_TONEAREST, FE_TONEAREST}));
}

TEST(ControlLoopRealtime, WakesOnTheGridOfTheRig) {
  Bench bench(Pace::kRealtime, 100);
  const auto& statistics = bench.Run();
  EXPECT_EQ(statistics.cycles, 100U);
  EXPECT_EQ(statistics.skipped_periods, 0U);
  EXPECT_EQ(statistics.missing_frames, 0U);
  // 30 us after sampling instant 0, then each 100 us; cycle 99 starts at 9.93 ms.
  EXPECT_EQ(bench.clock.now_ns, 30'000 + 99 * kPeriod);
}

// Of another machine's clock, of a sender gone wrong, or made to overflow.
TEST(ControlLoopRealtime, DatesAFrameByItsArrivalWhenItsSamplingInstantCannotBe) {
  for (const std::int64_t said_ns :
       {INT64_MIN, INT64_MAX, std::int64_t{-5'000'000'000}, std::int64_t{5'000'000'000}}) {
    Bench bench(Pace::kRealtime, 100);
    bench.port.date = [&](std::int64_t) { return said_ns; };
    const auto& statistics = bench.Run();
    EXPECT_EQ(statistics.cycles, 100U);
    EXPECT_EQ(statistics.skipped_periods, 0U);
    EXPECT_EQ(statistics.undated_frames, 101U);  // the first one only tells that the rig is there
    EXPECT_EQ(statistics.latency.max_ns(), 30'000);
    // The first frame is read at 0: it was sampled 30 us before, and the next wake-up is at 100 us.
    EXPECT_EQ(bench.clock.now_ns, 100 * kPeriod) << said_ns;
  }
}

TEST(ControlLoopRealtime, LeavesASamplingInstantThatCanBeAsItIs) {
  Bench bench(Pace::kRealtime, 100);
  bench.port.date = [](std::int64_t true_ns) { return true_ns - 700'000'000; };
  EXPECT_EQ(bench.Run().undated_frames, 0U);
}

TEST(ControlLoopRealtime, CountsAMissingFrameInItsCycleAndNowhereElse) {
  Bench bench(Pace::kRealtime, 100);
  bench.port.silent = [&] { return bench.port.reads == 42; };
  EXPECT_EQ(bench.Run().missing_frames, 1U);
  for (std::size_t n = 0; n < 100; ++n) {
    EXPECT_EQ(bench.sink.records[n].in.frame_present, n != 40) << n;  // read 1 found the rig
  }
}

TEST(ControlLoopRealtime, TellsTheCycleAfterAnOverrunHowManyPeriodsWereMissed) {
  Bench bench(Pace::kRealtime, 100);
  bench.port.on_write = [&] {
    if (bench.port.written.size() == 50) bench.clock.now_ns += 350'000;
  };
  const auto& statistics = bench.Run();
  EXPECT_EQ(statistics.skipped_periods, 3U);
  EXPECT_EQ(statistics.overruns, 1U);
  for (std::size_t n = 0; n < 100; ++n) {
    EXPECT_EQ(bench.sink.records[n].in.missed_deadlines, n == 51 ? 3U : 0U) << n;
  }
  EXPECT_EQ(bench.clock.now_ns, 30'000 + (99 + 3) * kPeriod);  // the grid kept its phase
}

// Each stage in turn is made 150 us long: the period after it is skipped and it is named.
TEST(ControlLoopRealtime, BlamesTheStageThatTookLong) {
  const auto blamed = [](auto spoil) {
    Bench bench(Pace::kRealtime, 20);
    spoil(bench, [&bench] {
      if (bench.sink.records.size() == 10) bench.clock.now_ns += 150'000;
    });
    const auto& statistics = bench.Run();
    EXPECT_EQ(statistics.overruns, 1U);
    EXPECT_EQ(statistics.skipped_periods, 1U);
    return statistics.last_blamed;
  };
  using cycle::Stage;
  EXPECT_EQ(blamed([](Bench& b, auto late) { b.clock.on_wake = late; }), Stage::kWait);
  EXPECT_EQ(blamed([](Bench& b, auto late) { b.port.on_read = late; }), Stage::kRead);
  EXPECT_EQ(blamed([](Bench& b, auto late) { b.port.on_write = late; }), Stage::kWrite);
  EXPECT_EQ(blamed([](Bench& b, auto late) { b.sink.on_record = late; }), Stage::kRecord);
}

TEST(ControlLoopRealtime, MeasuresTheWakeUpErrorFromTheGridInstant) {
  Bench bench(Pace::kRealtime, 100);
  bench.clock.on_wake = [&] { bench.clock.now_ns += 15; };  // below 16 ns bins are exact
  const auto& statistics = bench.Run();
  EXPECT_EQ(statistics.wakeup.count(), 100U);
  EXPECT_EQ(statistics.wakeup.Percentile(0.5), 15.0);
  EXPECT_EQ(statistics.wakeup.max_ns(), 15);
}

TEST(ControlLoopRealtime, MeasuresLatencyFromTheSamplingInstantToTheWrite) {
  Bench bench(Pace::kRealtime, 100);
  bench.port.on_write = [&] { bench.clock.now_ns += 2'000; };
  const auto& statistics = bench.Run();
  EXPECT_EQ(statistics.latency.max_ns(), 30'000 + 2'000);
  EXPECT_EQ(statistics.compute.max_ns(), 2'000);
}

TEST(ControlLoop, ShowsTheOperatorThePreviousCyclesOutputs) {
  Bench bench(Pace::kLockstep, 3);
  (void)bench.Run();
  ASSERT_EQ(bench.source.views.size(), 3U);
  for (std::size_t n = 1; n < 3; ++n) {
    EXPECT_EQ(bench.source.views[n].mode, bench.sink.records[n - 1].out.mode);
    EXPECT_EQ(bench.source.views[n].cycle, n);
  }
}

TEST(ControlLoop, ReportsItsStatisticsOnceASecondOfCycles) {
  Bench bench(Pace::kLockstep, 25'000);
  bench.sink.records.reserve(25'000);
  (void)bench.Run();
  EXPECT_EQ(bench.sink.reported, (std::vector<std::uint64_t>{10'000, 20'000}));
}

TEST(ControlLoop, AllocatesNothingIn10000CyclesAtEitherPace) {
  for (const Pace pace : {Pace::kLockstep, Pace::kRealtime}) {
    Bench bench(pace, 10'000);
    bench.sink.records.reserve(10'000);
    bench.port.written.reserve(10'000);
    bench.source.views.reserve(10'000);
    bench.sink.reported.reserve(1);
    const levitas::test::AllocationGuard guard;
    bench.loop->Run();
    EXPECT_EQ(guard.count(), 0U);
  }
}

}  // namespace
}  // namespace levitas::loop
