// The shipped geared rotor in the sampled loop: what PD control does for it, and what it does not.

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "tests/loop/gears/gear_motion.hpp"
#include "tests/loop/levitation/closed_loop.hpp"
#include "tests/support/paths.hpp"

namespace levitas::test {
namespace {

const configuration::RigFile& Rig(const std::string& name) {
  static std::map<std::string, configuration::RigFile> loaded;
  const auto found = loaded.find(name);
  if (found != loaded.end()) return found->second;
  return loaded[name] =
             configuration::LoadRig(test::SourceFolder() + "/config/rigs/" + name + ".yaml");
}

cycle::CycleConfig Cycle(const std::string& rig = "geared_rotor_4dof") {
  const configuration::ControllerFile controller = configuration::LoadController(
      test::SourceFolder() + "/config/controllers/geared_rotor.yaml", Rig(rig).numbers);
  return {Rig(rig).numbers, controller.law, controller.supervisor};
}

// Root mean square of both shafts about their mean, and of the part at mesh harmonics of 300 Hz up.
struct Vibration {
  double pinion_m{}, gear_m{}, both_m{};
  double high_m{};
};

Vibration Measure(const std::vector<Whirl>& record, double speed_hz) {
  Vibration v;
  const Whirl mean = Line(record, 1e-4, 0.0);
  for (const Whirl& r : record) {
    v.pinion_m += std::norm(r.pinion - mean.pinion);
    v.gear_m += std::norm(r.gear - mean.gear);
  }
  const auto count = static_cast<double>(record.size());
  v.both_m = std::sqrt((v.pinion_m + v.gear_m) / count);
  v.pinion_m = std::sqrt(v.pinion_m / count);
  v.gear_m = std::sqrt(v.gear_m / count);
  for (int order = -5; order <= 5; ++order) {
    if (order == 0) continue;
    const Whirl line = Line(record, 1e-4, 20.0 * order * speed_hz);
    v.high_m += std::norm(line.pinion) + std::norm(line.gear);
  }
  v.high_m = std::sqrt(v.high_m);
  return v;
}

// Two seconds hold whole turns of both wheels at every speed used here.
constexpr int kRecord = 20'000;

Vibration WithoutControl(double speed_hz) {
  plant::Plant plant(Rig("geared_rotor_4dof").plant, 1);
  const double speed = 2.0 * std::numbers::pi * speed_hz;
  plant.SetSpeed(speed, 0.0);
  std::vector<Whirl> record;
  // Undisturbed shafts forget their start as exp(-15 t).
  for (int n = 0; n < 10'000 + kRecord; ++n) {
    if (n >= 10'000) record.push_back(At(plant));
    plant.Advance(Passive(speed));
  }
  return Measure(record, speed_hz);
}

Vibration WithControl(double speed_hz) {
  ClosedLoop loop(Cycle(), Rig("geared_rotor_4dof").plant);
  EXPECT_TRUE(loop.Levitate());
  loop.SpinAt(60.0 * speed_hz);
  std::vector<Whirl> record;
  for (int n = 0; n < kRecord; ++n) {
    (void)loop.Step();
    record.push_back(At(loop.plant));
  }
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_EQ(loop.out.mode, Mode::kSpinning);
  return Measure(record, speed_hz);
}

TEST(GearedRotorUnderControl, VibratesFortyToFiftyPercentLessAtFifteenToTwentyNineHertz) {
  // What the source reports. Single shafts lie between 40 and 52 % (continuous model: 41 to 51).
  for (const double speed_hz : {15.0, 20.0, 25.0, 29.0}) {
    const Vibration off = WithoutControl(speed_hz);
    const Vibration on = WithControl(speed_hz);
    const double cut = 1.0 - on.both_m / off.both_m;
    EXPECT_GT(cut, 0.40) << speed_hz;
    EXPECT_LT(cut, 0.50) << speed_hz;
    for (const double single : {1.0 - on.pinion_m / off.pinion_m, 1.0 - on.gear_m / off.gear_m}) {
      EXPECT_GT(single, 0.40) << speed_hz;
      EXPECT_LT(single, 0.52) << speed_hz;
    }
    RecordProperty("cut_at_" + std::to_string(static_cast<int>(speed_hz)) + "_hz",
                   std::to_string(cut));
    // The honest limit: harmonics of the mesh (300 Hz and above) are not improved. The loop's delay
    // of 0.26 ms turns damping into stiffness there: of the pinion's -5.9e6 N/m at 300 Hz (inertia
    // against shaft and mesh) some -3e6 remain, so that they grow, to at most twice.
    EXPECT_GT(on.high_m, 0.98 * off.high_m) << speed_hz;
    EXPECT_LT(on.high_m, 2.0 * off.high_m) << speed_hz;
  }
}

// Largest normal force at the stator within two seconds at a speed, without the protections.
double Contact(double speed_hz, double kp_ratio, double kd_ratio, double runout_ratio) {
  plant::PlantConfig rig = Rig("geared_rotor_4dof").plant;
  rig.gears[0].driving.runout_m *= runout_ratio;
  const law::LawConfig law = Cycle().law;
  plant::Plant plant(rig, 1);
  const double speed = 2.0 * std::numbers::pi * speed_hz;
  plant.SetSpeed(speed, 0.0);
  const double kp = kp_ratio * law.axes[0].kp_a_per_m;
  const double kd = kd_ratio * law.axes[0].kd_a_s_per_m;
  AxisArray last_m{};
  AxisArray slope{};
  const double pole = std::exp(-2.0 * std::numbers::pi * law.axes[0].derivative_hz * 1e-4);
  double contact_n = 0.0;
  for (int n = 0; n < 20'000; ++n) {
    const AxisArray read_m = plant.Sample().position_m;
    plant::PlantCommand command;
    command.bias_current_a = 1.0;
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = speed;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      slope[axis] = pole * slope[axis] + (1.0 - pole) * (read_m[axis] - last_m[axis]) / 1e-4;
      last_m[axis] = read_m[axis];
      command.control_current_a[axis] = -(kp * read_m[axis] + kd * slope[axis]);
    }
    plant.Advance(command);
    contact_n = std::max(contact_n, plant.ContactForce());
    if (contact_n > 0.0) break;
  }
  return contact_n;
}

TEST(GearedRotorAndItsStator, TouchWhenTheDampingGainIsTakenAwayFromTheStiffnessGain) {
  // The loop's delay of some 0.26 ms turns a stiffness of 1.9e6 N/m into -500 N s/m of damping,
  // against 60 to 80 of the shafts: without the derivative gain the vibration grows to the stator.
  EXPECT_EQ(Contact(25.0, 1.0, 1.0, 1.0), 0.0);
  EXPECT_GT(Contact(25.0, 1.0, 0.0, 1.0), 0.0);
}

TEST(GearedRotorAndItsStator, TouchBeyondTheCriticalSpeedOfAnUncontrolledEccentricPinion) {
  // With bias alone the negative stiffness moves the first critical speed to about 33 Hz of the
  // pinion; eight times the run-out then reaches the stator, which is still free at 25 Hz. PD
  // control holds both.
  EXPECT_EQ(Contact(25.0, 0.0, 0.0, 8.0), 0.0);
  EXPECT_GT(Contact(32.0, 0.0, 0.0, 9.0), 0.0);
  EXPECT_EQ(Contact(25.0, 1.0, 1.0, 8.0), 0.0);
  EXPECT_EQ(Contact(32.0, 1.0, 1.0, 9.0), 0.0);
}

TEST(GearedRotorAndItsSupervisor, TripOnTheOrbitBeforeTheStatorIsTouched) {
  cycle::CycleConfig cycle = Cycle();
  ClosedLoop loop(cycle, Rig("geared_rotor_4dof").plant);
  ASSERT_TRUE(loop.Levitate());
  loop.SpinAt(1500.0);
  // The derivative is lost: from here on the amplifiers get the stiffness part alone.
  loop.overrule = [&](plant::PlantCommand& command) {
    if (!command.amplifiers_enabled) return;
    const AxisArray read_m = loop.plant.SensorOutput();
    for (std::size_t axis = 0; axis < 4; ++axis) {
      command.control_current_a[axis] = -2.4e4 * read_m[axis];
    }
  };
  ASSERT_TRUE(loop.RunUntil(5.0, [&] { return loop.out.mode == Mode::kTripped; }));
  EXPECT_LT(loop.most.shaft_m, 400e-6);
  EXPECT_EQ(loop.most.contact_n, 0.0);
}

TEST(GearedRotorUnderControl, RunsItsWholeScenarioInEveryModelSize) {
  for (const char* name : {"geared_rotor_4dof", "geared_rotor_8dof", "geared_rotor_12dof"}) {
    ClosedLoop loop(Cycle(name), Rig(name).plant);
    ASSERT_TRUE(loop.Levitate()) << name;
    loop.SpinAt(1740.0);
    loop.Run(0.5);
    EXPECT_EQ(loop.out.mode, Mode::kSpinning) << name;
    EXPECT_LT(loop.most.orbit_m, 30e-6) << name;  // the objective of the rig file
    loop.Command(OperatorCommand::kSpin, 0.0, 800.0);
    ASSERT_TRUE(loop.RunUntil(5.0, [&] { return loop.out.mode == Mode::kLevitating; })) << name;
    loop.Command(OperatorCommand::kLand);
    EXPECT_TRUE(loop.RunUntil(2.0, [&] { return loop.out.mode == Mode::kOff; })) << name;
  }
}

}  // namespace
}  // namespace levitas::test
