// The operator's emergency stop between the thread that hears it and the trip: it waits for
// nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "common/random.hpp"
#include "common/stop_latch.hpp"
#include "configuration/rig_file.hpp"
#include "controller/loop/command_arbiter.hpp"
#include "controller/loop/control_loop.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/loop/fakes.hpp"

namespace levitas::loop {
namespace {

constexpr std::int64_t kStopPeriod = 100'000;
constexpr ArbiterOptions kStopOptions{
    .period_s = 1e-4, .stop_acceleration_rad_per_s2 = 50.0, .standstill_rad_per_s = 1.0};
constexpr auto kStop = OperatorCommand::kEmergencyStop;

OperatorView StopView(std::uint64_t cycle, Mode mode) {
  return {.cycle = cycle, .mode = mode, .amplifiers_enabled = mode != Mode::kOff};
}

RemoteCommand Land(std::uint64_t stops_before = 0) {
  return {.command = OperatorCommand::kLand, .stops_before = stops_before};
}

TEST(StopLatch, IsTakenOnceForAllThatWereAskedFor) {
  StopLatch latch;
  EXPECT_FALSE(latch.Take());
  for (int ask = 0; ask < 1000; ++ask) latch.Ask(5 + ask, {7, ask});  // far beyond its origins
  EXPECT_TRUE(latch.Take());
  EXPECT_EQ(latch.received_ns(), 5);  // the first one has waited longest
  EXPECT_EQ(latch.taken(), 1000U);
  EXPECT_FALSE(latch.Take());
  latch.Ask(2000, {});
  EXPECT_TRUE(latch.Take());
  EXPECT_EQ(latch.received_ns(), 2000);
}

TEST(EmergencyStop, PassesAFullRingInEveryModeWhetherEndingOrNot) {
  for (std::uint8_t mode = 0; mode < kModeCount; ++mode) {
    for (const bool ending : {false, true}) {
      SpscRing<RemoteCommand> ring(16);
      StopLatch stops;
      CommandArbiter desk(kStopOptions, nullptr, {&ring, &stops});
      if (ending) desk.RequestStop();
      (void)desk.Next(StopView(0, static_cast<Mode>(mode)));
      while (ring.Post(Land())) {
      }
      stops.Ask(1, {});
      EXPECT_EQ(desk.Next(StopView(1, static_cast<Mode>(mode))).command, kStop)
          << Name(static_cast<Mode>(mode)) << (ending ? " ending" : "");
      EXPECT_NE(desk.Next(StopView(2, static_cast<Mode>(mode))).command, kStop);
    }
  }
}

// A reset and a lift that were given before the stop must not lift the rotor again after it.
TEST(EmergencyStop, IsNotUndoneByCommandsThatWereGivenBeforeIt) {
  SpscRing<RemoteCommand> ring(16);
  StopLatch stops;
  CommandArbiter desk(kStopOptions, nullptr, {&ring, &stops});
  ring.Post({.command = OperatorCommand::kReset, .stops_before = 0});
  ring.Post({.command = OperatorCommand::kLift, .stops_before = 0});
  stops.Ask(1, {});
  ring.Post(Land(1));  // given with the stop known
  EXPECT_EQ(desk.Next(StopView(0, Mode::kTripped)).command, kStop);
  EXPECT_EQ(desk.Next(StopView(1, Mode::kTripped)).command, OperatorCommand::kLand);
  EXPECT_EQ(desk.Next(StopView(2, Mode::kTripped)).command, OperatorCommand::kNone);
}

TEST(EmergencyStop, WithoutOneTheSameCommandsPass) {
  SpscRing<RemoteCommand> ring(16);
  StopLatch stops;
  CommandArbiter desk(kStopOptions, nullptr, {&ring, &stops});
  ring.Post({.command = OperatorCommand::kReset});
  ring.Post({.command = OperatorCommand::kLift});
  EXPECT_EQ(desk.Next(StopView(0, Mode::kTripped)).command, OperatorCommand::kReset);
  EXPECT_EQ(desk.Next(StopView(1, Mode::kOff)).command, OperatorCommand::kLift);
}

TEST(EmergencyStop, GivesBackTheTestSignalThatCameBeforeIt) {
  SpscRing<RemoteCommand> ring(16);
  StopLatch stops;
  ExcitationPool shelf;
  CommandArbiter desk(kStopOptions, nullptr, {&ring, &stops});
  scenario::Step step;
  step.hold_s = 1.0;
  step.excitation.emplace_back();
  for (std::size_t place = 0; place < ExcitationPool::kSlots; ++place) {
    ring.Post({.command = OperatorCommand::kExcite, .excitation = shelf.Put(step, 1e-4)});
  }
  ASSERT_EQ(shelf.Put(step, 1e-4), nullptr);
  stops.Ask(1, {});
  for (std::uint64_t cycle = 0; cycle < 3; ++cycle)
    (void)desk.Next(StopView(cycle, Mode::kTripped));
  for (std::size_t place = 0; place < ExcitationPool::kSlots; ++place) {
    EXPECT_NE(shelf.Put(step, 1e-4), nullptr);
  }
}

TEST(EmergencyStop, NamesTheCycleToEverybodyWhoAsked) {
  StopLatch stops;
  SpscRing<GivenCommand> given(8);
  CommandArbiter desk(kStopOptions, nullptr, {nullptr, &stops, &given});
  stops.Ask(1, {11, 4});
  stops.Ask(2, {12, 9});
  EXPECT_EQ(desk.Next(StopView(77, Mode::kSpinning)).command, kStop);
  GivenCommand first;
  GivenCommand second;
  ASSERT_TRUE(given.Take(first) && given.Take(second));
  EXPECT_EQ(first.cycle, 77U);
  EXPECT_EQ(first.origin.sender, 11U);
  EXPECT_EQ(second.origin.sequence, 9);
}

/// The loop on a clock of its own, in real time's order of events.
struct StopBench {
  StopBench() {
    const auto rig = configuration::LoadRig(SourceFolder() + "/config/rigs/flexible_rotor.yaml");
    const auto controller = configuration::LoadController(
        SourceFolder() + "/config/controllers/flexible_rotor.yaml", rig.numbers);
    cycle.emplace(cycle::CycleConfig{rig.numbers, controller.law, controller.supervisor});
    loop.emplace(LoopOptions{.pace = Pace::kRealtime, .period_ns = kStopPeriod}, port, *cycle, desk,
                 sink, clock);
  }
  static std::string SourceFolder() { return levitas::test::SourceFolder(); }

  test::FakeClock clock;
  test::FakePort port{clock, kStopPeriod};
  std::optional<cycle::ControlCycle> cycle;
  SpscRing<RemoteCommand> ring{16};
  StopLatch stops;
  CommandArbiter desk{kStopOptions, nullptr, {&ring, &stops}};
  test::FakeSink sink;
  std::optional<ControlLoop> loop;
};

// 1000 stops at random instants between the grid's, the ring of commands full all the time and its
// writer never heard again: each is a trip, at most one period and what the cycle takes later.
TEST(EmergencyStop, IsATripWithinOnePeriodWhateverElseIsAsked) {
  constexpr std::int64_t kWorkNs = 20'000;  // from the wake-up to the written current
  StopBench bench;
  Random random(20261123);
  int asked = 0;
  std::int64_t longest_ns = 0;
  std::int64_t pending_ns = 0;
  bench.clock.on_wake = [&] {
    while (bench.ring.Post(Land(bench.stops.asked()))) {
    }
    if (bench.sink.records.size() % 10 == 5 && asked < 1000) {
      const auto since_ns = static_cast<std::int64_t>(random.Uniform() * (kStopPeriod - 1));
      pending_ns = bench.clock.now_ns - since_ns;
      bench.stops.Ask(pending_ns, {});
      ++asked;
    }
  };
  bench.port.on_write = [&] {
    bench.clock.now_ns += kWorkNs;
    if (pending_ns != 0) longest_ns = std::max(longest_ns, bench.clock.now_ns - pending_ns);
    pending_ns = 0;
  };
  int stopped = 0;
  bench.sink.on_record = [&] {
    const auto& record = bench.sink.records.back();
    if (record.in.op.command == kStop) ++stopped;
    if (bench.sink.records.size() > 20'000) bench.loop->Abort();
  };
  bench.loop->Run();
  const Histogram& measured = bench.loop->statistics().emergency_stop;
  EXPECT_EQ(asked, 1000);
  EXPECT_EQ(stopped, 1000);
  EXPECT_EQ(measured.count(), 1000U);
  EXPECT_EQ(measured.max_ns(), longest_ns);
  EXPECT_LE(longest_ns, kStopPeriod + kWorkNs);
  EXPECT_EQ(bench.sink.records.back().out.fault, Fault::kEmergencyStop);
}

// What the latch replaces, by the same measure: a stop behind a full ring is lost.
TEST(EmergencyStop, WouldBeLostBehindAFullRing) {
  SpscRing<RemoteCommand> ring(16);
  while (ring.Post(Land())) {
  }
  EXPECT_FALSE(ring.Post({.command = kStop}));
}

TEST(EmergencyStop, AllocatesNothingInTheLoop) {
  SpscRing<RemoteCommand> ring(16);
  StopLatch stops;
  SpscRing<GivenCommand> given(8);
  CommandArbiter desk(kStopOptions, nullptr, {&ring, &stops, &given});
  const levitas::test::AllocationGuard guard;
  for (std::uint64_t cycle = 0; cycle < 10'000; ++cycle) {
    stops.Ask(1, {1, 2});
    ring.Post(Land());
    (void)desk.Next(StopView(cycle, Mode::kLevitating));
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace levitas::loop
