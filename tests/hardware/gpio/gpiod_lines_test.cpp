// The adapter on the kernel's own GPIO driver: levels at request, at work and at the end, edges.
#include "hil/libgpiod/gpiod_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <optional>
#include <thread>

#include "common/problem.hpp"
#include "hil/rig_lines/gpio_sim.hpp"
#include "rt/clock.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/gpio_sim_chip.hpp"
#include "tests/support/waiting.hpp"

namespace levitas::gpio {
namespace {

using testing::HasSubstr;

struct GpiodLinesTest : testing::Test {
  test::GpioSimChip chip{8};
  LinesConfig config;

  [[nodiscard]] std::string RefusalOf(const LinesConfig& wanted) const {
    try {
      const GpiodLines lines(wanted);
    } catch (const Problem& problem) {
      return problem.what();
    }
    return "";
  }
};

TEST_F(GpiodLinesTest, OutputsBecomeInactiveOutputsWhateverTheirWireWasPulledTo) {
  for (const bool active_high : {true, false}) {
    config.amplifier_enable = chip.Line(1, active_high);
    config.heartbeat = HeartbeatConfig{.line = chip.Line(3, active_high)};
    SimulatedLine enable(*config.amplifier_enable);
    SimulatedLine heartbeat(config.heartbeat->line);
    enable.Pull(true);
    heartbeat.Pull(true);
    ASSERT_TRUE(enable.Driven()) << "as long as nobody drives them";
    const GpiodLines lines(config);
    EXPECT_FALSE(enable.Driven());
    EXPECT_FALSE(heartbeat.Driven());
    enable.Pull(false);
    heartbeat.Pull(false);
  }
}

TEST_F(GpiodLinesTest, OutputsFollowWhatIsWritten) {
  for (const bool active_high : {true, false}) {
    config.amplifier_enable = chip.Line(1, active_high);
    config.heartbeat = HeartbeatConfig{.line = chip.Line(3)};
    const SimulatedLine enable(*config.amplifier_enable);
    const SimulatedLine heartbeat(config.heartbeat->line);
    GpiodLines lines(config);
    for (const bool active : {true, false, true}) {
      EXPECT_TRUE(lines.WriteEnable(active));
      EXPECT_EQ(enable.Driven(), active);
      EXPECT_TRUE(lines.WriteHeartbeat(!active));
      EXPECT_EQ(heartbeat.Driven(), !active);
    }
  }
}

TEST_F(GpiodLinesTest, ABrokenWireOfTheStopChainIsAnOpenChain) {
  for (const bool active_high : {true, false}) {
    config.emergency_stop = chip.Line(0, active_high);
    SimulatedLine chain(*config.emergency_stop);
    GpiodLines lines(config);
    chain.Pull(true);
    EXPECT_TRUE(lines.ReadInputs().stop_chain_closed);
    chain.Pull(false);  // what the resistor does when the wire is gone
    EXPECT_FALSE(lines.ReadInputs().stop_chain_closed);
    EXPECT_TRUE(lines.ReadInputs().readable);
  }
}

TEST_F(GpiodLinesTest, TheChipsOwnPullMakesUnconnectedInputsUnsafe) {
  for (const bool active_high : {true, false}) {
    config.emergency_stop = chip.Line(0, active_high);
    config.amplifier_fault = chip.Line(2, active_high);
    config.emergency_stop->bias = config.amplifier_fault->bias = Bias::kInternal;
    GpiodLines lines(config);
    EXPECT_FALSE(lines.ReadInputs().stop_chain_closed);
    EXPECT_TRUE(lines.ReadInputs().amplifier_fault);
  }
}

TEST_F(GpiodLinesTest, LinesThatTheRigDoesNotHaveAreHealthyAndTakeEveryWrite) {
  GpiodLines lines(config);
  EXPECT_TRUE(lines.ReadInputs().stop_chain_closed);
  EXPECT_FALSE(lines.ReadInputs().amplifier_fault);
  EXPECT_TRUE(lines.WriteEnable(true));
  EXPECT_TRUE(lines.WriteHeartbeat(true));
  EXPECT_TRUE(lines.guard_alive());
}

TEST_F(GpiodLinesTest, PulsesCarryTheTimeOfTheirEdgeAndOnlyOfTheActiveOne) {
  for (const bool active_high : {true, false}) {
    config.key_phasor = KeyPhasorConfig{.line = chip.Line(4, active_high)};
    SimulatedLine shaft(config.key_phasor->line);
    shaft.Pull(false);
    GpiodLines lines(config);
    std::array<std::int64_t, 16> pulses{};
    EXPECT_EQ(lines.ReadPulses(pulses), 0U) << "and did not wait for one";
    std::array<std::int64_t, 5> before_ns{};
    std::array<std::int64_t, 5> after_ns{};
    for (std::size_t k = 0; k < before_ns.size(); ++k) {
      before_ns.at(k) = rt::MonotonicNowNs();
      shaft.Pull(true);
      after_ns.at(k) = rt::MonotonicNowNs();
      shaft.Pull(false);
      test::Pause(std::chrono::milliseconds(30), "three ticks or more between two turns");
    }
    ASSERT_EQ(lines.ReadPulses(pulses), before_ns.size());
    for (std::size_t k = 0; k < before_ns.size(); ++k) {
      EXPECT_GE(pulses.at(k), before_ns.at(k));
      // gpio-sim delivers its interrupt at the next tick of the kernel, at the latest after 10 ms.
      EXPECT_LE(pulses.at(k), after_ns.at(k) + 10'000'000);
    }
    EXPECT_EQ(lines.ReadPulses(pulses), 0U);
  }
}

TEST_F(GpiodLinesTest, AllLinesThatCannotBeHadAreNamedAtOnce) {
  config.emergency_stop = chip.Line(0);
  config.amplifier_enable = LinePlace{.chip = "no_such_chip", .offset = 1};
  config.amplifier_fault = chip.Line(8);  // the chip has 0 to 7
  const std::string text = RefusalOf(config);
  EXPECT_THAT(text, HasSubstr("lines.amplifier_enable: no_such_chip line 1: no such chip"));
  EXPECT_THAT(text, HasSubstr("lines.amplifier_fault: " + chip.name() +
                              " line 8: no such line on the chip"));
  EXPECT_THAT(text, testing::Not(HasSubstr("emergency_stop")));
}

TEST_F(GpiodLinesTest, ALineInUseIsRefusedWithItsUser) {
  config.emergency_stop = chip.Line(0);
  const GpiodLines first(config);
  EXPECT_THAT(RefusalOf(config), HasSubstr("in use by amb-controller"));
}

TEST_F(GpiodLinesTest, TheEndLeavesThePulledDownLinesInactiveAndFree) {
  config.amplifier_enable = chip.Line(1);
  const SimulatedLine enable(*config.amplifier_enable);
  for (int i = 0; i < 3; ++i) {
    GpiodLines lines(config);
    ASSERT_TRUE(lines.WriteEnable(true));
    ASSERT_TRUE(enable.Driven());
  }
  EXPECT_FALSE(enable.Driven());
}

TEST_F(GpiodLinesTest, ACycleAllocatesNothing) {
  config.emergency_stop = chip.Line(0);
  config.amplifier_enable = chip.Line(1);
  config.heartbeat = HeartbeatConfig{.line = chip.Line(3)};
  config.key_phasor = KeyPhasorConfig{.line = chip.Line(4)};
  GpiodLines lines(config);
  std::array<std::int64_t, 16> pulses{};
  const test::AllocationGuard guard;
  for (int i = 0; i < 1000; ++i) {
    (void)lines.ReadInputs();
    (void)lines.ReadPulses(pulses);
    lines.WriteEnable(i % 2 == 0);
    lines.WriteHeartbeat(i % 3 == 0);
    lines.CycleDone();
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace levitas::gpio
