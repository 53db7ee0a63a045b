// Sessions of the simulated geared rig, one after another: a tooth that cracks is seen to, on its
// wheel, and what is no crack is not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "analysis/records/condition_trend.hpp"
#include "common/random.hpp"
#include "configuration/rig_file.hpp"
#include "tests/loop/gears/gear_motion.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/paths.hpp"

namespace levitas::test {
namespace {

using analysis::GearCondition;
using effect::Id;

constexpr double kSessionTurn_hz = 29.0;
constexpr double kSession_s = 1.0;  // of which 0.3 s pass first: ten repeats of both wheels
constexpr double kBefore_s = 0.8;   // undisturbed shafts forget their start as exp(-15 t)

/// Its teeth under a load of 2 N m, as those of a machine that drives something.
const plant::PlantConfig& GearedRig() {
  static const plant::PlantConfig loaded = [] {
    plant::PlantConfig rig =
        configuration::LoadRig(test::SourceFolder() + "/config/rigs/geared_rotor_4dof.yaml").plant;
    rig.gears[0].driving_torque_n_m = 2.0;
    return rig;
  }();
  return loaded;
}

/// The shafts on their own springs at 29 Hz, as the noisy probes of the rig see them.
GearCondition Session(const plant::PlantConfig& rig, std::uint64_t seed,
                      double turn_hz = kSessionTurn_hz) {
  plant::Plant plant(rig, seed);
  const double speed = 2.0 * std::numbers::pi * turn_hz;
  plant.SetSpeed(speed, 0.1 * static_cast<double>(seed % 60));  // in no certain place
  const double period_s = 1e-9 * static_cast<double>(rig.period_ns);
  const auto before = static_cast<std::size_t>(kBefore_s / period_s);
  const auto rows = static_cast<std::size_t>(kSession_s / period_s);
  session::Recording record;
  record.period_ns = rig.period_ns;
  record.channels = {"p_x", "p_y", "g_x", "g_y"};
  record.position_m.resize(4);
  record.current_a.assign(4, session::Column(rows, 0.0));
  record.excitation_a.resize(4);
  record.excitation_m.resize(4);
  record.levitated.assign(rows, 1);
  for (std::size_t n = 0; n < before + rows; ++n) {
    const SensorFrame frame = plant.Sample();
    if (n >= before) {
      record.cycle.push_back(n);
      record.speed_rad_per_s.push_back(plant.speed_rad_per_s());
      record.angle_rad.push_back(plant.angle_rad());
      for (std::size_t a = 0; a < 4; ++a) record.position_m[a].push_back(frame.position_m[a]);
    }
    plant.Advance(Passive(speed));
  }
  const auto held = analysis::HeldSpeeds(record, 0.3);
  EXPECT_EQ(held.size(), 1U);
  return analysis::MeasureGears(record, held.front(), rig);
}

/// Three healthy sessions, from which every series goes on.
std::vector<GearCondition> Healthy() {
  static const std::vector<GearCondition> first{Session(GearedRig(), 1), Session(GearedRig(), 2),
                                                Session(GearedRig(), 3)};
  return first;
}

plant::PlantConfig Cracked(double depth, int tooth, bool driven) {
  plant::PlantConfig rig = GearedRig();
  rig.effects = {Entry(Id::kToothCrack, {depth, static_cast<double>(tooth)})};
  rig.effects[0].on_driven = driven;
  return rig;
}

std::vector<analysis::ShaftTrend> Follow(const std::vector<GearCondition>& sessions) {
  EXPECT_THAT(analysis::Reasons(sessions, GearedRig()), testing::IsEmpty());
  return analysis::FollowCondition(sessions, {});
}

TEST(GearCondition, RisesOnTheWheelWhoseToothCracks) {
  for (const bool driven : {false, true}) {
    for (const std::uint64_t seed : {11U, 12U}) {
      Random random(seed);
      const double deepest = 0.03 + 0.1 * random.Uniform();
      const int tooth = static_cast<int>(random.Bits() % (driven ? 40 : 20));
      std::vector<GearCondition> sessions = Healthy();
      for (const double share : {0.4, 0.7, 1.0}) {
        sessions.push_back(
            Session(Cracked(share * deepest, tooth, driven), seed + sessions.size()));
      }
      const auto trends = Follow(sessions);
      ASSERT_EQ(trends.size(), 2U);
      EXPECT_EQ(trends[0].risen, !driven) << deepest << " tooth " << tooth;
      EXPECT_EQ(trends[1].risen, driven) << deepest << " tooth " << tooth;
      const analysis::ShaftTrend& cracked = trends[driven ? 1 : 0];
      EXPECT_GT(cracked.amplitude_m.value, 0.0);
      for (std::size_t i = 4; i < 6; ++i) EXPECT_GT(cracked.rise[i], cracked.rise[i - 1]);
    }
  }
}

TEST(GearCondition, OfHealthyRigsDoesNotRise) {
  for (const std::uint64_t seed : {21U, 31U, 41U}) {
    std::vector<GearCondition> sessions = Healthy();
    for (std::uint64_t i = 0; i < 2; ++i) sessions.push_back(Session(GearedRig(), seed + i));
    for (const auto& trend : Follow(sessions)) {
      EXPECT_FALSE(trend.risen) << seed << " " << trend.wheels;
      for (const double rise : trend.rise) EXPECT_LT(std::abs(rise), 5.0) << seed;
    }
  }
}

// What grows turns once a turn alone, and by far more than a crack moves the shafts.
TEST(GearCondition, DoesNotTakeUnbalanceOrRunoutOrACouplingForACrack) {
  plant::PlantConfig unbalanced = GearedRig();
  unbalanced.unbalance.push_back({0.0, 200e-6, 0.5, 0});
  plant::PlantConfig eccentric = GearedRig();
  eccentric.effects = {Entry(Id::kGearRunout, {40e-6, 0.4})};
  eccentric.effects[0].on_driven = true;
  plant::PlantConfig misaligned = GearedRig();
  misaligned.effects = {Entry(Id::kMisalignment, {0.0, 2.0, 5.0, 0.3, 5e-4})};
  for (const auto& rig : {unbalanced, eccentric, misaligned}) {
    std::vector<GearCondition> sessions = Healthy();
    sessions.push_back(Session(rig, 51));
    for (const auto& trend : Follow(sessions)) EXPECT_FALSE(trend.risen) << trend.rise.back();
  }
  std::vector<GearCondition> sessions = Healthy();
  sessions.push_back(Session(eccentric, 52));
  EXPECT_GT(std::abs(Follow(sessions)[1].once_ratio - 1.0), 0.2);
}

TEST(GearCondition, OfAnotherSpeedIsNotCompared) {
  std::vector<GearCondition> sessions = Healthy();
  sessions.push_back(Session(GearedRig(), 4, 1.02 * kSessionTurn_hz));
  const auto reasons = analysis::Reasons(sessions, GearedRig());
  ASSERT_FALSE(reasons.empty());
  EXPECT_THAT(reasons.front(), testing::HasSubstr("session 4: speed 1774.8 rpm, the first 1740.0"));
}

// Without a load the run-out of the gear decides how a crack of the pinion looks: one is seen, but
// the pinion is named alone only where its two pulses a turn of the gear differ from one.
TEST(GearCondition, WithoutALoadNamesBothWheelsWhereTheyLookAlike) {
  plant::PlantConfig rig = GearedRig();
  rig.gears[0].driving_torque_n_m = 0.0;
  std::vector<GearCondition> sessions{Session(rig, 1), Session(rig, 2), Session(rig, 3)};
  rig.effects = Cracked(0.4, 5, true).effects;
  sessions.push_back(Session(rig, 71));
  analysis::TrendRule rule;
  rule.loaded = false;
  const auto trends = analysis::FollowCondition(sessions, rule);
  EXPECT_TRUE(trends[1].risen);
  EXPECT_EQ(trends[1].or_else, 0U);
}

// A crack's pulse is peaked, noise is not.
TEST(GearCondition, TellsAPulseFromNoiseByItsPeaks) {
  const GearCondition healthy = Healthy().front();
  const GearCondition cracked = Session(Cracked(0.1, 7, true), 61);
  EXPECT_NEAR(healthy.shafts[1].fm4.value, 3.0, 5.0 * healthy.shafts[1].fm4.deviation);
  EXPECT_GT(cracked.shafts[1].fm4.value,
            healthy.shafts[1].fm4.value + 3.0 * cracked.shafts[1].fm4.deviation);
}

}  // namespace
}  // namespace levitas::test
