// The port with lines beside it: what goes into frames, what comes out of them.
#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "hil/guarded_port/guarded_port.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/unit/gpio/rotor_marks.hpp"

namespace levitas::gpio {
namespace {

class FakePort final : public port::RigPort {
 public:
  port::ReadResult Read(SensorFrame& frame, std::int64_t /*deadline_ns*/) noexcept override {
    if (!has_frame) return port::ReadResult::kNothing;
    frame = next;
    return port::ReadResult::kFrame;
  }
  bool Write(const CurrentFrame& /*frame*/) noexcept override {
    ++written;
    return takes;
  }
  [[nodiscard]] port::PortCounters counters() const noexcept override {
    return {.frames_read = 17};
  }
  void SayGoodbye(const CurrentFrame& last) noexcept override { goodbye_cycle = last.cycle; }
  [[nodiscard]] std::string Trouble() const override { return "1 x bus off"; }
  std::uint64_t goodbye_cycle{0};
  bool has_frame{true};
  bool takes{true};
  int written{0};
  SensorFrame next{.cycle = 1, .axes = 4, .speed_rad_per_s = 5.0, .angle_rad = 0.25};
};

class FakeLines final : public Lines {
 public:
  [[nodiscard]] InputLevels ReadInputs() noexcept override { return inputs; }
  [[nodiscard]] std::size_t ReadPulses(std::span<std::int64_t> time_ns) noexcept override {
    std::size_t count = 0;
    while (count < time_ns.size() && !pulses.empty()) {
      time_ns[count++] = pulses.front();
      pulses.pop_front();
    }
    return count;
  }
  bool WriteEnable(bool active) noexcept override {
    ++enable_writes;
    if (works) enable = active;
    return works;
  }
  bool WriteHeartbeat(bool active) noexcept override {
    if (!works) return false;
    edges += active != heartbeat ? 1 : 0;
    heartbeat = active;
    return true;
  }
  void CycleDone() noexcept override { ++cycles; }

  InputLevels inputs;
  std::deque<std::int64_t> pulses;
  bool works{true};
  bool enable{false};
  bool heartbeat{false};
  int enable_writes{0};
  int edges{0};
  int cycles{0};
};

LinesConfig WithHeartbeat() {
  LinesConfig config;
  config.heartbeat = HeartbeatConfig{{}, 5, 0.005};
  return config;
}

struct GuardedPortTest : testing::Test {
  SensorFrame Read() {
    (void)guarded.Read(frame, 0);
    return frame;
  }
  FakePort port;
  FakeLines lines;
  LinesConfig config = WithHeartbeat();
  GuardedPort guarded{port, lines, config};
  SensorFrame frame;
};

TEST_F(GuardedPortTest, HealthyLinesLeaveTheFrameAsItCame) {
  port.next.rig_status = kRigCurrentHeld;
  const SensorFrame read = Read();
  EXPECT_EQ(read.rig_status, kRigCurrentHeld);
  EXPECT_EQ(read.speed_rad_per_s, 5.0);
  EXPECT_EQ(read.angle_rad, 0.25);
}

TEST_F(GuardedPortTest, AnOpenChainIsAnEmergencyStopInTheSameFrame) {
  lines.inputs.stop_chain_closed = false;
  EXPECT_EQ(Read().rig_status, kRigEmergencyStop);
  EXPECT_EQ(guarded.line_counters().stops, 1U);
}

TEST_F(GuardedPortTest, AnOpenChainIsSeenWithoutAFrame) {
  (void)Read();
  port.has_frame = false;
  lines.inputs.stop_chain_closed = false;
  EXPECT_EQ(guarded.Read(frame, 0), port::ReadResult::kNothing);
  EXPECT_EQ(frame.rig_status & kRigEmergencyStop, kRigEmergencyStop);
}

TEST_F(GuardedPortTest, AClosedChainIsHealthyAgainWithTheNextFrame) {
  lines.inputs.stop_chain_closed = false;
  (void)Read();
  lines.inputs.stop_chain_closed = true;
  EXPECT_EQ(Read().rig_status, 0U);
}

TEST_F(GuardedPortTest, LinesThatCannotBeReadAreAnOpenChain) {
  lines.inputs.readable = false;
  EXPECT_EQ(Read().rig_status, kRigEmergencyStop);
}

TEST_F(GuardedPortTest, AnAmplifiersFaultIsABitOfItsOwn) {
  lines.inputs.amplifier_fault = true;
  EXPECT_EQ(Read().rig_status, kRigAmplifierFault);
}

TEST_F(GuardedPortTest, TheEnableLineFollowsTheFrameAndIsWrittenOnlyWhenItChanges) {
  CurrentFrame current;
  for (const bool enabled : {false, false, true, true, true, false, false}) {
    current.amplifiers_enabled = enabled;
    EXPECT_TRUE(guarded.Write(current));
    EXPECT_EQ(lines.enable, enabled);
  }
  EXPECT_EQ(lines.enable_writes, 2);
  EXPECT_EQ(guarded.line_counters().enables, 1U);
  EXPECT_EQ(port.written, 7);
}

TEST_F(GuardedPortTest, TheHeartbeatBeatsWithEveryFifthCycleAndOnlyThen) {
  for (int cycle = 1; cycle <= 50; ++cycle) {
    guarded.Write({});
    EXPECT_EQ(lines.edges, cycle / 5);
    EXPECT_EQ(lines.cycles, cycle);
  }
  for (int i = 0; i < 100; ++i) (void)Read();
  EXPECT_EQ(lines.edges, 10) << "reading alone is no cycle";
}

TEST_F(GuardedPortTest, AnEnableLineThatCannotBeWrittenIsAFaultAndIsTriedAgain) {
  lines.works = false;
  CurrentFrame current{.amplifiers_enabled = true};
  EXPECT_TRUE(guarded.Write(current)) << "the frame itself was sent";
  EXPECT_EQ(Read().rig_status, kRigAmplifierFault);
  lines.works = true;
  guarded.Write(current);
  EXPECT_TRUE(lines.enable);
  EXPECT_EQ(Read().rig_status, 0U);
  EXPECT_EQ(guarded.line_counters().write_failures, 1U);
}

TEST_F(GuardedPortTest, AFrameThatCouldNotBeSentStillSwitchesTheLines) {
  guarded.Write({.amplifiers_enabled = true});
  port.takes = false;
  EXPECT_FALSE(guarded.Write({.amplifiers_enabled = false}));
  EXPECT_FALSE(lines.enable);
}

TEST_F(GuardedPortTest, AGoodbyeDropsTheEnableLineAndReachesThePortBelow) {
  guarded.Write({.cycle = 1, .axes = 4, .amplifiers_enabled = true});
  ASSERT_TRUE(lines.enable);
  guarded.SayGoodbye({.cycle = 2, .axes = 4, .amplifiers_enabled = true});
  EXPECT_FALSE(lines.enable);
  EXPECT_EQ(port.goodbye_cycle, 2U);
}

TEST_F(GuardedPortTest, TroubleIsThatOfThePortBelow) {
  EXPECT_EQ(guarded.Trouble(), "1 x bus off");
}

TEST_F(GuardedPortTest, CountersAreThoseOfThePortBelow) {
  EXPECT_EQ(guarded.counters().frames_read, 17U);
}

TEST(GuardedPortSpeed, ComesFromTheKeyPhasorAtTheSamplingInstant) {
  FakePort port;
  FakeLines lines;
  LinesConfig config;
  config.key_phasor = test::Config();
  GuardedPort guarded(port, lines, config);
  SensorFrame frame;
  for (int k = 0; k < 40; ++k) {
    lines.pulses.push_back(k * test::kTurnNs);
    port.next.sample_time_ns = k * test::kTurnNs + test::kTurnNs / 4;
    (void)guarded.Read(frame, 0);
  }
  EXPECT_NEAR(frame.speed_rad_per_s, test::kSpeed, 1e-9 * test::kSpeed);
  EXPECT_NEAR(frame.angle_rad, test::kTurnRad / 4, 1e-6);
  EXPECT_EQ(frame.rig_status, 0U);
  EXPECT_EQ(guarded.line_counters().pulses.good, 38U) << "all but the two that lock";
}

TEST(GuardedPortSpeed, AnUnknownSpeedIsABitOfTheStatus) {
  FakePort port;
  FakeLines lines;
  LinesConfig config;
  config.key_phasor = test::Config();
  GuardedPort guarded(port, lines, config);
  SensorFrame frame;
  for (int k = 0; k < 10; ++k) lines.pulses.push_back(k * test::kTurnNs);
  port.next.sample_time_ns = 9 * test::kTurnNs;
  (void)guarded.Read(frame, 0);
  port.next.sample_time_ns = 20 * test::kTurnNs;
  (void)guarded.Read(frame, 0);
  EXPECT_EQ(frame.rig_status, kRigSpeedUnknown);
  EXPECT_NEAR(frame.speed_rad_per_s, test::kSpeed, 1e-9 * test::kSpeed) << "the last good one";
}

TEST_F(GuardedPortTest, ACycleAllocatesNothing) {
  const levitas::test::AllocationGuard guard;
  for (int i = 0; i < 10'000; ++i) {
    (void)guarded.Read(frame, 0);
    guarded.Write({.amplifiers_enabled = i % 7 == 0});
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace levitas::gpio
