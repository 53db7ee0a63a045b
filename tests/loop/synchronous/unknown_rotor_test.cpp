// T of the bearings alone on rotors that nobody knows: stable where the law damps, beside T = 1 and
// the inverse of the rotor of the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/synchronous_loop.hpp"
#include "common/problem.hpp"
#include "common/random.hpp"
#include "design/drawn_rigs/rig_uncertainty.hpp"
#include "design/notch/bearing_phase.hpp"
#include "tests/loop/synchronous/notch_loop.hpp"
#include "tests/support/modes_within.hpp"

namespace levitas::test {
namespace {

using design::Knowledge;
using synchronous::BlockState;
using synchronous::Target;

design::NotchRequest Request(Knowledge knowledge, Target target, double from_rpm, double to_rpm) {
  auto request = Asked(target, from_rpm, to_rpm);
  request.knowledge = knowledge;
  return request;
}

synchronous::SynchronousConfig Made(Knowledge knowledge, Target target, double from_rpm,
                                    double to_rpm) {
  return WithBlock(Request(knowledge, target, from_rpm, to_rpm)).synchronous;
}

class OfUnknownRotors : public testing::TestWithParam<Target> {};

// Modes +-30 %, gains +-10 %, damping +-50 %; sensors where the file has them, beside the magnets.
// Blocks are slow, and so are counted the loops that decay twice as fast without them.
TEST_P(OfUnknownRotors, EveryOneThatItsLawHoldsIsStableFrom1000To6500Rpm) {
  const auto law = CommissionedCycle().law;
  constexpr double kSlowS = 1.0;
  auto bearings = Made(Knowledge::kBearings, GetParam(), 1000.0, 6500.0);
  auto rotor = Made(Knowledge::kRotor, GetParam(), 1000.0, 6500.0);
  synchronous::SynchronousConfig plain;
  plain.blocks.push_back(PlainNotch(1000.0, 6500.0));
  for (auto* each : {&bearings, &rotor, &plain}) each->blocks.front().time_constant_s = kSlowS;
  const auto parameters =
      ModesWithin(0.3, uncertainty::Stated(ShippedRig(), {.current_gain = 0.1, .stiffness = 0.1}));
  Random draw(41);
  int held = 0, harmed_by_rotor = 0, harmed_by_plain = 0;
  for (int n = 0; n < 25; ++n) {
    const auto rig =
        uncertainty::At(ShippedRig(), parameters, uncertainty::DrawPlace(draw, parameters.size()));
    bool by_rotor = false, by_plain = false, alone = true;
    for (double rpm = 1000.0; rpm <= 6500.0 && alone; rpm += 550.0) {
      const double speed = RpmToRadPerS(rpm);
      const auto loop = analysis::CloseLoop(rig.plant, law, speed);
      alone = analysis::LargestPoleModulus(loop) < std::exp(-2.0 * loop.period_s / kSlowS);
      if (!alone) break;
      const auto judged = analysis::JudgeSynchronous(loop, bearings, speed);
      EXPECT_TRUE(judged.stable())
          << "rotor " << n << " at " << rpm << " rpm: decay " << judged.blocks.front().slowest_decay
          << ", |z| " << judged.largest_pole_modulus;
      by_rotor |= !analysis::JudgeSynchronous(loop, rotor, speed).stable();
      by_plain |= !analysis::JudgeSynchronous(loop, plain, speed).stable();
    }
    if (!alone) continue;
    ++held;
    harmed_by_rotor += by_rotor ? 1 : 0;
    harmed_by_plain += by_plain ? 1 : 0;
  }
  EXPECT_GE(held, 5);
  EXPECT_GT(harmed_by_rotor, held / 4);
  EXPECT_EQ(harmed_by_plain, held);
  RecordProperty("held", std::to_string(held));
  RecordProperty("harmed_by_the_files_rotor", std::to_string(harmed_by_rotor));
}

INSTANTIATE_TEST_SUITE_P(OfBothTargets, OfUnknownRotors,
                         testing::Values(Target::kCurrent, Target::kVibration));

TEST(UnknownRotor, WhereTheLawDoesNotDampItIsUnstable) {
  // Below about 600 rpm the integrator outweighs the derivative: the law's force lags.
  const auto control = Made(Knowledge::kBearings, Target::kCurrent, 300.0, 1500.0);
  const auto decay = [&](double rpm) {
    const double speed = RpmToRadPerS(rpm);
    const auto loop = analysis::CloseLoop(ShippedRig().plant, CommissionedCycle().law, speed);
    return analysis::JudgeSynchronous(loop, control, speed).blocks.front().slowest_decay;
  };
  EXPECT_LT(decay(400.0), 0.0);
  EXPECT_GT(decay(800.0), 0.0);
}

/// Slowest decay of both targets, and whether each axis of the law damps: Re T > 0 of N7.
struct Decay {
  bool damps{true};
  double slowest{1.0};
};

Decay DecayOf(const plant::PlantConfig& rig, const law::LawConfig& law, double speed_rad_per_s) {
  const auto loop = analysis::CloseLoop(rig, law, speed_rad_per_s);
  const analysis::LoopResponse response(loop);
  Decay found;
  for (const Target target : {Target::kCurrent, Target::kVibration}) {
    synchronous::BlockConfig block;
    block.target = target;
    const auto inverse = design::PhaseAlignedT(rig, loop, block, speed_rad_per_s);
    if (target == Target::kCurrent) found.damps = inverse.diagonal().real().minCoeff() > 0.0;
    const auto answer = analysis::SynchronousAnswer(response, speed_rad_per_s, 1.0, target);
    const auto values = analysis::EigenvaluesWithConjugates(inverse * answer);
    found.slowest = std::min(found.slowest, values.real().minCoeff());
  }
  return found;
}

TEST(UnknownRotor, WithSensorsAtTheMagnetsItDecaysWhereverTheLawDamps) {
  const std::string configs = SourceFolder() + "/config/";
  for (const std::string name : {"flexible_rotor", "turbomolecular_pump"}) {
    configuration::RigFile rig = configuration::LoadRig(configs + "rigs/" + name + ".yaml");
    for (auto& bearing : rig.plant.bearings) bearing.sensor_z_m = bearing.actuator_z_m;
    const auto law =
        configuration::LoadController(configs + "controllers/" + name + ".yaml", rig.numbers).law;
    int damped = 0;
    for (double share = 0.02; share <= 1.1; share += 0.02) {
      const double speed = share * rig.numbers.max_speed_rad_per_s;
      const Decay found = DecayOf(rig.plant, law, speed);
      if (!found.damps) continue;
      ++damped;
      EXPECT_GT(found.slowest, 0.0) << name << " at " << RadPerSToRpm(speed) << " rpm";
    }
    EXPECT_GT(damped, 10) << name;
    RecordProperty(name, std::to_string(damped));
  }
}

TEST(UnknownRotor, SensorsInboardOfTheirMagnetsBreakItWhereTheShaftBends) {
  const auto control = Made(Knowledge::kBearings, Target::kCurrent, 700.0, 6500.0);
  const auto slowest = [&](double inboard_m) {
    plant::PlantConfig rig = ShippedRig().plant;
    rig.bearings[0].sensor_z_m = rig.bearings[0].actuator_z_m + inboard_m;
    rig.bearings[1].sensor_z_m = rig.bearings[1].actuator_z_m - inboard_m;
    double least = 1.0;
    for (double rpm = 4800.0; rpm <= 5600.0; rpm += 100.0) {
      const double speed = RpmToRadPerS(rpm);
      const auto loop = analysis::CloseLoop(rig, CommissionedCycle().law, speed);
      const auto judged = analysis::JudgeSynchronous(loop, control, speed);
      least = std::min(least, judged.blocks.front().slowest_decay);
    }
    return least;
  };
  EXPECT_LT(slowest(0.04), 0.0);
  EXPECT_GT(slowest(0.0), 0.0);
  EXPECT_GT(slowest(-0.04), 0.0);
}

TEST(UnknownRotor, CoilsOnAVoltageAreRefused) {
  configuration::RigFile rig = ShippedRig();
  rig.plant.bearings[1].amplifier.voltage = plant::VoltageDrive{};
  const auto law = CommissionedCycle().law;
  const auto loop = analysis::CloseLoop(ShippedRig().plant, law, 300.0);
  try {
    (void)design::PhaseAlignedT(rig.plant, loop, Asked(Target::kCurrent, 1500.0, 3900.0).block,
                                300.0);
    FAIL() << "accepted";
  } catch (const BadInput& refused) {
    EXPECT_NE(std::string(refused.what()).find("bearing nde: its coils are on a voltage"),
              std::string::npos)
        << refused.what();
  }
}

TEST(UnknownRotor, ALawThatGivesAnAxisNothingIsRefused) {
  auto loop = analysis::CloseLoop(ShippedRig().plant, CommissionedCycle().law, 300.0);
  loop.law[2] = analysis::ModelOf({law::Section{.b0 = 0.0}});
  EXPECT_THROW((void)design::PhaseAlignedT(ShippedRig().plant, loop,
                                           Asked(Target::kCurrent, 1500.0, 3900.0).block, 300.0),
               BadInput);
}

TEST(UnknownRotor, NoRotorDataIsInIt) {
  const auto law = CommissionedCycle().law;
  auto request = Request(Knowledge::kBearings, Target::kVibration, 1500.0, 3900.0);
  configuration::RigFile other = ShippedRig();
  for (auto& disc : other.plant.rotor.discs) disc.mass_kg *= 1.2;
  const auto of_file = design::WithInverse(ShippedRig(), law, request);
  const auto of_other = design::WithInverse(other, law, request);
  ASSERT_EQ(of_file.inverse.size(), of_other.inverse.size());
  for (std::size_t i = 0; i < of_file.inverse.size(); ++i) {
    EXPECT_EQ(of_file.inverse[i].inverse.real, of_other.inverse[i].inverse.real);
    EXPECT_EQ(of_file.inverse[i].inverse.imaginary, of_other.inverse[i].inverse.imaginary);
  }
}

class UnknownRejection : public testing::TestWithParam<double> {};

TEST_P(UnknownRejection, TakesTheSynchronousCurrentAway) {
  const double rpm = GetParam();
  ClosedLoop plain(CommissionedCycle());
  ASSERT_TRUE(TurnsAt(plain, rpm, 3.0));
  const Turning before = Measure(plain, 100);
  ClosedLoop quiet(WithBlock(Request(Knowledge::kBearings, Target::kCurrent, 1500.0, 4000.0)));
  ASSERT_TRUE(TurnsAt(quiet, rpm, 10.0));
  EXPECT_EQ(quiet.out.synchronous[0].state, BlockState::kActing);
  const Turning after = Measure(quiet, 100);
  const double decibel = Decibel(after.current_a, before.current_a);
  EXPECT_LT(decibel, -40.0) << before.current_a << " A to " << after.current_a << " A";
  RecordProperty("current_db", std::to_string(decibel));
}

INSTANTIATE_TEST_SUITE_P(BelowTheFirstBending, UnknownRejection, testing::Values(1600.0, 3000.0));

/// The file's rig, but its first bending mode is 35 % lower: 58 instead of 90 Hz.
configuration::RigFile SofterRig() {
  auto parameters = uncertainty::Stated(ShippedRig(), {});
  std::vector<double> place(parameters.size(), 0.0);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    auto& one = parameters[i];
    if (one.kind != uncertainty::Kind::kModeFrequency || one.index != 0) continue;
    one.low = 0.65 * one.nominal;
    one.high = 1.35 * one.nominal;
    place[i] = -1.0;
  }
  return uncertainty::At(ShippedRig(), parameters, place);
}

cycle::CycleConfig Careless(Knowledge knowledge, double rpm) {
  return Unwatched(WithBlock(Request(knowledge, Target::kCurrent, rpm - 50.0, rpm + 50.0)));
}

TEST(UnknownRotor, TheFilesRotorDrivesAnotherIntoContactAndTheBearingsAloneDoNot) {
  constexpr double kRpm = 4200.0;
  const configuration::RigFile softer = SofterRig();
  ClosedLoop harmed(Careless(Knowledge::kRotor, kRpm), softer.plant);
  EXPECT_TRUE(TouchesAt(harmed, kRpm));

  ClosedLoop held(Careless(Knowledge::kBearings, kRpm), softer.plant);
  ASSERT_TRUE(TurnsAt(held, kRpm, 20.0));
  EXPECT_EQ(held.out.fault, Fault::kNone);
  EXPECT_EQ(held.most.contact_n, 0.0);
  EXPECT_LT(Measure(held, 100).current_a, 1e-3);
}

}  // namespace
}  // namespace levitas::test
