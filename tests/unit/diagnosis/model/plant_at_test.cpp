// The plant with other modes: closed forms of frequency and damping, and the limits of both.

#include "diagnosis/model/plant_at.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "tests/support/effect_entry.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kFirstBending = 2;  // behind two rigid modes
constexpr double kFileDamping = 0.003;    // of every flexible mode of the rig file

TEST(PlantAt, IsTheRigsOwnModelWhereNothingOfTheKindChanges) {
  LinearChange change;
  change.axis[0].coil_rate = 0.5;
  change.mode[kFirstBending].drive = 2.0;
  EXPECT_EQ(PlantAt(TheRig(), change), TheRig().model);
}

// The change of damping is one of 2 z w: doubled frequency alone halves z.
TEST(PlantAt, ScalesTheFrequencyOfOneModeAndKeepsTwoZetaOmegaUnlessThatChangesToo) {
  LinearChange change;
  change.mode[kFirstBending].frequency = 2.0;
  const auto higher = PlantAt(TheRig(), change);
  const auto& own = TheRig().model->frequency();
  EXPECT_DOUBLE_EQ(higher->frequency()[kFirstBending], 2.0 * own[kFirstBending]);
  EXPECT_DOUBLE_EQ(higher->damping_ratio()[kFirstBending], 0.5 * kFileDamping);
  EXPECT_EQ(higher->frequency()[kFirstBending + 1], own[kFirstBending + 1]);
  change.mode[kFirstBending].damping = 2.0;
  EXPECT_DOUBLE_EQ(PlantAt(TheRig(), change)->damping_ratio()[kFirstBending], kFileDamping);
}

TEST(PlantAt, MakesAPlantOfWhateverAFitTries) {
  LinearChange change;
  change.mode[kFirstBending].damping = 1e6;
  change.mode[kFirstBending + 1].frequency = std::numeric_limits<double>::quiet_NaN();
  change.mode[kFirstBending + 2].damping = std::numeric_limits<double>::infinity();
  change.mode[kFirstBending + 3].damping = -1.0;
  const auto plant = PlantAt(TheRig(), change);
  EXPECT_EQ(plant->damping_ratio()[kFirstBending], 0.999);
  EXPECT_DOUBLE_EQ(plant->frequency()[kFirstBending + 1],
                   1e-3 * TheRig().model->frequency()[kFirstBending + 1]);
  EXPECT_EQ(plant->damping_ratio()[kFirstBending + 2], 0.0);
  EXPECT_EQ(plant->damping_ratio()[kFirstBending + 3], 0.0);
}

TEST(PlantAt, MovesAlsoTheModeThatAnEffectOfTheFileHasPlaced) {
  plant::PlantConfig with = FlexibleRotor().plant;
  with.effects.push_back(test::Entry(effect::Id::kModalFrequency, {95.0}));
  const RigView view(FlexibleRotor().numbers, with);
  LinearChange change;
  change.mode[kFirstBending].frequency = 1.1;
  EXPECT_NEAR(PlantAt(view, change)->frequency()[kFirstBending],
              2.0 * std::numbers::pi * 95.0 * 1.1, 1e-9)
      << "a few roundings of a number near 657";
}

TEST(PlantAt, ScalesAllGyroscopicMomentsAlike) {
  LinearChange change;
  change.gyroscopic = 1.5;
  const auto plant = PlantAt(TheRig(), change);
  const std::vector<double>& own = TheRig().model->gyroscopic();
  ASSERT_EQ(plant->gyroscopic().size(), own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_DOUBLE_EQ(plant->gyroscopic()[i], 1.5 * own[i]) << i;
  }
  EXPECT_EQ(plant->frequency(), TheRig().model->frequency());
}

}  // namespace
}  // namespace levitas::diagnosis
