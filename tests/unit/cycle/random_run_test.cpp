// The whole cycle over random rigs and operators: what leaves it is always safe to hand to an
// amplifier, and a trip stands until an accepted reset.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/unit/cycle/cycle_rig.hpp"

namespace levitas::cycle {
namespace {

/// Short ramps, so that a few thousand cycles pass through every mode.
CycleConfig Quick() {
  CycleConfig config = FlexibleRotorCycle();
  auto& sequence = config.supervisor.sequence;
  sequence.self_test_s = 0.001;
  sequence.lift_ramp_s = 0.002;
  sequence.lift_settle_s = 0.0005;
  sequence.lift_timeout_s = 0.02;
  sequence.landing_ramp_s = 0.002;
  return config;
}

class RandomRig {
 public:
  explicit RandomRig(std::uint64_t seed) : draw_(seed) { rig_.position_m = {}; }

  CycleInputs Next() {
    using enum OperatorCommand;
    static constexpr std::array kWanted{kLift,      kLift, kLift,          kSpin,  kSpin,
                                        kCoastDown, kLand, kEmergencyStop, kReset, kReset};
    const bool pressed = draw_.Bits() % 20 == 0;
    if (draw_.Bits() % 150 == 0) standing_ = !standing_;
    rig_.speed_rad_per_s = standing_ ? 0.0 : 200.0;
    CycleInputs in = rig_.Next(pressed ? kWanted[draw_.Bits() % kWanted.size()] : kNone);
    in.op.speed_rad_per_s = draw_.Bits() % 4 == 0 ? 0.0 : 300.0;
    in.op.acceleration_rad_per_s2 = 50.0;
    in.op.excitation_a.fill(0.3 * draw_.Normal());
    if (draw_.Bits() % 300 == 0) Spoil(in);
    return in;
  }

 private:
  void Spoil(CycleInputs& in) {
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    switch (draw_.Bits() % 7) {
      case 0:
        in.frame_present = false;
        break;
      case 1:
        in.frame.position_m[draw_.Bits() % 4] = std::numeric_limits<double>::quiet_NaN();
        break;
      case 2:
        in.frame.speed_rad_per_s = draw_.Bits() % 2 == 0 ? kInfinity : -1e308;
        break;
      case 3:
        in.frame.rig_status = kRigEmergencyStop;
        break;
      case 4:
        in.frame.position_m.fill(1e-3 * draw_.Normal());
        break;
      case 5:
        in.missed_deadlines = static_cast<std::uint32_t>(draw_.Bits() % 10);
        break;
      default:
        in.op.excitation_a.fill(draw_.Bits() % 2 == 0 ? 1e308 : -kInfinity);
        break;
    }
  }

  Random draw_;
  StillRig rig_;
  bool standing_{true};
};

TEST(RandomRun, GivesCurrentsThatBothCoilsOfEveryAxisCanCarry) {
  const CycleConfig config = Quick();
  std::array<std::uint64_t, kModeCount> visited{};
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    ControlCycle control(config);
    RandomRig rig(seed);
    for (int i = 0; i < 4000; ++i) {
      const CycleOutputs out = control.Step(rig.Next());
      const CurrentFrame& current = out.current;
      for (const double control_a : current.control_current_a) {
        // Coils get i0 + ic and i0 - ic: within 0 .. the largest coil current. 1e-12 A: rounding.
        ASSERT_TRUE(std::isfinite(control_a)) << "seed " << seed << ", cycle " << i;
        ASSERT_GE(current.bias_current_a - std::abs(control_a), -1e-12);
        ASSERT_LE(current.bias_current_a + std::abs(control_a),
                  config.rig.max_coil_current_a + 1e-12);
      }
      ASSERT_EQ(current.amplifiers_enabled, current.bias_current_a > 0.0);
      ASSERT_TRUE(std::isfinite(current.speed_set_point_rad_per_s));
      ASSERT_LE(std::abs(current.speed_set_point_rad_per_s), config.rig.max_speed_rad_per_s);
      ASSERT_GE(current.acceleration_limit_rad_per_s2, 0.0);
      ++visited[static_cast<std::size_t>(out.mode)];
    }
  }
  for (std::uint8_t mode = 0; mode < kModeCount; ++mode) {
    EXPECT_GT(visited[mode], 0U) << Name(static_cast<Mode>(mode));
  }
}

TEST(RandomRun, KeepsATripsCauseUntilAResetThatIsAccepted) {
  std::uint64_t trips = 0;
  std::uint64_t resets = 0;
  for (std::uint64_t seed = 100; seed <= 130; ++seed) {
    ControlCycle control(Quick());
    RandomRig rig(seed);
    CycleOutputs before;
    for (int i = 0; i < 4000; ++i) {
      const CycleInputs in = rig.Next();
      const CycleOutputs out = control.Step(in);
      ASSERT_EQ(out.fault != Fault::kNone, out.mode == Mode::kTripped) << seed << " " << i;
      if (before.fault == Fault::kNone) {
        trips += out.fault != Fault::kNone ? 1 : 0;
      } else if (out.fault == Fault::kNone) {
        ASSERT_EQ(in.op.command, OperatorCommand::kReset) << seed << " " << i;
        ASSERT_FALSE(out.command_refused);
        ASSERT_EQ(out.mode, Mode::kOff);
        ASSERT_FALSE(before.current.amplifiers_enabled) << "reset while still levitated";
        ++resets;
      } else {
        ASSERT_EQ(out.fault, before.fault) << seed << " " << i;
        ASSERT_EQ(out.fault_axis, before.fault_axis);
        ASSERT_EQ(out.fault_value, before.fault_value);
        ASSERT_EQ(out.fault_limit, before.fault_limit);
        // A released rotor is never caught again by the same trip.
        if (!before.current.amplifiers_enabled) {
          ASSERT_FALSE(out.current.amplifiers_enabled) << seed << " " << i;
        }
      }
      before = out;
    }
  }
  EXPECT_GT(trips, 30U);  // or the walk met nothing
  EXPECT_GT(resets, 20U);
}

}  // namespace
}  // namespace levitas::cycle
