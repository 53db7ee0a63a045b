// Faults of stated place and size, on the shipped flexible rotor.

#include "diagnosis/isolability/stated_fault.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

StatedFault StatedOn(const RigView& rig, effect::Id id, double strength = 1.0) {
  return StatedFaultOf(id, rig, strength).value();
}

std::string SizeAt(effect::Id id, double strength) { return StatedOn(TheRig(), id, strength).size; }

TEST(StatedFault, HasTheSizeOfTheCatalogueInTheUnitsOfARigFile) {
  EXPECT_EQ(SizeAt(effect::Id::kCurrentGain, 1.0), "ratio 0.8");
  EXPECT_EQ(SizeAt(effect::Id::kUnbalance, 1.0), "moment_g_mm 20") << "places are no sizes";
  EXPECT_EQ(SizeAt(effect::Id::kAmplifierBandwidth, 1.0), "bandwidth_hz 504") << "0.7 of 720 Hz";
}

// Linear 1 + 0.5 0.1; inverse 150 / 0.5; geometric 720 sqrt(0.7) = 602.4; linear 40 us / 2.
TEST(StatedFault, OfHalfTheStrengthIsSaidAsItActs) {
  EXPECT_EQ(SizeAt(effect::Id::kSensorGain, 0.5), "ratio 1.05");
  EXPECT_EQ(SizeAt(effect::Id::kAmplifierSlew, 0.5), "slew_a_per_s 300");
  EXPECT_EQ(SizeAt(effect::Id::kAmplifierBandwidth, 0.5), "bandwidth_hz 602");
  EXPECT_EQ(SizeAt(effect::Id::kExtraDelay, 0.5), "delay_us 20");
  EXPECT_EQ(StatedOn(TheRig(), effect::Id::kSensorGain, 0.5).entry.strength, 0.5);
  EXPECT_EQ(StatedOn(TheRig(), effect::Id::kSensorGain, 0.5).entry.values[0], 1.1);
}

TEST(StatedFault, StandsAtTheFirstOfItsKindOfPlace) {
  const StatedFault of_channel = StatedOn(TheRig(), effect::Id::kSensorOffset);
  EXPECT_EQ(of_channel.place, "de_x");
  EXPECT_EQ(of_channel.entry.axes, 0b1U);
  EXPECT_EQ(StatedOn(TheRig(), effect::Id::kMagneticCoupling).place, "de");
  EXPECT_EQ(StatedOn(TheRig(), effect::Id::kModalFrequency).place, "mode 1");
  EXPECT_EQ(StatedOn(TheRig(), effect::Id::kRotorMass).place, "");
}

TEST(StatedFault, OfAPlaneStandsAtTheOnlyDiscOfTheRotor) {
  plant::PlantConfig plant = FlexibleRotor().plant;
  plant.rotor.discs = {plant.rotor.discs[1]};
  const RigView view(FlexibleRotor().numbers, plant);
  EXPECT_EQ(StatedOn(view, effect::Id::kUnbalance).entry.values[0], 0.2992);
  EXPECT_EQ(StatedOn(view, effect::Id::kStaticLoad).entry.values[0], 0.2992);
  // A coupling is at the end of the shaft, whatever discs there are.
  EXPECT_EQ(StatedOn(view, effect::Id::kCouplingStiffness).entry.values[0], 0.0);
}

TEST(StatedFault, OfBendingIsNoneOnARotorThatDoesNotBend) {
  plant::PlantConfig plant = FlexibleRotor().plant;
  plant.rotor.modes_per_plane = 2;
  const RigView rigid(FlexibleRotor().numbers, plant);
  EXPECT_FALSE(StatedFaultOf(effect::Id::kShaftBow, rigid).has_value());
  EXPECT_TRUE(StatedFaultOf(effect::Id::kUnbalance, rigid).has_value());
  EXPECT_TRUE(StatedFaultOf(effect::Id::kShaftBow, TheRig()).has_value());
}

// Seven effects are of teeth, and no term describes the scatter of sampling instants.
TEST(StatedFaults, AreAllEntriesOfTheCatalogueButTeethAndJitterInItsOrder) {
  const std::vector<StatedFault> all = StatedFaults(TheRig());
  EXPECT_EQ(all.size(), effect::EntryRows().size() - 8U);
  for (const StatedFault& one : all) {
    EXPECT_NE(effect::At(one.entry.id).place, effect::Place::kGear);
    EXPECT_NE(one.entry.id, effect::Id::kSampleJitter);
    EXPECT_NE(one.size, "") << effect::At(one.entry.id).name;
  }
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(),
                             [](const auto& a, const auto& b) { return a.entry.id < b.entry.id; }));
}

}  // namespace
}  // namespace levitas::diagnosis
