// The table itself: complete, in order, and without a number that contradicts another.
#include "plant_sim/effect/catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace levitas::effect {
namespace {

// The vocabulary of effects that files and diagnosis share, with the place of each.
const std::map<std::string, std::string>& Vocabulary() {
  static const std::map<std::string, std::string> words{
      {"extra_delay", "timing"},
      {"dropped_samples", "timing"},
      {"sample_jitter", "timing"},
      {"amplifier_bandwidth", "amplifier"},
      {"amplifier_slew", "amplifier"},
      {"current_gain", "amplifier"},
      {"force_constant", "magnet"},
      {"magnetic_coupling", "magnet"},
      {"command_offset", "amplifier"},
      {"displacement_stiffness", "magnet"},
      {"coil_asymmetry", "magnet"},
      {"magnetic_saturation", "magnet"},
      {"hysteresis", "magnet"},
      {"eddy_current", "magnet"},
      {"axis_rotation", "magnet"},
      {"sensor_gain", "sensor"},
      {"sensor_offset", "sensor"},
      {"sensor_nonlinearity", "sensor"},
      {"sensor_bandwidth", "sensor"},
      {"sensor_position", "sensor"},
      {"sensor_runout", "sensor"},
      {"mains_pickup", "sensor"},
      {"sensor_noise", "sensor"},
      {"unbalance", "rotor"},
      {"shaft_bow", "rotor"},
      {"shaft_anisotropy", "rotor"},
      {"modal_frequency", "rotor"},
      {"modal_damping", "rotor"},
      {"gyroscopic_inertia", "rotor"},
      {"internal_damping", "rotor"},
      {"rotor_mass", "rotor"},
      {"breathing_crack", "rotor"},
      {"misalignment", "external"},
      {"coupling_stiffness", "external"},
      {"cross_coupled_stiffness", "external"},
      {"static_load", "external"},
      {"support_mode", "support"},
      {"touchdown_rub", "support"},
      {"supply_voltage", "coil"},
      {"coil_resistance", "coil"},
      {"coil_inductance", "coil"},
      {"inductance_profile", "coil"},
      {"voltage_drop", "coil"},
      {"drive_nonlinearity", "coil"},
      {"drive_asymmetry", "coil"},
      {"coil_heating", "coil"},
      {"motion_emf", "coil"},
      {"mutual_inductance", "coil"},
      {"current_sensor_gain", "coil"},
      {"current_sensor_offset", "coil"},
      {"current_sensor_bandwidth", "coil"},
      {"force_exponent", "coil"},
      {"viscous_damping", "ball"},
      {"dry_friction", "ball"},
  };
  return words;
}

TEST(Catalogue, HoldsEveryWordOfTheVocabularyAtItsPlace) {
  for (const auto& [name, place] : Vocabulary()) {
    const Row* row = Find(name);
    ASSERT_NE(row, nullptr) << name;
    EXPECT_EQ(Name(row->place), place) << name;
  }
  EXPECT_EQ(Find("no_such_effect"), nullptr);
}

TEST(Catalogue, StandsInTheOrderOfTheIdsAndNamesEachOnce) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < Catalogue().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(Catalogue()[i].id), i);
    EXPECT_TRUE(names.insert(Catalogue()[i].name).second) << Catalogue()[i].name;
    EXPECT_EQ(&At(static_cast<Id>(i)), &Catalogue()[i]);
  }
}

TEST(Catalogue, SaysOfEveryEffectWhatItIsHowItShowsAndWhoSaysSo) {
  for (const Row& row : Catalogue()) {
    EXPECT_FALSE(row.meaning.empty()) << row.name;
    EXPECT_FALSE(row.equation.empty()) << row.name;
    EXPECT_FALSE(row.signature.empty()) << row.name;
    EXPECT_NE(row.source.find_first_of("0123456789"), std::string_view::npos) << row.name;
    EXPECT_LE(row.parameters.size(), kMaxParameters) << row.name;
    EXPECT_GE(row.parameters.size(), 1U) << row.name;
  }
}

TEST(Catalogue, KeepsClearNeutralAndDefaultInsideTheRange) {
  for (const Row& row : Catalogue()) {
    for (const Parameter& p : row.parameters) {
      const std::string at = std::string(row.name) + "." + std::string(p.stem);
      EXPECT_LT(p.low, p.high) << at;
      const auto inside = [&](double value) { return value >= p.low && value <= p.high; };
      if (std::isnan(p.neutral)) {
        EXPECT_GT(p.clear, 0.0) << at << ": a factor on the rig's own value";
        EXPECT_NE(p.clear, 1.0) << at;
      } else {
        EXPECT_TRUE(inside(p.clear)) << at;
        EXPECT_TRUE(inside(p.neutral) || p.neutral == kNever) << at;
      }
      if (p.fallback) {
        EXPECT_TRUE(inside(*p.fallback)) << at;
      }
      if (p.whole) {
        EXPECT_EQ(p.clear, std::round(p.clear)) << at;
      }
      // Only what is infinite without the effect can be divided by its strength.
      EXPECT_EQ(p.scaling == Scaling::kInverse, p.neutral == kNever) << at;
    }
  }
}

TEST(Catalogue, HasAtLeastOneParameterPerEffectThatTheStrengthMoves) {
  for (const Row& row : Catalogue()) {
    bool moves = false;
    for (const Parameter& p : row.parameters) moves = moves || p.scaling != Scaling::kFixed;
    EXPECT_TRUE(moves) << row.name;
  }
}

TEST(Catalogue, EndsFileAndProgramNamesOfOneQuantityInUnitsOfOneKind) {
  const std::map<std::string_view, std::string_view> kinds{
      {"m", "length"},  {"mm", "length"}, {"um", "length"},   {"s", "time"},     {"us", "time"},
      {"rad", "angle"}, {"deg", "angle"}, {"kg_m", "moment"}, {"g_mm", "moment"}};
  for (const Row& row : Catalogue()) {
    for (const Parameter& p : row.parameters) {
      if (p.si_suffix == p.file_suffix) continue;
      ASSERT_TRUE(kinds.contains(p.si_suffix)) << row.name << "." << p.stem;
      ASSERT_TRUE(kinds.contains(p.file_suffix)) << row.name << "." << p.stem;
      EXPECT_EQ(kinds.at(p.si_suffix), kinds.at(p.file_suffix)) << row.name << "." << p.stem;
    }
  }
}

// By hand: what stands for each in a rig file; nothing where no simulated rig has it.
TEST(Catalogue, HasNoEntryForCoilsOnAVoltageAndABallAndSaysWhatToWriteInstead) {
  const std::map<std::string_view, std::string_view> instead{
      {"supply_voltage", "steady of"},
      {"coil_resistance", "offset_ma"},
      {"coil_inductance", "time_constant_ms"},
      {"inductance_profile", "decay_mm"},
      {"voltage_drop", "dead_band_ma"},
      {"drive_nonlinearity", "curvature"},
      {"drive_asymmetry", "away_steady_ratio"},
      {"coil_heating", "warming_1_per_s"},
      {"motion_emf", "motion_emf"},
      {"mutual_inductance", "leave it out"},
      {"current_sensor_gain", "leave it out"},
      {"current_sensor_offset", "leave it out"},
      {"current_sensor_bandwidth", "leave it out"},
      {"force_exponent", "leave it out"},
      {"viscous_damping", "leave it out"},
      {"dry_friction", "leave it out"}};
  std::set<std::string_view> entries;
  for (const Row& row : EntryRows()) entries.insert(row.name);
  EXPECT_EQ(entries.size() + instead.size(), Catalogue().size());
  for (const Row& row : Catalogue()) {
    const auto own = instead.find(row.name);
    EXPECT_EQ(entries.contains(row.name), own == instead.end()) << row.name;
    EXPECT_EQ(IsEntry(row), own == instead.end()) << row.name;
    if (own == instead.end()) continue;
    EXPECT_NE(InPlaceOfAnEntry(row).find(own->second), std::string::npos) << row.name;
  }
}

TEST(ClearEntry, TakesAbsoluteSizesAsTheyAreAndRelativeOnesTimesTheRigsOwn) {
  EXPECT_EQ(ClearEntry(Id::kEddyCurrent).values[0], 50e-6);
  EXPECT_EQ(ClearEntry(Id::kAmplifierBandwidth, 720.0).values[0], 0.7 * 720.0);
}

TEST(Catalogue, ListsCrossABorderInTheirOrderAndWithoutWhatItLacks) {
  const std::vector<Id> ids{Id::kUnbalance, Id::kExtraDelay};
  EXPECT_EQ(NamesOf(ids), (std::vector<std::string>{"unbalance", "extra_delay"}));
  const std::vector<std::string> names{"unbalance", "no_such_effect", "extra_delay"};
  EXPECT_EQ(IdsOf(names), ids);
}

TEST(Catalogue, TablesByNameAreInTheOrderOfTheNames) {
  std::set<Id, ByName> ids;
  std::set<std::string_view> names;
  for (const Row& row : Catalogue()) {
    ids.insert(row.id);
    names.insert(row.name);
  }
  ASSERT_EQ(ids.size(), names.size());
  EXPECT_TRUE(std::equal(ids.begin(), ids.end(), names.begin(),
                         [](Id id, std::string_view name) { return At(id).name == name; }));
}

}  // namespace
}  // namespace levitas::effect
