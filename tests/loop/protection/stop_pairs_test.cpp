// Protections that end in a levitated stop, and the way from there to a release.

#include <gtest/gtest.h>

#include <cmath>

#include "common/rotational_speed.hpp"
#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

// Over-speed does not know a forward direction.
TEST(OverSpeedPair, DriveTurnsBackwardsFasterThanTold) {
  const auto fastest_rpm = [](Fault kept) {
    ClosedLoop loop(Only(kept), RollingTouchdownRig());
    EXPECT_TRUE(loop.Levitate());
    loop.SpinAt(-5800.0);
    loop.overrule = [](plant::PlantCommand& command) { command.speed_set_point_rad_per_s *= 1.3; };
    double fastest = 0.0;
    for (int n = 0; n < 40'000; ++n) {
      (void)loop.Step();
      fastest = std::max(fastest, std::abs(loop.speed_rpm()));
    }
    return std::pair{fastest, loop.out.fault};
  };
  const auto [without_rpm, none] = fastest_rpm(Fault::kNone);
  EXPECT_EQ(none, Fault::kNone);
  EXPECT_GT(without_rpm, 7500.0);  // 5800 x 1.3 = 7540
  const auto [with_rpm, fault] = fastest_rpm(Fault::kOverSpeed);
  EXPECT_EQ(fault, Fault::kOverSpeed);
  EXPECT_LT(with_rpm, 6601.0);  // 6000 x 1.1 and a cycle or two of 0.2 rpm
}

// An operator's stop at speed: the drive brakes, the rotor flies until it stands.
TEST(EmergencyStopPair, OperatorsStopAtFullSpeedTouchesNothing) {
  const auto after = [](bool asked) {
    ClosedLoop loop(Only(Fault::kNone), RollingTouchdownRig());
    EXPECT_TRUE(loop.Levitate());
    loop.SpinAt(6000.0);
    if (asked) loop.Command(OperatorCommand::kEmergencyStop);
    double turning_contact_n = 0.0;
    for (int n = 0; n < 75'000; ++n) {  // 6 s of braking, then the landing
      (void)loop.Step();
      if (std::abs(loop.speed_rpm()) > 5.0) {
        turning_contact_n = std::max(turning_contact_n, loop.plant.ContactForce());
      }
    }
    EXPECT_EQ(turning_contact_n, 0.0);
    return std::pair{loop.speed_rpm(), loop.out};
  };
  const auto [runs_on_rpm, running] = after(false);
  EXPECT_NEAR(runs_on_rpm, 6000.0, 10.0);
  EXPECT_EQ(running.mode, Mode::kSpinning);
  const auto [stopped_rpm, stopped] = after(true);
  EXPECT_LT(std::abs(stopped_rpm), 5.0);
  EXPECT_EQ(stopped.fault, Fault::kEmergencyStop);
  EXPECT_FALSE(stopped.current.amplifiers_enabled);
}

// The amplifiers of the rig say they are off, with no fault bit: the rotor lies in its bearings
// and the controller believes it flies. A drive that nobody brakes turns it there for ever.
TEST(AmplifierFaultPair, SilentAmplifiersAreFoundByTheirAnswerAlone) {
  const auto run = [](bool answer_seen) {
    ClosedLoop loop(Only(Fault::kNone), RollingTouchdownRig());
    EXPECT_TRUE(loop.Levitate());
    loop.SpinAt(3000.0);
    loop.overrule = [](plant::PlantCommand& command) { command.amplifiers_enabled = false; };
    loop.disturb = [answer_seen](cycle::CycleInputs& in) {
      in.frame.rig_status = answer_seen ? kRigAmplifiersOff : 0U;
    };
    loop.Run(4.0);
    return std::pair{loop.most.contact_work_j, loop.out};
  };
  const auto [without_j, blind] = run(false);
  EXPECT_EQ(blind.fault, Fault::kNone);
  EXPECT_TRUE(blind.current.drive_enabled);
  const auto [with_j, found] = run(true);
  EXPECT_EQ(found.fault, Fault::kAmplifierFault);
  EXPECT_FALSE(found.current.amplifiers_enabled);
  EXPECT_LT(with_j, 0.6 * without_j);  // braked: half the turns
}

// A stop in which one amplifier is stuck: the law fights the wall. Given up after 20 ms of contact,
// unless what tells it of the contact is withheld.
TEST(LevitatedStopPair, IsGivenUpWhenTheRotorRunsOnItsBearingsAllTheSame) {
  const auto stop = [](bool shown) {
    ClosedLoop loop(Only(Fault::kNone), RollingTouchdownRig());
    EXPECT_TRUE(loop.Levitate());
    loop.SpinAt(3000.0);
    loop.overrule = [](plant::PlantCommand& command) {
      if (command.amplifiers_enabled) command.control_current_a[2] = -0.3;
    };
    if (!shown) {
      // Just inside the clearance, so that contact is never seen; direction and sign stay.
      loop.disturb = [](cycle::CycleInputs& in) {
        for (std::size_t b = 0; b < 2; ++b) {
          double& x_m = in.frame.position_m[2 * b];
          double& y_m = in.frame.position_m[2 * b + 1];
          const double radius_m = std::hypot(x_m, y_m);
          if (radius_m < 189e-6) continue;
          x_m *= 189e-6 / radius_m;
          y_m *= 189e-6 / radius_m;
        }
      };
    }
    loop.Command(OperatorCommand::kEmergencyStop);
    loop.Run(0.3);
    const auto state = loop.state();
    loop.Run(3.7);
    return std::tuple{loop.most.contact_work_j, state, loop.out};
  };
  const auto [without_j, fighting, last] = stop(false);
  EXPECT_EQ(fighting, supervisor::State::kTrippedStopping);
  const auto [with_j, given_up, end] = stop(true);
  EXPECT_EQ(given_up, supervisor::State::kTrippedReleased);
  EXPECT_EQ(end.fault, Fault::kEmergencyStop);  // the first cause stays
  EXPECT_LT(with_j, 0.7 * without_j);
}

// A rig that restarts at speed: its rotor lies in the bearings and turns. Told, nobody pulls at it
// and the drive brakes; not told, the law throws it off the wall at once.
TEST(RigRestartedPair, TurningRotorIsLeftInItsBearings) {
  const auto restart = [](bool told) {
    ClosedLoop loop(Only(Fault::kNone), RollingTouchdownRig());
    EXPECT_TRUE(loop.Levitate());
    loop.SpinAt(1500.0);
    loop.plant = plant::Plant(RollingTouchdownRig(), 2);
    loop.plant.RestInTouchdown();
    loop.plant.SetSpeed(RpmToRadPerS(1500.0), 0.0);
    loop.disturb = [told](cycle::CycleInputs& in) {
      in.frame.cycle = in.cycle;  // a count of its own would tell it as well
      if (told) in.frame.rig_session = 99;
    };
    (void)loop.Step();
    loop.Reset();
    loop.Run(0.05);
    const bool energised = loop.out.current.amplifiers_enabled;
    const double first_n = loop.most.contact_n;
    loop.Run(2.5);
    return std::tuple{energised, first_n, loop.speed_rpm(), loop.out.fault};
  };
  const auto [pulled, thrown_n, kept_rpm, none] = restart(false);
  EXPECT_TRUE(pulled);
  EXPECT_EQ(none, Fault::kNone);
  EXPECT_NEAR(kept_rpm, 1500.0, 50.0);
  const auto [left_off, lying_n, slow_rpm, fault] = restart(true);
  EXPECT_FALSE(left_off);
  EXPECT_EQ(fault, Fault::kRigRestarted);
  EXPECT_LT(slow_rpm, 5.0);  // 1.5 s at 1000 rpm/s
  EXPECT_LT(lying_n, 36.0);  // some times its share of the weight, and no throw
}

}  // namespace
}  // namespace levitas::test
