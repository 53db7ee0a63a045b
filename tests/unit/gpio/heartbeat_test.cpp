// Heartbeat and the rig's gate: what the rig lets through when the controller lives, hangs, dies.
#include <gtest/gtest.h>

#include "hil/gpio/heartbeat.hpp"
#include "hil/gpio/rig_gate.hpp"

namespace levitas::gpio {
namespace {

constexpr std::int64_t kPeriodNs = 100'000;
constexpr std::int64_t kTimeoutNs = 5'000'000;

TEST(Heartbeat, TogglesEveryGivenNumberOfCycles) {
  Heartbeat heartbeat(5);
  int edges = 0;
  for (int cycle = 1; cycle <= 100; ++cycle) {
    const bool edge = heartbeat.Step();
    EXPECT_EQ(edge, cycle % 5 == 0) << cycle;
    edges += edge ? 1 : 0;
    EXPECT_EQ(heartbeat.level(), edges % 2 == 1);
  }
}

TEST(HeartbeatWatch, IsDeadBeforeTheSecondEdge) {
  HeartbeatWatch watch(kTimeoutNs);
  EXPECT_FALSE(watch.Sample(true, 0)) << "a level is no edge";
  EXPECT_FALSE(watch.Sample(false, kPeriodNs)) << "one edge may be the end of what held the line";
  EXPECT_TRUE(watch.Sample(true, 2 * kPeriodNs));
}

TEST(HeartbeatWatch, LivesExactlyAsLongAsItsTimeoutAfterTheLastEdge) {
  for (const bool stuck : {false, true}) {
    HeartbeatWatch watch(kTimeoutNs);
    std::int64_t now_ns = 0;
    bool level = stuck;
    for (int edge = 0; edge < 10; ++edge) {
      now_ns += kPeriodNs;
      level = !level;
      (void)watch.Sample(level, now_ns);
    }
    ASSERT_EQ(level, stuck) << "the test must end on the level it is about";
    EXPECT_TRUE(watch.Sample(level, now_ns + kTimeoutNs));
    EXPECT_FALSE(watch.Sample(level, now_ns + kTimeoutNs + 1));
  }
}

TEST(HeartbeatWatch, TakesTwoEdgesToBelieveAgain) {
  HeartbeatWatch watch(kTimeoutNs);
  std::int64_t now_ns = 0;
  for (const bool level : {true, false, true}) (void)watch.Sample(level, now_ns += kPeriodNs);
  ASSERT_TRUE(watch.alive());
  ASSERT_FALSE(watch.Sample(true, now_ns += 2 * kTimeoutNs));
  EXPECT_FALSE(watch.Sample(false, now_ns += kPeriodNs));
  EXPECT_TRUE(watch.Sample(true, now_ns += kPeriodNs));
}

/// A rig that samples once per period; the controller toggles in every cycle that runs.
struct Bench {
  RigGate gate{kTimeoutNs};
  std::int64_t now_ns{0};
  bool level{false};

  GateEvent Period(bool enable, bool cycle_runs) {
    now_ns += kPeriodNs;
    if (cycle_runs) level = !level;
    return gate.Sample(enable, level, now_ns);
  }
  void Start() {
    for (int i = 0; i < 10; ++i) (void)Period(true, true);
  }
};

TEST(RigGate, OpensOnlyWithEnableAndHeartbeatTogether) {
  Bench enabled_only;
  Bench beating_only;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(enabled_only.Period(true, false), GateEvent::kNone);
    EXPECT_EQ(beating_only.Period(false, true), GateEvent::kNone);
  }
  EXPECT_FALSE(enabled_only.gate.open());
  EXPECT_FALSE(beating_only.gate.open());
  EXPECT_EQ(beating_only.Period(true, true), GateEvent::kOpened);
}

TEST(RigGate, ShutsInThePeriodInWhichTheEnableLineFalls) {
  Bench bench;
  bench.Start();
  ASSERT_TRUE(bench.gate.open());
  EXPECT_EQ(bench.Period(false, true), GateEvent::kEnableFell);
  EXPECT_FALSE(bench.gate.open());
}

TEST(RigGate, ShutsWithinTheTimeoutWhenTheCycleStopsWithTheEnableLineHigh) {
  Bench bench;
  bench.Start();
  int periods = 0;
  while (bench.Period(true, false) == GateEvent::kNone) ++periods;
  EXPECT_FALSE(bench.gate.open());
  EXPECT_EQ(periods, kTimeoutNs / kPeriodNs) << "and not before it";
}

TEST(RigGate, WithoutTheHeartbeatAHangWouldStayEnabledForEver) {
  RigGate gate(std::nullopt);
  EXPECT_EQ(gate.Sample(true, false, 0), GateEvent::kOpened);
  for (int i = 1; i < 100'000; ++i) (void)gate.Sample(true, false, i * kPeriodNs);
  EXPECT_TRUE(gate.open());
}

TEST(RigGate, AControllerThatComesBackFromAHangMustBeginAnew) {
  Bench bench;
  bench.Start();
  for (int i = 0; i < 100; ++i) (void)bench.Period(true, false);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(bench.Period(true, true), GateEvent::kNone);
  EXPECT_FALSE(bench.gate.open());
  (void)bench.Period(false, true);
  EXPECT_EQ(bench.Period(true, true), GateEvent::kOpened);
}

TEST(RigGate, EnableAndHeartbeatGoneTogetherIsAFallOfTheEnableLine) {
  Bench bench;
  bench.Start();
  bench.now_ns += 2 * kTimeoutNs;
  EXPECT_EQ(bench.gate.Sample(false, bench.level, bench.now_ns), GateEvent::kEnableFell);
}

}  // namespace
}  // namespace levitas::gpio
