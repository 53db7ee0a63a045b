// Each protection with the real harm: the same event without it and with it, the other protections
// set beyond reach. Harm is what reaches the touchdown bearings: force, friction work, a rotor that
// goes on turning in contact.

#include <gtest/gtest.h>

#include <string>

#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

using Inject = void (*)(ClosedLoop&);

struct Outcome {
  Extremes most;
  Fault fault;
  bool stands;
  bool energised;
};

// Levitated at `speed_rpm`, the event happens, `time_s` pass.
Outcome After(Fault kept, double speed_rpm, Inject inject, double time_s) {
  ClosedLoop loop(Only(kept), RollingTouchdownRig());
  if (!loop.Levitate()) ADD_FAILURE() << "no levitation";
  loop.SpinAt(speed_rpm);
  if (loop.out.mode != Mode::kSpinning) ADD_FAILURE() << "not spinning: " << Name(loop.out.fault);
  inject(loop);
  loop.Run(time_s);
  return {loop.most, loop.out.fault, loop.speed_rpm() < 5.0, loop.out.current.amplifiers_enabled};
}

// 3000 rpm with the shipped deceleration of 1000 rpm/s: 3 s, and time to land.
constexpr double kStopS = 4.0;

// Without: the rotor turns on in contact. With: it stands, released, and the friction did less than
// a fifth of the work.
void ExpectRunsOnInContactUnlessTripped(Fault fault, Inject inject) {
  const Outcome without = After(Fault::kNone, 3000.0, inject, kStopS);
  EXPECT_EQ(without.fault, Fault::kNone);
  EXPECT_FALSE(without.stands);
  EXPECT_GT(without.most.contact_n, 100.0);
  const Outcome with = After(fault, 3000.0, inject, kStopS);
  EXPECT_EQ(with.fault, fault);
  EXPECT_TRUE(with.stands);
  EXPECT_FALSE(with.energised);
  EXPECT_LT(with.most.contact_work_j, 0.2 * without.most.contact_work_j);
}

TEST(SensorOutOfRangePair, BrokenCable) {
  ExpectRunsOnInContactUnlessTripped(Fault::kSensorOutOfRange, [](ClosedLoop& loop) {
    loop.disturb = [](cycle::CycleInputs& in) { in.frame.position_m[0] = 400e-6; };
  });
}

TEST(SensorFrozenPair, ConverterRepeatsItself) {
  ExpectRunsOnInContactUnlessTripped(Fault::kSensorFrozen, [](ClosedLoop& loop) {
    const double held_m = loop.plant.SensorOutput()[0];
    loop.disturb = [held_m](cycle::CycleInputs& in) { in.frame.position_m[0] = held_m; };
  });
}

TEST(FrameMissingPair, LineCut) {
  ExpectRunsOnInContactUnlessTripped(Fault::kFrameMissing, [](ClosedLoop& loop) {
    loop.disturb = [](cycle::CycleInputs& in) { in.frame_present = false; };
  });
}

TEST(CoilSaturatedPair, OneAmplifierStuck) {
  ExpectRunsOnInContactUnlessTripped(Fault::kCoilSaturated, [](ClosedLoop& loop) {
    loop.overrule = [](plant::PlantCommand& command) {
      if (command.amplifiers_enabled) command.control_current_a[2] = -0.3;
    };
  });
}

// No limit can be set that hides it, so the event without the protection is one the rig is silent
// about.
TEST(AmplifierFaultPair, AmplifiersSwitchedOffAtSpeed) {
  const Inject silent = [](ClosedLoop& loop) {
    loop.overrule = [](plant::PlantCommand& command) { command.amplifiers_enabled = false; };
    loop.disturb = [](cycle::CycleInputs& in) { in.frame.rig_status = 0; };
  };
  const Inject reported = [](ClosedLoop& loop) {
    loop.overrule = [](plant::PlantCommand& command) { command.amplifiers_enabled = false; };
  };
  const Outcome without = After(Fault::kNone, 3000.0, silent, kStopS);
  EXPECT_FALSE(without.stands);
  EXPECT_GT(without.most.contact_n, 100.0);
  const Outcome with = After(Fault::kNone, 3000.0, reported, kStopS);
  EXPECT_EQ(with.fault, Fault::kAmplifierFault);
  EXPECT_TRUE(with.stands);
  EXPECT_LT(with.most.contact_work_j, 0.6 * without.most.contact_work_j);  // braked: half the turns
}

// A blade lost: six times the unbalance, run up through the first bending mode.
TEST(OrbitExceededPair, SixTimesTheUnbalance) {
  const auto run_up = [](Fault kept) {
    plant::PlantConfig rig = RollingTouchdownRig();
    for (auto& mass : rig.unbalance) mass.moment_kg_m *= 6.0;
    ClosedLoop loop(Only(kept), rig);
    EXPECT_TRUE(loop.Levitate());
    loop.Reset();
    loop.Command(OperatorCommand::kSpin, 6000.0, 1500.0);
    double turning_contact_n = 0.0;
    for (int n = 0; n < 50'000; ++n) {
      (void)loop.Step();
      if (loop.speed_rpm() > 5.0) {
        turning_contact_n = std::max(turning_contact_n, loop.plant.ContactForce());
      }
    }
    return std::pair{turning_contact_n, loop.out.fault};
  };
  const auto [without_n, no_fault] = run_up(Fault::kNone);
  EXPECT_EQ(no_fault, Fault::kNone);
  EXPECT_GT(without_n, 200.0);
  const auto [with_n, fault] = run_up(Fault::kOrbitExceeded);
  EXPECT_EQ(fault, Fault::kOrbitExceeded);
  EXPECT_EQ(with_n, 0.0);  // never touches while it turns
}

// Every second period is skipped: the sampling rate halves, the phase lead is gone.
TEST(DeadlineMissedPair, EverySecondPeriodSkipped) {
  const auto run = [](Fault kept) {
    ClosedLoop loop(Only(kept), RollingTouchdownRig());
    EXPECT_TRUE(loop.Levitate());
    loop.SpinAt(6000.0);
    loop.disturb = [](cycle::CycleInputs& in) { in.missed_deadlines = 1; };
    for (int n = 0; n < 40'000; ++n) {
      (void)loop.Step();
      loop.SkipPeriod();
    }
    return std::pair{loop.most.contact_work_j, loop.out};
  };
  const auto [without_j, running] = run(Fault::kNone);
  EXPECT_EQ(running.mode, Mode::kSpinning);
  EXPECT_GT(without_j, 1.0);
  const auto [with_j, tripped] = run(Fault::kDeadlineMissed);
  EXPECT_EQ(tripped.fault, Fault::kDeadlineMissed);
  EXPECT_FALSE(tripped.current.drive_enabled);  // it stands
  EXPECT_LT(with_j, 0.75 * without_j);
}

TEST(OverSpeedPair, DriveTurnsFasterThanTold) {
  const auto fastest_rpm = [](Fault kept, Fault expected) {
    ClosedLoop loop(Only(kept), RollingTouchdownRig());
    EXPECT_TRUE(loop.Levitate());
    loop.SpinAt(5800.0);
    loop.overrule = [](plant::PlantCommand& command) { command.speed_set_point_rad_per_s *= 1.3; };
    double fastest = 0.0;
    for (int n = 0; n < 40'000; ++n) {
      (void)loop.Step();
      fastest = std::max(fastest, loop.speed_rpm());
    }
    EXPECT_EQ(loop.out.fault, expected);
    return fastest;
  };
  EXPECT_GT(fastest_rpm(Fault::kNone, Fault::kNone), 7500.0);  // 5800 x 1.3 = 7540
  // 6000 x 1.1, and the drive needs a cycle or two to turn round (0.2 rpm each).
  EXPECT_LT(fastest_rpm(Fault::kOverSpeed, Fault::kOverSpeed), 6601.0);
}

TEST(EmergencyStopPair, OnlyTheRaisedBitStopsTheRotor) {
  const Inject nothing = [](ClosedLoop&) {};
  const Inject chain_opens = [](ClosedLoop& loop) {
    loop.disturb = [](cycle::CycleInputs& in) { in.frame.rig_status |= kRigEmergencyStop; };
  };
  EXPECT_FALSE(After(Fault::kNone, 3000.0, nothing, kStopS).stands);
  const Outcome with = After(Fault::kNone, 3000.0, chain_opens, kStopS);
  EXPECT_EQ(with.fault, Fault::kEmergencyStop);
  EXPECT_TRUE(with.stands);
  EXPECT_FALSE(with.energised);
  EXPECT_LT(with.most.contact_n, 36.0);  // lowered at standstill, see LiftsFromTheTouchdown...
}

// A restarted rig lies in its touchdown bearings; a controller that goes on pulls it up at once.
TEST(RigRestartedPair, RotorIsBackInItsTouchdownBearings) {
  const auto restart = [](bool told) {
    ClosedLoop loop(Only(Fault::kNone), RollingTouchdownRig());
    EXPECT_TRUE(loop.Levitate());
    loop.Run(0.5);
    loop.plant = plant::Plant(RollingTouchdownRig(), 2);
    loop.plant.RestInTouchdown();
    loop.disturb = [told](cycle::CycleInputs& in) {
      in.frame.cycle = in.cycle;  // a count of its own would tell it as well
      if (told) in.frame.rig_session = 99;
    };
    (void)loop.Step();
    loop.Reset();
    loop.Run(0.1);
    return loop;
  };
  // Not told: it is levitated again without lift, self-test or anybody's consent.
  const ClosedLoop without = restart(false);
  EXPECT_EQ(without.out.mode, Mode::kLevitating);
  EXPECT_LT(std::abs(without.plant.ActuatorPosition()[0]), 100e-6);
  ClosedLoop with = restart(true);
  EXPECT_EQ(with.out.fault, Fault::kRigRestarted);
  EXPECT_FALSE(with.out.current.amplifiers_enabled);
  EXPECT_NEAR(with.plant.ActuatorPosition()[0], -134e-6, 2e-6);  // untouched
  with.Run(0.2);                                                 // proof that the rotor stands
  with.Command(OperatorCommand::kReset);
  EXPECT_EQ(with.out.mode, Mode::kOff);
  EXPECT_TRUE(with.Levitate()) << Name(with.out.fault);
}

}  // namespace
}  // namespace levitas::test
