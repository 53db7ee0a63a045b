// Misaligned couplings of geared shafts: the lines that they add, against closed forms, in pairs
// with the rig that has none. Amplifiers are off: the shafts stand on their own springs.

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "plant_sim/plant/modal_sum.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/loop/gears/gear_motion.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::test {
namespace {

using effect::Id;

constexpr double kCouplingTurn = 2.0 * std::numbers::pi;
constexpr double kCouplingPinion_hz = 20.0;  // the gear: 10 Hz, backwards
constexpr double kCouplingPeriod_s = 1e-4;
constexpr int kWholeTurns = 1000;     // of both shafts
constexpr int kUntilSteady = 12'000;  // slowest decay 15 1/s
constexpr double kAngle_rad = 0.06;   // of a universal joint: 3.4 degrees
const double kUneven_rad = std::pow(std::tan(0.5 * kAngle_rad), 2);

/// Without what turns by itself: only the coupling moves the shafts.
plant::PlantConfig Even() {
  plant::PlantConfig rig = GearedRotor4();
  rig.gears[0].transmission_error.clear();
  rig.gears[0].driving.runout_m = rig.gears[0].driven.runout_m = 0.0;
  return rig;
}

effect::EffectConfig Coupling(double order, double force_n, double phase_rad, double rotation_rad,
                              bool driven = false) {
  effect::EffectConfig entry =
      Entry(Id::kMisalignment, {0.0, order, force_n, phase_rad, rotation_rad});
  entry.on_driven = driven;
  return entry;
}

std::vector<Whirl> Steady(plant::PlantConfig rig, std::vector<effect::EffectConfig> entries,
                          double speed_hz = kCouplingPinion_hz) {
  rig.effects = std::move(entries);
  plant::Plant plant(rig, 1);
  const double speed = kCouplingTurn * speed_hz;
  plant.SetSpeed(speed, 0.0);
  std::vector<Whirl> record;
  for (int n = 0; n < kUntilSteady + kWholeTurns; ++n) {
    if (n >= kUntilSteady) record.push_back(At(plant));
    plant.Advance(Passive(speed));
  }
  return record;
}

/// Both shafts under forces on them and a displacement of the teeth, all e^(j w t), w signed:
/// Z r = F -+ f,  f = (k + j w c)(r_p - r_g + a).
Whirl ClosedForm(double frequency_hz, Complex on_pinion_n, Complex on_gear_n, Complex teeth_m) {
  const double w = kCouplingTurn * frequency_hz;
  const auto& rig = Even();
  const auto z = [&](std::size_t s) {
    const rotor::LumpedShaft& shaft = rig.shafts[s].lumped;
    return Complex(shaft.kll_n_per_m - w * w * shaft.mass_kg, w * shaft.damping_n_s_per_m);
  };
  const Complex mesh(rig.gears[0].stiffness_n_per_m, w * rig.gears[0].damping_n_s_per_m);
  const Complex free = on_pinion_n / z(0) - on_gear_n / z(1) + teeth_m;
  const Complex f = mesh * free / (1.0 + mesh / z(0) + mesh / z(1));
  return {(on_pinion_n - f) / z(0), (on_gear_n + f) / z(1)};
}

void ExpectLine(const std::vector<Whirl>& record, double frequency_hz, const Whirl& expected) {
  const Whirl line = Line(record, kCouplingPeriod_s, frequency_hz);
  // The step of 25 us leaves parts in a thousand at the frequencies here.
  EXPECT_LT(std::abs(line.pinion - expected.pinion), 2e-3 * std::abs(expected.pinion))
      << frequency_hz << " Hz, " << line.pinion << " " << expected.pinion;
  EXPECT_LT(std::abs(line.gear - expected.gear), 2e-3 * std::abs(expected.gear))
      << frequency_hz << " Hz";
}

double LargestLine(const std::vector<Whirl>& record) {
  double largest = 0.0;
  for (int k = -5; k <= 5; ++k) {
    const Whirl line = Line(record, kCouplingPeriod_s, 10.0 * k);
    largest = std::max({largest, std::abs(line.pinion), std::abs(line.gear)});
  }
  return largest;
}

// tan(out) = tan(in)/cos(a) is out = in + t sin(2 in) + ..., t = tan^2(a/2): the joint turns the
// pinion on and back twice a turn, and the teeth with it by base radius times t.
TEST(Coupling, AtAnAngleTurnsThePinionUnevenlyTwiceATurn) {
  const double phase = -0.5 * std::numbers::pi;
  const auto record = Steady(Even(), {Coupling(2, 0.0, phase, kUneven_rad)});
  const gear::GearPair pair = Even().gears[0];
  const Complex n(std::sin(pair.pressure_angle_rad), std::cos(pair.pressure_angle_rad));
  const Complex half = 0.5 * pair.driving.base_radius_m * kUneven_rad * n;
  ExpectLine(record, 40.0, ClosedForm(40.0, 0.0, 0.0, half * std::polar(1.0, phase)));
  ExpectLine(record, -40.0, ClosedForm(-40.0, 0.0, 0.0, half * std::polar(1.0, -phase)));
  EXPECT_LT(LargestLine(Steady(Even(), {})), 1e-15);
}

TEST(Coupling, OfTheDrivenShaftTurnsItsWheelOnceATurnOfIts) {
  const auto record = Steady(Even(), {Coupling(1, 0.0, 0.4, 3e-4, true)});
  const gear::GearPair pair = Even().gears[0];
  const Complex n(std::sin(pair.pressure_angle_rad), std::cos(pair.pressure_angle_rad));
  const Complex half = 0.5 * pair.driven.base_radius_m * 3e-4 * n;
  // The wheel turns backwards and carries the phase with it.
  ExpectLine(record, -10.0, ClosedForm(-10.0, 0.0, 0.0, half * std::polar(1.0, 0.4)));
  ExpectLine(record, 10.0, ClosedForm(10.0, 0.0, 0.0, half * std::polar(1.0, -0.4)));
  EXPECT_LT(std::abs(Line(record, kCouplingPeriod_s, 20.0).gear), 1e-12);
}

TEST(Coupling, PushesItsOwnShaftAtMultiplesOfItsTurns) {
  const auto pinion = Steady(Even(), {Coupling(2, 3.0, 0.7, 0.0)});
  ExpectLine(pinion, 40.0, ClosedForm(40.0, std::polar(3.0, 0.7), 0.0, 0.0));
  EXPECT_LT(std::abs(Line(pinion, kCouplingPeriod_s, -40.0).pinion), 1e-12);
  // Against the sense of the gear, which turns backwards: forward.
  const auto gear = Steady(Even(), {Coupling(-2, 3.0, 0.7, 0.0, true)});
  ExpectLine(gear, 20.0, ClosedForm(20.0, 0.0, std::polar(3.0, 0.7), 0.0));
}

TEST(Coupling, OfAStandingRigMovesNothing) {
  const auto record = Steady(Even(), {Coupling(2, 3.0, 0.7, kUneven_rad)}, 0.0);
  for (const Whirl& at : record) {
    EXPECT_LT(std::abs(at.pinion - record.front().pinion), 1e-10);
    EXPECT_LT(std::abs(at.gear - record.front().gear), 1e-10);
  }
}

TEST(Coupling, OfNoStrengthLeavesEveryBit) {
  const plant::PlantConfig nominal = GearedRotor12();
  plant::PlantConfig rig = nominal;
  rig.effects = {Coupling(2, 3.0, 0.7, kUneven_rad), Coupling(1, 3.0, 0.7, kUneven_rad, true)};
  int different_at_full_strength = 0;
  for (const double strength : {0.0, 1.0}) {
    for (auto& entry : rig.effects) {
      entry.strength = strength;
      entry.values[0] = 0.2;
    }
    plant::Plant without(nominal, 1);
    plant::Plant with(rig, 1);
    int different = 0;
    for (int n = 0; n < 300; ++n) {
      without.Advance(Passive(100.0));
      with.Advance(Passive(100.0));
      different += without.ActuatorPosition() != with.ActuatorPosition();
    }
    if (strength == 0.0) {
      EXPECT_EQ(different, 0);
    } else {
      different_at_full_strength = different;
    }
  }
  EXPECT_GT(different_at_full_strength, 250);
}

// Two inertias on a spring that is twisted by e(t), nothing else: th_p - th_m = e/(1 - (w/w0)^2),
// and the inertias share it inversely.
TEST(Coupling, WithTorsionTwistsTheSpringBesideItsWheel) {
  plant::PlantConfig rig = GearedRotor12();
  rig.gears[0].transmission_error.clear();
  rig.gears[0].driving.runout_m = rig.gears[0].driven.runout_m = 0.0;
  rig.gears[0].stiffness_n_per_m = 1e-3;  // the teeth let go
  rig.gears[0].damping_n_s_per_m = rig.gears[0].driving_torque_n_m = 0.0;
  rig.shafts[0].torsion.inertias[0].ground_stiffness_n_m_per_rad = 0.0;
  rig.shafts[0].torsion.inertias[0].ground_damping_n_m_s_per_rad = 0.0;
  rig.effects = {Coupling(2, 0.0, 0.0, kUneven_rad)};
  plant::Plant plant(rig, 1);
  const double speed = kCouplingTurn * kCouplingPinion_hz;
  plant.SetSpeed(speed, 0.0);
  const auto& train = plant.model().train();
  Complex motor;
  Complex pinion;
  for (int n = 0; n < kUntilSteady + kWholeTurns; ++n) {
    const double* twist = plant.state().data() + plant.model().layout().q_t;
    const Complex turned =
        std::polar(2.0 / kWholeTurns, -2.0 * speed * kCouplingPeriod_s * (n - kUntilSteady));
    if (n >= kUntilSteady) {
      motor += turned * plant::ModalSum(train.inertias[0].twist, twist);
      pinion += turned * plant::ModalSum(train.inertias[1].twist, twist);
    }
    plant.Advance(Passive(speed));
  }
  const double j_motor = rig.shafts[0].torsion.inertias[0].inertia_kg_m2;
  const double j_pinion = rig.shafts[0].torsion.inertias[1].inertia_kg_m2;
  const double k = rig.shafts[0].torsion.inertias[0].stiffness_n_m_per_rad;
  const double w2 = std::pow(2.0 * speed, 2) / (k * (1.0 / j_motor + 1.0 / j_pinion));
  const double apart = kUneven_rad / (1.0 - w2);
  // Damped by 1 % of critical, which shifts the phase by 0.6 degrees.
  EXPECT_NEAR(std::abs(pinion), apart * j_motor / (j_motor + j_pinion), 1e-3 * apart);
  EXPECT_NEAR(std::abs(motor), apart * j_pinion / (j_motor + j_pinion), 1e-3 * apart);
  EXPECT_LT(std::real(pinion / motor), 0.0);
}

}  // namespace
}  // namespace levitas::test
