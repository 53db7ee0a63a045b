// A rotor without a mark, and a controller that is shown a wrong speed of it: a block that
// integrates that speed leaves most of the current, one that estimates its angle from the orbit
// takes it away.
#include <gtest/gtest.h>

#include <functional>

#include "common/random.hpp"
#include "tests/loop/synchronous/notch_loop.hpp"

namespace levitas::test {
namespace {

using synchronous::AngleSource;
using synchronous::BlockState;
using synchronous::Target;

/// What the controller is shown: no angle, and the speed times this.
std::function<void(cycle::CycleInputs&)> Told(double share) {
  return [share](cycle::CycleInputs& in) {
    in.frame.speed_rad_per_s *= share;
    in.frame.angle_rad = 0.0;
  };
}

/// The rotor turns at `rpm`, the controller is shown `told` times that, and a block of target
/// current acts on it.
struct Unmarked {
  Unmarked(AngleSource source, double rpm, double told, bool watched = true)
      : loop([=] {
          cycle::CycleConfig config = WithBlock(Asked(Target::kCurrent, 1500.0, 4200.0));
          config.synchronous.angle.source = source;
          if (!watched) {
            config.synchronous.angle.largest_error_rad = 1e9;
            config.synchronous.angle.largest_speed_share = 1e9;
            config.synchronous.orbit_growth = 1e9;
          }
          return config;
        }()) {
    loop.disturb = Told(told);
    turns = TurnsAt(loop, rpm, 8.0);
  }
  ClosedLoop loop;
  bool turns{};
};

double PlainCurrent(double rpm) {
  ClosedLoop plain(CommissionedCycle());
  EXPECT_TRUE(TurnsAt(plain, rpm, 3.0));
  return Measure(plain, 100).current_a;
}

TEST(OrbitAngle, TakesTheCurrentAwayWhereASpeedThatIsToldWrongLeavesMostOfIt) {
  Random draw(17);
  for (int n = 0; n < 4; ++n) {
    const double rpm = 1700.0 + 2200.0 * draw.Uniform();
    const double told = 1.0 + (n % 2 == 0 ? 1.0 : -1.0) * (0.01 + 0.04 * draw.Uniform());
    const double before_a = PlainCurrent(rpm);
    Unmarked believed(AngleSource::kSpeed, rpm, told);
    ASSERT_TRUE(believed.turns);
    EXPECT_GT(Decibel(Measure(believed.loop, 100).current_a, before_a), -10.0)
        << rpm << " " << told;
    Unmarked estimated(AngleSource::kOrbit, rpm, told);
    ASSERT_TRUE(estimated.turns);
    EXPECT_EQ(estimated.loop.out.synchronous[0].state, BlockState::kActing);
    EXPECT_LT(Decibel(Measure(estimated.loop, 100).current_a, before_a), -40.0)
        << rpm << " " << told;
  }
}

// A drive whose slip changes by more than is followed, beside a block that goes on believing it.
TEST(OrbitAngle, ASlipThatJumpsEndsTheBlockBeforeItHarms) {
  constexpr double kRpm = 3000.0;
  const auto orbit_after = [](bool watched, BlockState* state) {
    Unmarked rotor(AngleSource::kOrbit, kRpm, 0.97, watched);
    EXPECT_TRUE(rotor.turns);
    EXPECT_EQ(rotor.loop.out.synchronous[0].state, BlockState::kActing);
    rotor.loop.disturb = Told(1.09);
    rotor.loop.Run(0.1);
    *state = rotor.loop.out.synchronous[0].state;
    rotor.loop.Reset();
    rotor.loop.Run(0.3);
    EXPECT_EQ(rotor.loop.out.fault, Fault::kNone);
    return rotor.loop.most.orbit_m;
  };
  ClosedLoop plain(CommissionedCycle());
  ASSERT_TRUE(TurnsAt(plain, kRpm, 3.0));
  BlockState believed{}, watched{};
  EXPECT_GT(orbit_after(false, &believed), 1.2 * plain.most.orbit_m);
  EXPECT_EQ(believed, BlockState::kActing);
  EXPECT_LT(orbit_after(true, &watched), 1.1 * plain.most.orbit_m);
  EXPECT_NE(watched, BlockState::kActing);
}

TEST(OrbitAngle, AnOrbitTooSmallToBeFollowedBeginsNoBlock) {
  cycle::CycleConfig config = WithBlock(Asked(Target::kCurrent, 1500.0, 4200.0));
  config.synchronous.angle.source = AngleSource::kOrbit;
  config.synchronous.angle.least_followed_m = 60e-6;
  ClosedLoop loop(config);
  ASSERT_TRUE(TurnsAt(loop, 3000.0, 4.0));
  EXPECT_EQ(loop.out.synchronous[0].state, BlockState::kOff);
}

/// From rest beyond the window, 800 rpm/s; what the block did, and the largest orbit.
struct WindowPass {
  double orbit_m{};
  double acted_s{};
  synchronous::Ending ending{};
};

WindowPass PassWindow(AngleSource source, double told) {
  cycle::CycleConfig config = WithBlock(Asked(Target::kCurrent, 1900.0, 4200.0));
  config.synchronous.angle.source = source;
  ClosedLoop loop(config);
  if (source == AngleSource::kOrbit) loop.disturb = Told(told);
  EXPECT_TRUE(loop.Levitate());
  loop.Command(OperatorCommand::kSpin, 4800.0, 800.0);
  loop.Reset();
  WindowPass run;
  EXPECT_TRUE(loop.RunUntil(12.0, [&] {
    if (loop.out.synchronous[0].state == BlockState::kActing) run.acted_s += 1e-4;
    return loop.speed_rpm() > 4600.0;
  }));
  EXPECT_EQ(loop.out.fault, Fault::kNone);
  run.orbit_m = loop.most.orbit_m;
  run.ending = loop.out.synchronous[0].ending;
  return run;
}

/// While the speed rises the orbit turns under the block: its phase there is no slip.
TEST(OrbitAngle, ARunUpEndsTheBlockByItsSpeedAsOneWithAMarkDoes) {
  const WindowPass marked = PassWindow(AngleSource::kRig, 1.0);
  ASSERT_EQ(marked.ending, synchronous::Ending::kSpeed);
  for (const double told : {0.97, 1.0, 1.03}) {
    const WindowPass estimated = PassWindow(AngleSource::kOrbit, told);
    EXPECT_EQ(estimated.ending, synchronous::Ending::kSpeed) << told;
    // Its thirty turns take a second of the window's three, which the told speed shifts besides.
    EXPECT_GT(estimated.acted_s, 0.6 * marked.acted_s) << told;
    EXPECT_LT(estimated.orbit_m, 1.1 * marked.orbit_m) << told;
  }
}

}  // namespace
}  // namespace levitas::test
