// The hardest ends of a turning rotor over the messages of the CAN buses, which carry positions in
// steps, the speed and the drive's set point in slow messages, and a status of a few bits.

#include <gtest/gtest.h>

#include "tests/loop/can/can_loop.hpp"

namespace levitas::test {
namespace {

constexpr double kRpm = 3000.0;

/// Levitated to the end: braked, lowered and switched off when it stood.
void ExpectLanded(CanLoop& loop) {
  ASSERT_TRUE(loop.RunUntil(8.0, [&] { return !loop.out.current.amplifiers_enabled; }));
  EXPECT_LE(std::abs(loop.released_rpm), 5.0);
  EXPECT_EQ(loop.lowered, 0);
  EXPECT_EQ(loop.driven_contact, 0);
}

TEST(StopOverCan, AnEmergencyStopBrakesAndLandsTheRotor) {
  CanLoop loop;
  ASSERT_TRUE(loop.TurnAt(kRpm));
  loop.Command(OperatorCommand::kEmergencyStop);
  ExpectLanded(loop);
  EXPECT_EQ(loop.out.fault, Fault::kEmergencyStop);
  EXPECT_EQ(loop.unbraked, 0);
}

// As a pair: a speed of zero, of no number, in all messages of ten milliseconds lands nothing.
TEST(StopOverCan, AWrongSpeedOfAMomentDoesNotLowerATurningRotor) {
  for (const double wrong : {0.0, std::nan("")}) {
    CanLoop loop;
    ASSERT_TRUE(loop.TurnAt(kRpm));
    loop.Command(OperatorCommand::kEmergencyStop);
    const std::uint64_t now = loop.cycles;
    int heard_wrong = 0;
    loop.to_rig = [&] {
      if (!(loop.heard().speed_rad_per_s > 1.0) && !loop.Stands()) ++heard_wrong;
    };
    loop.disturb = [&](SensorFrame& frame) {
      if (frame.cycle > now + 5000 && frame.cycle < now + 5100) frame.speed_rad_per_s = wrong;
    };
    ExpectLanded(loop);
    EXPECT_GT(heard_wrong, 0);  // it does not get lost between two of the slow messages
  }
}

// The drive's command comes in slow messages, the currents' end at once: the brake must follow.
TEST(StopOverCan, AReleaseAtSpeedIsBrakedUntilTheRotorStands) {
  CanLoop loop;
  ASSERT_TRUE(loop.TurnAt(kRpm));
  loop.disturb = [](SensorFrame& frame) { frame.position_m[0] = std::nan(""); };
  for (int period = 0; period < 10; ++period) (void)loop.Step();
  EXPECT_EQ(loop.out.fault, Fault::kSensorNotFinite);
  EXPECT_GT(loop.released_rpm, 0.99 * kRpm);
  loop.disturb = nullptr;
  EXPECT_TRUE(loop.RunUntil(8.0, [&] { return loop.Stands(); }));
  EXPECT_EQ(loop.unbraked, 0);
  EXPECT_EQ(loop.driven_contact, 0);
}

// Half of the positions lost in bursts of five: the rotor is held, braked and landed.
TEST(StopOverCan, PositionsLostInBurstsStopTheRotorLevitated) {
  CanLoop loop;
  ASSERT_TRUE(loop.TurnAt(kRpm));
  loop.to_controller = [&] {
    if (loop.cycles % 10 < 5) loop.controller_bus.arrived.clear();
  };
  ASSERT_TRUE(loop.RunUntil(1.0, [&] { return loop.out.fault != Fault::kNone; }));
  EXPECT_EQ(loop.out.fault, Fault::kFramesLost);
  loop.to_controller = nullptr;
  ExpectLanded(loop);
}

// The rig says in a bit of its status that it held its currents: enough to stop in time.
TEST(StopOverCan, CurrentsLostInBurstsStopTheRotorBeforeTheRigsOwnWatchdogDoes) {
  CanLoop loop;
  ASSERT_TRUE(loop.TurnAt(kRpm));
  loop.to_rig = [&] {
    if (loop.cycles % 10 < 5) loop.rig_bus.arrived.clear();
  };
  ASSERT_TRUE(loop.RunUntil(1.0, [&] { return loop.out.fault != Fault::kNone; }));
  EXPECT_EQ(loop.out.fault, Fault::kCurrentsLate);
  EXPECT_TRUE(loop.out.current.amplifiers_enabled);
  loop.to_rig = nullptr;
  ExpectLanded(loop);
}

}  // namespace
}  // namespace levitas::test
