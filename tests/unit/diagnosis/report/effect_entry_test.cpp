// Entries of a rig file from what terms found, against the equations of docs/effects.md.

#include "diagnosis/report/effect_entry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "diagnosis/report/gear_entry.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

constexpr double kDegreeInRad = std::numbers::pi / 180.0;

PlacedEffect Placed(Id id, Location at, std::map<std::string, double> theta) {
  PlacedEffect placed;
  placed.effect = id;
  placed.location = std::move(at);
  placed.theta = std::move(theta);
  return placed;
}

double NumberAt(const EntryValues& values, const std::string& key) {
  for (const EntryValue& value : values) {
    if (value.key == key) return value.number;
  }
  throw std::runtime_error("no key " + key);
}

const RigView& GearedView() {
  static const configuration::RigFile kFile =
      configuration::LoadRig(configuration::FindConfig("geared_rotor_4dof", "rigs"));
  static const RigView kView(kFile.numbers, kFile.plant);
  return kView;
}

EntryValues OfTeeth(Id id, const Location& at, std::map<std::string, double> theta) {
  return GearEntry(GearedView(), id, Placed(id, at, std::move(theta)));
}

// 3-4-5; atan2(4, 3) = 53.13010235 degrees, of which a file shows six digits.
TEST(EffectEntry, OfAnUnbalanceIsAmplitudeAndPhaseAsAFileShowsThem) {
  const PlacedEffect found =
      Placed(Id::kUnbalance, AtPlane(0.2992), {{"cosine", 3e-6}, {"sine", 4e-6}});
  const EntryValues values = ValuesOf(TheRig(), found);
  EXPECT_DOUBLE_EQ(NumberAt(values, "moment_g_mm"), 5.0);
  EXPECT_NEAR(NumberAt(values, kPhaseKey), 53.13010235, 1e-8) << "the digits written here";
  const auto entry = EntryFor(TheRig(), found);
  ASSERT_TRUE(entry.has_value());
  EXPECT_DOUBLE_EQ(entry->values[0], 0.2992);
  EXPECT_DOUBLE_EQ(entry->values[1], 5e-6);
  EXPECT_DOUBLE_EQ(entry->values[2], 53.1301 * kDegreeInRad);
}

// C cos(k a) = C cos(k (a - 90 deg) + phase) asks for phase = k 90 deg under the y probe.
TEST(EffectEntry, OfARunoutCountsItsPhaseFromTheProbeThatReadsIt) {
  const auto phase_deg = [](int order, std::size_t axis) {
    const Location at = AtOrderOf(FlexibleRotor().numbers, order, axis);
    return NumberAt(
        ValuesOf(TheRig(), Placed(Id::kSensorRunout, at, {{"cosine", 1e-6}, {"sine", 0.0}})),
        kPhaseKey);
  };
  // Remainders of multiples of pi/2 round by a few 1e-16 rad.
  EXPECT_NEAR(phase_deg(1, 0), 0.0, 1e-12);
  EXPECT_NEAR(phase_deg(1, 1), 90.0, 1e-12);
  EXPECT_NEAR(phase_deg(3, 1), -90.0, 1e-12) << "270 degrees";
}

TEST(EffectEntry, TakesTheFallbackOfAKeyThatIsNotGivenAndRefusesOneWithout) {
  const Location at = AtAxis(FlexibleRotor().numbers, 2);
  const auto eddy = MakeEntry(Id::kEddyCurrent, at, 4, {{"tau_us", 50.0}});
  ASSERT_TRUE(eddy.has_value());
  EXPECT_DOUBLE_EQ(eddy->values[0], 50e-6);
  EXPECT_EQ(eddy->values[1], 1.0) << "all of the force lags";
  EXPECT_EQ(eddy->axes, 0b100U);
  EXPECT_THROW(static_cast<void>(MakeEntry(Id::kEddyCurrent, at, 4, {})), std::logic_error);
  const EntryValues lost{{"tau_us", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_FALSE(MakeEntry(Id::kEddyCurrent, at, 4, lost).has_value());
}

TEST(EffectEntry, TheUnitOfAKeyIsTheLongestThatItEndsIn) {
  EXPECT_DOUBLE_EQ(UnitOfKey("moment_g_mm").si, 1e-6) << "not millimetres";
  EXPECT_DOUBLE_EQ(UnitOfKey("stiffness_n_per_m").si, 1.0);
  EXPECT_DOUBLE_EQ(UnitOfKey("amplitude_um").si, 1e-6);
  EXPECT_DOUBLE_EQ(UnitOfKey("phase_deg").si, kDegreeInRad);
  EXPECT_EQ(UnitOfKey("ratio").symbol, "");
  EXPECT_EQ(UnitOfKey("ratio").si, 1.0);
}

// Rig file: 1e6 N/m and 300 N s/m. A mesh has some stiffness left, and never negative damping.
TEST(GearEntry, OfAMeshIsItsStiffnessAndDampingWithinWhatCanBe) {
  const Location mesh = AtGear("mesh", 0);
  const auto half = OfTeeth(Id::kMeshStiffness, mesh, {{"stiffness", -0.5}, {"damping", 0.1}});
  EXPECT_DOUBLE_EQ(NumberAt(half, "stiffness_n_per_m"), 0.5e6);
  EXPECT_DOUBLE_EQ(NumberAt(half, "damping_n_s_per_m"), 330.0);
  const auto none = OfTeeth(Id::kMeshStiffness, mesh, {{"stiffness", -2.0}, {"damping", -2.0}});
  EXPECT_GT(NumberAt(none, "stiffness_n_per_m"), 0.0);
  EXPECT_EQ(NumberAt(none, "damping_n_s_per_m"), 0.0);
}

TEST(GearEntry, OfAMisalignmentIsAForceAtAPlaneAndARotationBetweenTeeth) {
  Location at = AtGearOrder("mesh", 0, 2);
  const std::map<std::string, double> theta{{"cosine", 0.0}, {"sine", 0.01}};
  const EntryValues turning = OfTeeth(Id::kMisalignment, at, theta);
  EXPECT_DOUBLE_EQ(NumberAt(turning, "rotation_error_deg"), 0.01 / kDegreeInRad);
  EXPECT_DOUBLE_EQ(NumberAt(turning, kPhaseKey), 90.0);
  at.z_m = 0.05;
  const EntryValues pushing = OfTeeth(Id::kMisalignment, at, theta);
  EXPECT_DOUBLE_EQ(NumberAt(pushing, "z_mm"), 50.0);
  EXPECT_DOUBLE_EQ(NumberAt(pushing, "force_n"), 0.01);
  EXPECT_EQ(NumberAt(pushing, "order"), 2.0);
}

TEST(GearEntry, OfACrackIsADepthOfAToothAndNoMoreThanTheWholeOne) {
  const auto crack = OfTeeth(Id::kToothCrack, AtTooth("mesh", 0, true, 7), {{"depth", 1.4}});
  EXPECT_EQ(NumberAt(crack, "depth"), 1.0);
  EXPECT_EQ(NumberAt(crack, "tooth"), 7.0);
  const auto gap = OfTeeth(Id::kBacklash, AtGear("mesh", 0), {{"gap_m", -1e-6}});
  EXPECT_EQ(NumberAt(gap, "gap_um"), 0.0) << "teeth do not overlap";
}

}  // namespace
}  // namespace levitas::diagnosis
