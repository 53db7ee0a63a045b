// Faults of the rotor's angle in pairs: a block that believes it, and one that is watched.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/loop/synchronous/notch_loop.hpp"

namespace levitas::test {
namespace {

using synchronous::BlockState;
using synchronous::Ending;
using synchronous::Target;

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
constexpr double kPairRpm = 3000.0;

/// A fault of the angle sensor: the angle that the controller receives from the moment it begins.
struct AngleFault {
  const char* name;
  std::function<double(double true_rad, double begin_rad, double turned_rad)> told;
  bool harms;  ///< a block that believes it makes the orbit larger than no block at all
};

double Within(double angle_rad) {
  return angle_rad - kWholeTurn * std::floor(angle_rad / kWholeTurn);
}

void PrintTo(const AngleFault& fault, std::ostream* out) { *out << fault.name; }

/// Largest orbit while the fault lasts three seconds.
double OrbitWith(Target target, const AngleFault& fault, bool watched, Ending* ending) {
  cycle::CycleConfig config =
      WithBlock(Asked(target, 1500.0, target == Target::kCurrent ? 4400.0 : 3400.0));
  if (!watched) {
    config.synchronous.angle.largest_error_rad = 1e9;
    config.synchronous.angle.largest_speed_share = 1e9;
    config.synchronous.orbit_growth = 1e9;
  }
  ClosedLoop loop(config);
  EXPECT_TRUE(loop.Levitate());
  loop.SpinAt(kPairRpm);
  loop.Run(3.0);
  EXPECT_EQ(loop.out.synchronous[0].state, BlockState::kActing);
  loop.Reset();
  const double begin_rad = loop.plant.angle_rad();
  double turned_rad = 0.0;
  loop.disturb = [&](cycle::CycleInputs& in) {
    in.frame.angle_rad = Within(fault.told(in.frame.angle_rad, begin_rad, turned_rad));
    turned_rad += in.frame.speed_rad_per_s * 1e-4;
  };
  const double turn_s = 60.0 / kPairRpm;
  loop.Run(turn_s);
  if (ending != nullptr) {
    *ending = loop.out.synchronous[0].ending;
    EXPECT_NE(loop.out.synchronous[0].state, BlockState::kActing) << "within a turn";
  }
  loop.Run(3.0 - turn_s);
  EXPECT_TRUE(!watched || loop.out.fault == Fault::kNone);
  return loop.most.orbit_m;
}

double PlainOrbit() {
  static const double orbit_m = [] {
    ClosedLoop loop(CommissionedCycle());
    EXPECT_TRUE(loop.Levitate());
    loop.SpinAt(kPairRpm);
    loop.Run(3.0);
    loop.Reset();
    loop.Run(3.0);
    return loop.most.orbit_m;
  }();
  return orbit_m;
}

class AnglePairs : public testing::TestWithParam<std::tuple<Target, AngleFault>> {};

TEST_P(AnglePairs, BelievedItHarmsAndWatchedItEndsTheBlockWithinATurn) {
  const auto& [target, fault] = GetParam();
  if (fault.harms) {
    EXPECT_GT(OrbitWith(target, fault, false, nullptr), 1.3 * PlainOrbit());
  }
  Ending ending{};
  EXPECT_LT(OrbitWith(target, fault, true, &ending), 1.12 * PlainOrbit());
  EXPECT_EQ(ending, Ending::kAngleJumped);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, AnglePairs,
    testing::Combine(
        testing::Values(Target::kCurrent, Target::kVibration),
        testing::Values(
            AngleFault{"half_a_turn_off",
                       [](double a, double, double) { return a + 0.5 * kWholeTurn; }, true},
            AngleFault{"stuck", [](double, double b, double) { return b; }, true},
            AngleFault{"half_the_speed",
                       [](double, double b, double turned) { return b + 0.5 * turned; }, true},
            AngleFault{"twice_the_speed",
                       [](double, double b, double turned) { return b + 2.0 * turned; }, true},
            AngleFault{"late", [](double a, double, double) { return a - kWholeTurn / 6.0; },
                       false},
            AngleFault{
                "random",
                [](double a, double, double turned) { return a + 1e4 * std::sin(1234.5 * turned); },
                false})));

}  // namespace
}  // namespace levitas::test
