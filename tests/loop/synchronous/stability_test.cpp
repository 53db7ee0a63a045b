// Where a block may act: the judgement of the linear loop beside what the nonlinear rig does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/synchronous_loop.hpp"
#include "tests/loop/synchronous/notch_loop.hpp"

namespace levitas::test {
namespace {

using synchronous::BlockState;
using synchronous::Ending;
using synchronous::Target;

/// The speed at which T = 1 is worst.
double WorstSpeed() {
  synchronous::SynchronousConfig control;
  control.blocks.push_back(PlainNotch(300.0, 6000.0));
  const auto law = CommissionedCycle().law;
  double worst = 1.0;
  double at = 0.0;
  for (const double speed : analysis::JudgedSpeeds(control, 60)) {
    const auto judged = analysis::JudgeSynchronous(
        analysis::CloseLoop(ShippedRig().plant, law, speed), control, speed);
    if (judged.blocks.front().slowest_decay >= worst) continue;
    worst = judged.blocks.front().slowest_decay;
    at = speed;
  }
  EXPECT_LT(worst, 0.0) << "T = 1 is stable everywhere on this rig: nothing to show";
  return at;
}

cycle::CycleConfig With(const synchronous::BlockConfig& block, double orbit_growth) {
  cycle::CycleConfig config = CommissionedCycle();
  config.synchronous.blocks.push_back(block);
  config.synchronous.orbit_growth = orbit_growth;
  return config;
}

TEST(NotchStability, AMatrixThatIsNoInverseDrivesTheRotorIntoContactAndTheInverseDoesNot) {
  const double rpm = RadPerSToRpm(WorstSpeed());
  const auto plain = PlainNotch(rpm - 50.0, rpm + 50.0);
  ClosedLoop harmed(Unwatched(With(plain, 1000.0)));
  EXPECT_TRUE(TouchesAt(harmed, rpm)) << "at " << rpm << " rpm";

  ClosedLoop held(WithBlock(Asked(Target::kCurrent, rpm - 50.0, rpm + 50.0)));
  ASSERT_TRUE(TurnsAt(held, rpm, 20.0));
  EXPECT_EQ(held.out.fault, Fault::kNone);
  EXPECT_EQ(held.out.synchronous[0].state, BlockState::kActing);
}

TEST(NotchStability, TheGrowingOrbitEndsTheBlockBeforeItTrips) {
  const double rpm = RadPerSToRpm(WorstSpeed());
  ClosedLoop loop(With(PlainNotch(rpm - 50.0, rpm + 50.0), 2.0));
  ASSERT_TRUE(loop.Levitate());
  loop.SpinAt(rpm);
  ASSERT_TRUE(
      loop.RunUntil(60.0, [&] { return loop.out.synchronous[0].state == BlockState::kEnded; }));
  EXPECT_EQ(loop.out.synchronous[0].ending, Ending::kOrbitGrew);
  loop.Run(2.0);
  EXPECT_EQ(loop.out.fault, Fault::kNone);
  EXPECT_EQ(loop.out.mode, Mode::kSpinning);
}

/// `request` with its table, judged on the file's rig alone.
design::NotchFigures Judged(design::NotchRequest request) {
  const auto law = CommissionedCycle().law;
  if (request.block.inverse.empty()) {
    request.block = design::WithInverse(ShippedRig(), law, request);
  }
  return design::JudgeNotch(ShippedRig(), {}, law, request);
}

TEST(NotchStability, TheDesignRefusesItWithItsSpeeds) {
  design::NotchRequest plain;
  plain.block = PlainNotch(300.0, 6000.0);
  const auto refused = Judged(plain);
  EXPECT_NE(refused.RefusedSpeeds().find("eigenvalue"), std::string::npos);
  const double worst = WorstSpeed();
  const auto nearest = std::ranges::min_element(
      refused.speeds, {}, [&](const auto& at) { return std::abs(at.speed_rad_per_s - worst); });
  EXPECT_FALSE(nearest->allowed());
  const auto allowed = Judged(Asked(Target::kCurrent, 300.0, 4400.0));
  EXPECT_TRUE(allowed.allowed()) << allowed.RefusedSpeeds();
  for (const auto& at : allowed.speeds) EXPECT_NEAR(at.slowest_decay, 1.0, 0.1);
}

TEST(NotchStability, NoNotchCrossesACriticalSpeedWithoutTheBearings) {
  // The first bending mode, held by nothing but the law.
  const auto figures = Judged(Asked(Target::kCurrent, 1500.0, 6000.0));
  EXPECT_NE(figures.RefusedSpeeds().find("orbit could grow"), std::string::npos);
  EXPECT_EQ(figures.AllowedSpeeds().find("1500 to 4"), 0U) << figures.AllowedSpeeds();
  for (const auto& at : figures.speeds) {
    const double rpm = RadPerSToRpm(at.speed_rad_per_s);
    if (rpm > 4900.0 && rpm < 5400.0) {
      EXPECT_FALSE(at.allowed()) << rpm;
    }
    if (rpm < 4300.0) {
      EXPECT_TRUE(at.allowed()) << rpm << ": " << at.refused;
    }
  }
}

TEST(NotchStability, NoCurrentIsSpentWhereTheMagnetsDoNotMoveTheSensors) {
  // Near 4000 rpm a node lies between: the shaft bends under the magnet and stands at the sensor.
  const auto figures = Judged(Asked(Target::kVibration, 1500.0, 6000.0));
  EXPECT_NE(figures.RefusedSpeeds().find("hardly move"), std::string::npos);
  EXPECT_TRUE(Judged(Asked(Target::kVibration, 1500.0, 3400.0)).allowed());
  EXPECT_TRUE(Judged(Asked(Target::kVibration, 4700.0, 6000.0)).allowed());
}

TEST(NotchStability, ADirectionAloneIsJudgedByItself) {
  auto request = Asked(Target::kCurrent, 1500.0, 4400.0);
  request.direction = design::Direction::kForward;
  const auto figures = Judged(request);
  EXPECT_TRUE(figures.allowed()) << figures.RefusedSpeeds();
  for (const auto& at : figures.speeds) EXPECT_NEAR(at.slowest_decay, 1.0, 0.1);
}

}  // namespace
}  // namespace levitas::test
