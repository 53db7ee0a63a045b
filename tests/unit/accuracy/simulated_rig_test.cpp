// The rig under the cycle of `amb run`: from off to its speed, and what the line does on the way.

#include "benchmark/accuracy/simulated_rig.hpp"

#include <gtest/gtest.h>

#include "benchmark/accuracy/trial.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::accuracy {
namespace {

const TestRig& ShippedBench() {
  static const TestRig bench = LoadTestRig("flexible_rotor", {"flexible_rotor_commissioned"});
  return bench;
}

plant::Plant ShippedPlant() { return {ShippedBench().rig.plant, 1}; }

/// Loses every frame once it is cut.
class CutLine final : public RigLine {
 public:
  bool Deliver(SensorFrame& /*frame*/) override { return !cut; }
  void Pass(const SensorFrame& /*frame*/, plant::PlantCommand& command) override {
    command.control_current_a[0] += added_a;
  }
  bool cut{};
  double added_a{};
};

TEST(SimulatedRig, IsLiftedAndBroughtToItsSpeed) {
  SimulatedRig rig(ShippedBench().Cycle(0), ShippedPlant());
  ASSERT_TRUE(rig.Lift());
  EXPECT_EQ(rig.record().out.mode, Mode::kLevitating);
  const double speed = RpmToRadPerS(1000.0);
  ASSERT_TRUE(rig.SpinUp(speed, RpmToRadPerS(2000.0), 0.1));
  EXPECT_EQ(rig.record().out.mode, Mode::kSpinning);
  EXPECT_DOUBLE_EQ(rig.record().in.frame.speed_rad_per_s, speed);
}

TEST(SimulatedRig, SaysThatItDoesNotLevitate) {
  cycle::CycleConfig weak = ShippedBench().Cycle(0);
  for (law::AxisLawConfig& axis : weak.law.axes) axis.kp_a_per_m *= 0.1;
  SimulatedRig rig(weak, ShippedPlant());
  EXPECT_FALSE(rig.Lift());
  EXPECT_EQ(rig.record().out.mode, Mode::kTripped);
  SimulatedRig other(weak, ShippedPlant());
  EXPECT_THROW(other.Levitate(), std::runtime_error);
}

TEST(SimulatedRig, RefusesASpeedThatItsDriveDoesNotReach) {
  SimulatedRig rig(ShippedBench().Cycle(0), ShippedPlant());
  ASSERT_TRUE(rig.Lift());
  EXPECT_FALSE(rig.SpinUp(RpmToRadPerS(60e3), RpmToRadPerS(2000.0)));
  EXPECT_EQ(rig.record().out.mode, Mode::kLevitating);
}

TEST(SimulatedRig, HoldsTheLastFrameAndItsCurrentsUntilTheMissingOnesTrip) {
  CutLine line;
  SimulatedRig rig(ShippedBench().Cycle(0), ShippedPlant(), &line);
  ASSERT_TRUE(rig.Lift());
  const cycle::CycleRecord last = rig.record();
  line.cut = true;
  const cycle::CycleRecord& now = rig.Step();
  EXPECT_FALSE(now.in.frame_present);
  EXPECT_EQ(now.in.frame.cycle, last.in.frame.cycle);
  EXPECT_EQ(now.in.frame.position_m, last.in.frame.position_m);
  EXPECT_EQ(now.out.current.control_current_a, last.out.current.control_current_a);
  rig.Run(0.01);
  EXPECT_EQ(rig.record().out.fault, Fault::kFrameMissing);
}

// 0.05 A more than is recorded: the law's integrator takes it back, and the record shows only that.
TEST(SimulatedRig, PassesCurrentsOnThatNoRecordHas) {
  constexpr double kAddedA = 0.05;
  const auto mean = [](SimulatedRig& rig) {
    constexpr int kPeriods = 2000;
    double sum_a = 0.0;
    for (int n = 0; n < kPeriods; ++n) sum_a += rig.Step().out.current.control_current_a[0];
    return sum_a / kPeriods;
  };
  CutLine line;
  SimulatedRig rig(ShippedBench().Cycle(0), ShippedPlant(), &line);
  ASSERT_TRUE(rig.Lift());
  const double before_a = mean(rig);
  line.added_a = kAddedA;
  rig.Run(1.0);
  EXPECT_NEAR(mean(rig), before_a - kAddedA, 0.1 * kAddedA);
}

}  // namespace
}  // namespace levitas::accuracy
