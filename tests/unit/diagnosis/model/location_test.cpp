// Places as data and their names.

#include "diagnosis/model/location.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

RigNumbers TwoBearings() {
  RigNumbers rig;
  rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  rig.bearings = {"de", "nde"};
  return rig;
}

TEST(LocationTest, OfAnAxisTouchesItsChannelAlone) {
  const Location at = AtAxis(TwoBearings(), 2);
  EXPECT_EQ(at.name, "nde_x");
  EXPECT_FALSE(at.Touches(0));
  EXPECT_TRUE(at.Touches(2));
  EXPECT_FALSE(at.Touches(3));
}

TEST(LocationTest, OfABearingTouchesBothItsChannels) {
  for (const Location& at : {AtBearing(TwoBearings(), 1), AtSide(TwoBearings(), 1, true)}) {
    EXPECT_FALSE(at.Touches(1)) << at.name;
    EXPECT_TRUE(at.Touches(2)) << at.name;
    EXPECT_TRUE(at.Touches(3)) << at.name;
  }
}

TEST(LocationTest, OfThePlaneOrTheWholeRigTouchesNoChannelOfItsOwn) {
  for (const Location& at : {Everywhere("rotor"), AtPlane(0.1), AtMode(2), AtOrder(1)}) {
    for (std::size_t a = 0; a < 4; ++a) EXPECT_FALSE(at.Touches(a)) << at.name;
  }
}

TEST(LocationTest, WithAnOrderOrALineIsMoreThanAnAxis) {
  EXPECT_TRUE(AtAxis(TwoBearings(), 1).is_axis());
  EXPECT_FALSE(AtOrderOf(TwoBearings(), 2, 1).is_axis());
  EXPECT_FALSE(AtLineOf(TwoBearings(), 50.0, 1).is_axis());
  EXPECT_FALSE(AtBearing(TwoBearings(), 1).is_axis());
}

TEST(LocationTest, KeepsItsNumbersUnderAFurtherName) {
  const Location at = AtBearing(TwoBearings(), 1).Named("90.0 Hz");
  EXPECT_EQ(at.name, "nde, 90.0 Hz");
  EXPECT_EQ(at.bearing, 1U);
  const Location in_mode = AtSide(TwoBearings(), 0, false).InMode(3);
  EXPECT_EQ(in_mode.name, "magnet de, mode 3");
  EXPECT_EQ(in_mode.mode, 3U);
  EXPECT_FALSE(in_mode.on_sensor);
}

TEST(LocationTest, OfATermIsFoundInItsRigByNumber) {
  for (const Term& term : EveryTerm()) {
    const Location& at = term.location;
    EXPECT_LT(at.axis.value_or(0), TheRig().axes) << at.name;
    EXPECT_LT(at.bearing.value_or(0), TheRig().axes / 2) << at.name;
    EXPECT_GE(at.mode.value_or(1), 1U) << at.name;
    EXPECT_LT(at.mode.value_or(1) + 1, TheRig().modes) << at.name;
    EXPECT_FALSE(at.gear.has_value()) << at.name << ": a rig with one rotor has no gears";
  }
}

TEST(LocationTest, TellsThePlacesOfOneEffectApartByName) {
  // Two terms of one effect with one name and one parameter would be fitted as one.
  std::map<std::string, int> seen;
  for (const Term& term : EveryTerm()) {
    const std::string label =
        std::string(term.effect_name()) + "|" + term.location.name + "|" + term.parameter;
    EXPECT_EQ(++seen[label], 1) << label;
  }
}

}  // namespace
}  // namespace levitas::diagnosis
