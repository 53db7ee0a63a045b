// Effects of the teeth on the geared rotor: what each changes (order, place, sign), and that it
// changes nothing else. Amplifiers are off: the shafts stand on their own springs.

#include <gtest/gtest.h>

#include <algorithm>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/parameter_access.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/loop/gears/gear_motion.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::test {
namespace {

using effect::Id;

constexpr double kEffectPinion_hz = 20.0;
constexpr double kEffectMesh_hz = 400.0;  // 20 teeth
constexpr double kSpeed_rad_per_s = 2.0 * std::numbers::pi * kEffectPinion_hz;
constexpr double kEffectPeriod_s = 1e-4;
constexpr int kRecord = 2000;  // two turns of the gear (10 Hz): every line below is a whole one
// Slowest decay 15 1/s: after 1.5 s a start is gone to 1e-10.
constexpr int kSettle = 15'000;

effect::EffectConfig OnDriven(effect::EffectConfig entry) {
  entry.on_driven = true;
  return entry;
}

plant::PlantConfig With(plant::PlantConfig rig, const effect::EffectConfig& entry) {
  rig.effects.push_back(entry);
  return rig;
}

std::vector<Whirl> Record(plant::Plant& plant, int periods) {
  std::vector<Whirl> record;
  record.reserve(static_cast<std::size_t>(periods));
  for (int n = 0; n < periods; ++n) {
    record.push_back(At(plant));
    plant.Advance(Passive(kSpeed_rad_per_s));
  }
  return record;
}

std::vector<Whirl> SteadyWhirls(const plant::PlantConfig& rig) {
  plant::Plant plant(rig, 1);
  plant.SetSpeed(kSpeed_rad_per_s, 0.0);
  for (int n = 0; n < kSettle; ++n) plant.Advance(Passive(kSpeed_rad_per_s));
  return Record(plant, kRecord);
}

/// What the entry adds to the steady motion.
std::vector<Whirl> Added(const plant::PlantConfig& rig, const effect::EffectConfig& entry) {
  std::vector<Whirl> with = SteadyWhirls(With(rig, entry));
  const std::vector<Whirl> without = SteadyWhirls(rig);
  for (std::size_t n = 0; n < with.size(); ++n) {
    with[n].pinion -= without[n].pinion;
    with[n].gear -= without[n].gear;
  }
  return with;
}

double Size(const std::vector<Whirl>& record) {
  double sum = 0.0;
  for (const Whirl& r : record) sum += std::norm(r.pinion) + std::norm(r.gear);
  return std::sqrt(sum / static_cast<double>(record.size()));
}

double LineSize(const std::vector<Whirl>& record, double frequency_hz) {
  const Whirl line = Line(record, kEffectPeriod_s, frequency_hz);
  return std::hypot(std::abs(line.pinion), std::abs(line.gear));
}

/// The record is one line and nothing else; 1e-6 is what the start and the step leave.
void ExpectOneLine(const std::vector<Whirl>& record, double frequency_hz) {
  EXPECT_GT(Size(record), 1e-8);
  EXPECT_NEAR(LineSize(record, frequency_hz) / Size(record), 1.0, 1e-6) << frequency_hz << " Hz";
}

/// All entries, each with values that show.
std::vector<effect::EffectConfig> AllEntries() {
  return {Entry(Id::kMeshStiffness, {7e5, 200.0}),
          Entry(Id::kMeshStiffnessVariation, {1.0, 0.2, 0.3}),
          Entry(Id::kBacklash, {20e-6}),
          Entry(Id::kMeshFriction, {0.1}),
          Entry(Id::kTransmissionError, {-7.0, 5e-6, 0.4}),
          OnDriven(Entry(Id::kGearRunout, {30e-6, 1.0})),
          OnDriven(Entry(Id::kToothCrack, {0.5, 7.0}))};
}

plant::PlantConfig FourDofRig() { return GearedRotor4(); }

/// Without what already turns: a mean transmission error alone loads the teeth.
plant::PlantConfig Straight() {
  plant::PlantConfig rig = FourDofRig();
  rig.gears[0].transmission_error = {{0, 10e-6, 0.3}};
  rig.gears[0].driving.runout_m = rig.gears[0].driven.runout_m = 0.0;
  return rig;
}

TEST(GearEffects, HaveAnEntryForEveryIdOfTheCatalogue) {
  const auto entries = AllEntries();
  for (const effect::Row& row : effect::Catalogue()) {
    if (row.place != effect::Place::kGear) continue;
    EXPECT_TRUE(std::any_of(entries.begin(), entries.end(), [&](const auto& entry) {
      return entry.id == row.id;
    })) << row.name;
  }
}

TEST(GearEffects, OfNoStrengthLeaveEveryBitAndOfFullStrengthDoNot) {
  plant::Plant nominal(FourDofRig(), 1);
  nominal.SetSpeed(kSpeed_rad_per_s, 0.0);
  const auto expected = Record(nominal, 400);
  for (effect::EffectConfig entry : AllEntries()) {
    for (const double strength : {0.0, 1.0}) {
      entry.strength = strength;
      plant::Plant plant(With(FourDofRig(), entry), 1);
      plant.SetSpeed(kSpeed_rad_per_s, 0.0);
      const auto found = Record(plant, 400);
      int different = 0;
      for (std::size_t n = 0; n < found.size(); ++n) {
        different += found[n].pinion != expected[n].pinion || found[n].gear != expected[n].gear;
      }
      if (strength == 0.0) {
        EXPECT_EQ(different, 0) << effect::At(entry.id).name;
      } else {
        EXPECT_GT(different, 100) << effect::At(entry.id).name;
      }
    }
  }
}

TEST(GearEffects, OfTransmissionErrorAddOneLineOnItsOwnSide) {
  for (const double order : {2.0, -2.0, 7.0}) {
    const auto added = Added(FourDofRig(), Entry(Id::kTransmissionError, {order, 5e-6, 0.4}));
    ExpectOneLine(added, order * kEffectMesh_hz);
  }
}

TEST(GearEffects, OfTransmissionErrorTurnWithTheirPhase) {
  // Linear teeth: the same amplitude turned by 0.9 rad turns the answer by 0.9 rad.
  const auto first = Added(FourDofRig(), Entry(Id::kTransmissionError, {2.0, 5e-6, 0.4}));
  const auto second = Added(FourDofRig(), Entry(Id::kTransmissionError, {2.0, 5e-6, 1.3}));
  const Complex ratio = Line(second, kEffectPeriod_s, 2.0 * kEffectMesh_hz).pinion /
                        Line(first, kEffectPeriod_s, 2.0 * kEffectMesh_hz).pinion;
  EXPECT_NEAR(std::abs(ratio - std::polar(1.0, 0.9)), 0.0, 1e-6);
}

TEST(GearEffects, OfRunoutAddOneLineInTheSenseOfTheirWheel) {
  ExpectOneLine(Added(FourDofRig(), Entry(Id::kGearRunout, {30e-6, 1.0})), kEffectPinion_hz);
  ExpectOneLine(Added(FourDofRig(), OnDriven(Entry(Id::kGearRunout, {30e-6, 1.0}))),
                -0.5 * kEffectPinion_hz);
}

TEST(GearEffects, OfRunoutEqualARunoutWrittenWithTheWheel) {
  plant::PlantConfig written = Straight();
  written.gears[0].driving.runout_m = 25e-6;
  written.gears[0].driving.runout_phase_rad = 0.7;
  const auto expected = SteadyWhirls(written);
  const auto found = SteadyWhirls(With(Straight(), Entry(Id::kGearRunout, {25e-6, 0.7})));
  for (std::size_t n = 0; n < found.size(); ++n) {
    ASSERT_NEAR(std::abs(found[n].pinion - expected[n].pinion), 0.0, 1e-15);
    ASSERT_NEAR(std::abs(found[n].gear - expected[n].gear), 0.0, 1e-15);
  }
}

TEST(GearEffects, OfMeshStiffnessEqualAStiffnessWrittenWithTheGear) {
  plant::PlantConfig written = FourDofRig();
  written.gears[0].stiffness_n_per_m = 7e5;
  written.gears[0].damping_n_s_per_m = 200.0;
  const auto expected = SteadyWhirls(written);
  const auto found = SteadyWhirls(With(FourDofRig(), Entry(Id::kMeshStiffness, {7e5, 200.0})));
  for (std::size_t n = 0; n < found.size(); ++n) {
    ASSERT_EQ(found[n].pinion, expected[n].pinion);
    ASSERT_EQ(found[n].gear, expected[n].gear);
  }
}

TEST(GearEffects, OfVaryingStiffnessShowAMeanLoadAtTheirOrder) {
  // k(t) times a constant displacement: the first line is order x mesh, both ways alike in force;
  // without the variation there is none.
  const auto added = Added(Straight(), Entry(Id::kMeshStiffnessVariation, {2.0, 0.05, 0.0}));
  const double wanted =
      LineSize(added, 2.0 * kEffectMesh_hz) + LineSize(added, -2.0 * kEffectMesh_hz);
  EXPECT_GT(wanted, 1e-10);  // 10 N on shafts and wheels that yield 0.1 nm/N at 800 Hz
  for (const double other_hz :
       {kEffectMesh_hz, 3.0 * kEffectMesh_hz, kEffectPinion_hz, 0.5 * kEffectPinion_hz}) {
    EXPECT_LT(LineSize(added, other_hz), 1e-6 * wanted) << other_hz;
    EXPECT_LT(LineSize(added, -other_hz), 1e-6 * wanted) << -other_hz;
  }
}

TEST(GearEffects, OfACrackedToothShowMultiplesOfTheRotationOfItsWheel) {
  const auto added = Added(Straight(), OnDriven(Entry(Id::kToothCrack, {0.5, 7.0})));
  const double gear_hz = 0.5 * kEffectPinion_hz;
  double lines = 0.0;
  for (int k = -500; k < 500; ++k) lines += std::pow(LineSize(added, k * gear_hz), 2);
  // Nothing lies between the lines: their powers make the power of the whole.
  EXPECT_NEAR(lines / std::pow(Size(added), 2), 1.0, 1e-6);
  EXPECT_GT(LineSize(added, gear_hz), 1e-9);
  EXPECT_GT(LineSize(added, 2.0 * gear_hz), 1e-9);
  // A crack of the pinion repeats twice as often: no odd line of the gear.
  const auto pinion = Added(Straight(), Entry(Id::kToothCrack, {0.5, 7.0}));
  EXPECT_LT(LineSize(pinion, gear_hz), 1e-6 * LineSize(pinion, kEffectPinion_hz));
}

TEST(GearEffects, OfBacklashDoNothingWhileTheLoadKeepsTheTeethInContact) {
  plant::PlantConfig loaded = FourDofRig();
  loaded.gears[0].driving.base_radius_m = 37.6e-3;
  loaded.gears[0].driving_torque_n_m = 20.0;  // 532 N; the teeth move by some 20 N
  loaded.gears[0].direction = gear::Direction::kLineOfAction;
  EXPECT_LT(Size(Added(loaded, Entry(Id::kBacklash, {40e-6}))), 1e-12);
  loaded.gears[0].driving_torque_n_m = 0.0;
  EXPECT_GT(Size(Added(loaded, Entry(Id::kBacklash, {40e-6}))), 1e-6);
}

TEST(GearEffects, OfFrictionShowAMeanLoadAtTheOddHarmonicsOfTheMesh) {
  const auto added = Added(Straight(), Entry(Id::kMeshFriction, {0.05}));
  const auto both = [&](double order) {
    return LineSize(added, order * kEffectMesh_hz) + LineSize(added, -order * kEffectMesh_hz);
  };
  // The square wave's sharp flanks fall between substeps, which leaves a little at even orders.
  EXPECT_GT(both(1.0), 1e-9);
  EXPECT_LT(both(2.0), 0.05 * both(1.0));
  EXPECT_LT(LineSize(added, kEffectPinion_hz), 1e-3 * both(1.0));
}

TEST(GearEffects, SeveralOfOneIdAddUpAndOneOfARepeatableIsNoConflict) {
  plant::PlantConfig rig = FourDofRig();
  rig.effects = {Entry(Id::kTransmissionError, {2.0, 3e-6, 0.4}),
                 Entry(Id::kTransmissionError, {2.0, 2e-6, 0.4})};
  const auto twice = SteadyWhirls(rig);
  const auto once =
      SteadyWhirls(With(FourDofRig(), Entry(Id::kTransmissionError, {2.0, 5e-6, 0.4})));
  for (std::size_t n = 0; n < once.size(); ++n) {
    ASSERT_NEAR(std::abs(twice[n].pinion - once[n].pinion), 0.0, 1e-15);
  }
  rig.effects = {Entry(Id::kBacklash, {2e-6}), Entry(Id::kBacklash, {3e-6})};
  EXPECT_THROW(plant::PlantModel{rig}, std::invalid_argument);
}

TEST(GearEffects, AreRefusedWithoutGearsAndBeyondTheirRange) {
  plant::PlantConfig rig = FourDofRig();
  rig.effects = {Entry(Id::kToothCrack, {0.5, 0.0})};
  rig.effects[0].gear = 1;
  EXPECT_THROW(plant::PlantModel{rig}, std::invalid_argument);
  rig.effects[0].gear = 0;
  rig.effects[0].values[0] = 1.5;
  EXPECT_THROW(plant::PlantModel{rig}, std::invalid_argument);
}

TEST(GearEffects, AreAmongTheParametersOfTheRig) {
  const plant::PlantModel model(With(FourDofRig(), Entry(Id::kToothCrack, {0.5, 7.0})));
  plant::PlantParameters parameters = model.parameters();
  EXPECT_EQ(plant::GetParameter(parameters, "effects[0].depth"), 0.5);
  plant::SetParameter(parameters, "effects[0].depth", 0.25);
  EXPECT_EQ(parameters.config.effects[0].values[0], 0.25);
}

TEST(GearEffects, ChangeWhileItRunsWithoutAllocating) {
  plant::PlantConfig rig = FourDofRig();
  rig.effects = AllEntries();
  plant::Plant plant(rig, 1);
  plant.AllowEffectChanges();
  plant.SetSpeed(kSpeed_rad_per_s, 0.0);
  const AllocationGuard guard;
  for (int n = 0; n < 100; ++n) {
    for (std::size_t i = 0; i < rig.effects.size(); ++i) {
      ASSERT_TRUE(plant.SetEffectStrength(i, 0.01 * n));
    }
    plant.Advance(Passive(kSpeed_rad_per_s));
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_TRUE(plant.finite());
}

}  // namespace
}  // namespace levitas::test
