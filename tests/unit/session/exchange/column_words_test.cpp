// What a column's name says: the words are those of loggers, the answers those of the header.

#include "session/exchange/column_words.hpp"

#include <gtest/gtest.h>

namespace levitas::session {
namespace {

RigNumbers WordsRig() {
  RigNumbers rig;
  rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  rig.bearings = {"de", "nde"};
  return rig;
}

NameMeaning MeaningFor(const std::string& name, const std::string& unit = "") {
  return MeaningOf(name, unit, WordsRig());
}

TEST(ColumnWords, ShortWordsFallIntoLettersOfCurrentAxisAndBearing) {
  const NameMeaning meaning = MeaningFor("IXA");  // the example of the header
  EXPECT_EQ(meaning.dimension, Dimension::kCurrent);
  EXPECT_EQ(meaning.axis, 0U);
  EXPECT_EQ(MeaningFor("IYB").axis, 3U);
}

TEST(ColumnWords, ABearingWhoseNameEndsInThatOfAnotherIsNotTakenForIt) {
  EXPECT_EQ(MeaningFor("de_x").axis, 0U);
  EXPECT_EQ(MeaningFor("nde_x").axis, 2U);
}

TEST(ColumnWords, WordsOfPlaceAreTheOrderOfTheBearings) {
  EXPECT_EQ(MeaningFor("PosLeftY [um]").axis, 1U);
  EXPECT_EQ(MeaningFor("PosRightY [um]").axis, 3U);
  EXPECT_FALSE(MeaningFor("Probe Y").axis) << "which bearing is not said";
}

TEST(ColumnWords, AnAxisNeedsOneLetterNotBoth) { EXPECT_FALSE(MeaningFor("Probe left x y").axis); }

TEST(ColumnWords, TheUnitDecidesTheDimensionAndTheRowOfUnitsTheUnit) {
  EXPECT_EQ(MeaningFor("ch_de_x [mm]").unit, "mm");
  EXPECT_EQ(MeaningFor("ch_de_x [mm]", "um").unit, "um");
  EXPECT_EQ(MeaningFor("ch_de_x [A]").dimension, Dimension::kCurrent);
  EXPECT_EQ(MeaningFor("ch_de_x [um]").dimension, Dimension::kLength);
}

TEST(ColumnWords, ALastLetterAIsAmperesAndWhereNoBearingIsLeftAlsoTheFirstOne) {
  const NameMeaning meaning = MeaningFor("exc_x_a");
  EXPECT_EQ(meaning.unit, "a");
  EXPECT_EQ(meaning.axis, 0U);
  EXPECT_TRUE(meaning.excitation);
  EXPECT_EQ(MeaningFor("exc_nde_x_a").axis, 2U) << "a bearing was left";
}

TEST(ColumnWords, ACoilOrATemperatureIsNeitherMotionNorCommand) {
  EXPECT_EQ(MeaningFor("coil_current_de_x [A]").dimension, Dimension::kNone);
  EXPECT_EQ(MeaningFor("current_de_x [A]").dimension, Dimension::kCurrent);
}

TEST(ColumnWords, AccentsDoNotSplitAWord) {
  EXPECT_EQ(MeaningFor("déplacement").dimension, Dimension::kLength);
  EXPECT_EQ(MeaningFor("dplacement").dimension, Dimension::kNone);
}

}  // namespace
}  // namespace levitas::session
