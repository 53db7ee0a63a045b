// When a bent calibration is replaced and which causes it had swallowed, by what fits from the file
// cost.

#include "diagnosis/inference/swallowed_causes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/diagnosis/toy_observed.hpp"

namespace levitas::diagnosis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kWithout = 1000.0;  // [nat] cost of the nuisances alone
constexpr double kNearNumber = 2.9;  // [tolerances] not far
const EffectSet kNone{};
const EffectSet kOneX{role::kX};
const EffectSet kXAndY{role::kX, role::kY};

/// Calibration went far, and fits from the file are asked. A test says which causes they see. With
/// all rows any set costs 100 nat less for each cause.
struct BentCalibration : ToyObserved {
  BentCalibration()
      : ToyObserved({1.0, 1.0, 1.0, 1.0}, {{role::kX, {1.0, 0.0, 0.0, 0.0}},
                                           {role::kY, {0.0, 1.0, 0.0, 0.0}},
                                           {role::kZ, {0.0, 0.0, 1.0, 0.0}},
                                           {role::kOther, {0.0, 0.0, 0.0, 1.0}}}) {
    number[kNone] = kFarNumber;
    file->free[kNone] = {kWithout, kFarNumber};
    misfit = [](const EffectSet& set, double) {
      return 900.0 - 100.0 * static_cast<double>(set.size());
    };
  }
};

/// From the file X is worth 100 nat, and brings the number back.
struct OneSwallowed : BentCalibration {
  OneSwallowed() {
    file->screened = {{role::kX, 40.0}};
    file->with[kOneX] = {kWithout - 100.0, 0.0};
  }
};

struct Taken {
  bool taken{};
  CauseSelection found;
};

Taken Take(ToyObserved& toy, CauseSelection found, const SelectionRules& rules = ThoroughRules()) {
  toy.LineariseAt(found.point);
  found.refitted.emplace_back();
  const bool taken = TakeSwallowedCauses(toy, rules, found);
  EXPECT_EQ(toy.view().point, found.point) << "linearised there before and after";
  return {taken, found};
}

Taken Take(ToyObserved& toy) { return Take(toy, toy.Calibrated()); }

// --- Which fits are made ---

TEST(TakeSwallowedCauses, AsksNothingWhereNoNumberWentFar) {
  OneSwallowed toy;
  toy.number[kNone] = kNearNumber;
  const Taken end = Take(toy);
  EXPECT_FALSE(end.taken);
  EXPECT_EQ(toy.file->made, 0);
  EXPECT_TRUE(end.found.causes.empty());
}

TEST(TakeSwallowedCauses, GivesUpWhereNoFitWithoutACauseFollows) {
  OneSwallowed toy;
  toy.file->free.clear();
  EXPECT_FALSE(Take(toy).taken);
  EXPECT_THAT(toy.file->tried, IsEmpty());
}

TEST(TakeSwallowedCauses, TakesTheCauseWithItsFitUnderTheFastestObserver) {
  OneSwallowed toy;
  const Taken end = Take(toy);
  ASSERT_TRUE(end.taken);
  EXPECT_EQ(Named(end.found), kOneX);
  EXPECT_EQ(end.found.point, toy.PointWith(toy.CausesOf(kOneX), 0.0));
  EXPECT_EQ(toy.NumberAt(end.found.calibrated), kFarNumber) << "that of no cause stays";
  EXPECT_THAT(end.found.refitted, IsEmpty()) << "weighed about the bent calibration";
  EXPECT_THAT(toy.observed, ElementsAre(kFastestObserver));
  ASSERT_EQ(toy.file->linearised.size(), 1U);
  EXPECT_EQ(toy.file->linearised[0], toy.FileNumbers()) << "screened about the file";
}

TEST(TakeSwallowedCauses, FindsTheShapeOfWhatItTakes) {
  OneSwallowed toy;
  toy.shape[role::kX] = 20.0;
  const Taken end = Take(toy);
  ASSERT_TRUE(end.taken);
  EXPECT_EQ(toy.PlaceAt(end.found.point, end.found.causes[0]), "at its shape");
}

// --- Adding one cause at a time ---

TEST(TakeSwallowedCauses, TakesACauseThatLowersTheCostByWhatSuspectsOne) {
  for (const auto& [gain, taken] : {std::pair{24.0, false}, std::pair{26.0, true}}) {
    OneSwallowed toy;
    toy.file->with[kOneX].cost = kWithout - gain;
    const Taken end = Take(toy);
    EXPECT_EQ(end.taken, taken) << gain;
    EXPECT_EQ(Named(end.found), taken ? kOneX : kNone);
    EXPECT_EQ(toy.observed.empty(), !taken) << "the observer stays without one";
    EXPECT_EQ(end.found.refitted.empty(), taken);
  }
}

TEST(TakeSwallowedCauses, TriesTheThreeBestThatTheScreenFindsDecisive) {
  BentCalibration toy;
  toy.file->screened = {{role::kX, 40.0}, {role::kY, 30.0}, {role::kZ, 20.0}, {role::kOther, 10.0}};
  EXPECT_FALSE(Take(toy).taken);
  EXPECT_THAT(toy.file->tried, ElementsAre(kOneX, EffectSet{role::kY}, EffectSet{role::kZ}));

  BentCalibration weak;
  weak.file->screened = {{role::kX, 5.1}, {role::kY, 4.9}};
  EXPECT_FALSE(Take(weak).taken);
  EXPECT_THAT(weak.file->tried, ElementsAre(kOneX));
}

// About the file the screen need not see what was found about the calibrated numbers: beside a
// resonance that the file has elsewhere it sees hardly anything.
TEST(TakeSwallowedCauses, TriesWhatWasFoundBeforeFromTheFileToo) {
  OneSwallowed toy;
  toy.number[EffectSet{role::kY}] = kFarNumber;
  toy.file->free[EffectSet{role::kY}] = {kWithout - 10.0, kFarNumber};
  toy.file->with[EffectSet{role::kY}] = {kWithout - 200.0, 0.0};
  toy.misfit = [](const EffectSet&, double at_number) { return at_number; };
  const Taken end = Take(toy, toy.With({role::kY}));
  EXPECT_THAT(toy.file->tried, ElementsAre(EffectSet{role::kY}, kOneX));
}

TEST(TakeSwallowedCauses, TriesWhatWasFoundBeforeOnce) {
  BentCalibration toy;
  toy.number[kOneX] = kFarNumber;
  toy.file->screened = {{role::kX, 40.0}, {role::kY, 30.0}};
  Take(toy, toy.With(kOneX));
  EXPECT_THAT(toy.file->tried, ElementsAre(kOneX, EffectSet{role::kY}));
}

// On few rows Y begins 99 or 101 nat behind X. It would end ahead.
TEST(TakeSwallowedCauses, FinishesWhatBeginsNearTheBest) {
  for (const auto& [behind, taken] : {std::pair{99.0, role::kY}, std::pair{101.0, role::kX}}) {
    BentCalibration toy;
    toy.file->screened = {{role::kX, 40.0}, {role::kY, 30.0}};
    toy.file->begun = {{kOneX, 500.0}, {EffectSet{role::kY}, 500.0 + behind}};
    toy.file->with[kOneX] = {kWithout - 100.0, 0.0};
    toy.file->with[EffectSet{role::kY}] = {kWithout - 200.0, 0.0};
    EXPECT_EQ(Named(Take(toy).found), EffectSet{taken}) << behind;
    EXPECT_EQ(toy.file->finished.size(), behind < 100.0 ? 2U : 1U);
  }
}

TEST(TakeSwallowedCauses, FitsNothingMoreOnceASearchIsToEnd) {
  OneSwallowed toy;
  toy.stop = true;
  EXPECT_FALSE(Take(toy).taken);
  EXPECT_THAT(toy.file->tried, IsEmpty());
}

TEST(TakeSwallowedCauses, TakesTheBestOfThoseThatItTries) {
  BentCalibration toy;
  toy.file->screened = {{role::kX, 40.0}, {role::kY, 30.0}, {role::kZ, 20.0}};
  toy.file->with[{role::kX}] = {kWithout - 50.0, 0.0};
  toy.file->with[{role::kY}] = {kWithout - 80.0, 0.0};  // Z cannot be followed
  EXPECT_EQ(Named(Take(toy).found), EffectSet{role::kY});
}

/// X is worth 100 nat from the file, and Y another 100 beside it.
struct TwoSwallowed : OneSwallowed {
  explicit TwoSwallowed(double number_with_x) {
    file->screened.push_back({role::kY, 30.0});
    file->with[kOneX].number = number_with_x;
    file->with[kXAndY] = {kWithout - 200.0, 0.0};
  }
};

TEST(TakeSwallowedCauses, LooksForAFurtherCauseWhileNumbersStayFar) {
  for (const auto& [number, named] :
       {std::pair{kNearNumber, kOneX}, std::pair{kFarNumber, kXAndY}}) {
    TwoSwallowed toy(number);
    const Taken end = Take(toy);
    ASSERT_TRUE(end.taken);
    EXPECT_EQ(Named(end.found), named) << number;
  }
}

TEST(TakeSwallowedCauses, KeepsTheFirstWhereAFurtherOneGainsTooLittle) {
  TwoSwallowed toy(kFarNumber);
  toy.file->with[kXAndY].cost = kWithout - 124.0;
  EXPECT_EQ(Named(Take(toy).found), kOneX);
}

TEST(TakeSwallowedCauses, TakesNoMoreThanThereMayBe) {
  for (const std::size_t most : {0U, 1U}) {
    TwoSwallowed toy(kFarNumber);
    SelectionRules rules = ThoroughRules();
    rules.most_causes = most;
    EXPECT_EQ(Take(toy, toy.Calibrated(), rules).found.causes.size(), most);
  }
}

TEST(TakeSwallowedCauses, ComparesWithWhatWasFoundSoFarFromThere) {
  for (const auto& [cost, taken] :
       {std::pair{kWithout - 74.0, true}, std::pair{kWithout - 76.0, false}}) {
    OneSwallowed toy;  // 100 nat below no cause
    const EffectSet so_far{role::kY};
    toy.number[so_far] = kFarNumber;
    toy.file->free[so_far] = {cost, kFarNumber};
    toy.misfit = [](const EffectSet& set, double) { return set == kOneX ? 0.0 : 900.0; };
    const Taken end = Take(toy, toy.With(so_far));
    EXPECT_EQ(end.taken, taken) << cost;
    EXPECT_EQ(Named(end.found), taken ? kOneX : so_far);
  }
}

// --- With all rows ---

/// The gain does not hold: all stays as it was, with its observer.
void ExpectDenied(ToyObserved& toy, const CauseSelection& before) {
  const Taken end = Take(toy, before);
  EXPECT_FALSE(end.taken);
  EXPECT_EQ(end.found.causes.size(), before.causes.size());
  EXPECT_EQ(end.found.point, before.point);
  EXPECT_FALSE(end.found.refitted.empty());
  EXPECT_THAT(toy.observed, ElementsAre(kFastestObserver, kSlowestObserver));
}

TEST(TakeSwallowedCauses, DeniesAGainThatDoesNotHoldWithAllRows) {
  for (const auto& [gain, holds] : {std::pair{24.0, false}, std::pair{26.0, true}}) {
    OneSwallowed toy;
    toy.misfit = [gain = gain](const EffectSet& set, double) { return set.empty() ? gain : 0.0; };
    if (holds) {
      EXPECT_TRUE(Take(toy).taken);
    } else {
      ExpectDenied(toy, toy.Calibrated());
    }
  }
}

TEST(TakeSwallowedCauses, DeniesACauseThatNoFitFollowsWithAllRows) {
  OneSwallowed toy;
  toy.refused = {kOneX};
  ExpectDenied(toy, toy.Calibrated());
}

TEST(TakeSwallowedCauses, DeniesACauseWhereNoFitWithoutOneFollowsWithAllRows) {
  OneSwallowed toy;
  toy.refused = {kNone};
  ExpectDenied(toy, toy.Calibrated());
}

TEST(TakeSwallowedCauses, DeniesACauseThatIsNoBetterThanWhatWasFoundSoFarWithAllRows) {
  for (const auto& [so_far_nat, holds] : {std::pair{24.0, false}, std::pair{26.0, true}}) {
    OneSwallowed toy;
    const EffectSet so_far{role::kY};
    toy.number[so_far] = kFarNumber;
    toy.misfit = [so_far, nat = so_far_nat](const EffectSet& set, double) {
      return set.empty() ? 900.0 : (set == so_far ? nat : 0.0);
    };
    if (holds) {
      EXPECT_EQ(Named(Take(toy, toy.With(so_far)).found), kOneX);
    } else {
      ExpectDenied(toy, toy.With(so_far));
    }
  }
}

TEST(TakeSwallowedCauses, DoesNotCompareWithWhatNoFitFollowsAnyMore) {
  OneSwallowed toy;
  const EffectSet so_far{role::kY};
  toy.number[so_far] = kFarNumber;
  toy.misfit = [so_far](const EffectSet& set, double) {
    return set.empty() ? 900.0 : (set == so_far ? -900.0 : 0.0);
  };
  toy.unfollowed = {{kFastestObserver, so_far}};
  EXPECT_EQ(Named(Take(toy, toy.With(so_far)).found), kOneX);
}

// --- Calibration from the file ---

/// From the file the nuisances alone end 10 nat lower, with the number near.
struct LostCalibration : BentCalibration {
  LostCalibration() {
    file->anew = {kWithout - 10.0, 0.0};
    misfit = [](const EffectSet&, double at_number) { return at_number; };
  }
};

TEST(TakeSwallowedCauses, ReplacesACalibrationThatHadLostItsWayAndItsCauses) {
  for (const EffectSet& so_far : {kNone, kOneX}) {
    LostCalibration toy;
    toy.number[so_far] = kFarNumber;
    const Taken end = Take(toy, toy.With(so_far));
    EXPECT_FALSE(end.taken) << "no cause was";
    EXPECT_THAT(end.found.causes, IsEmpty());
    EXPECT_EQ(toy.NumberAt(end.found.calibrated), 0.0);
    EXPECT_EQ(end.found.point, end.found.calibrated);
    EXPECT_THAT(end.found.refitted, IsEmpty()) << "weighed about the lost calibration";
    EXPECT_THAT(toy.observed, IsEmpty());
  }
}

/// All stays as it was.
void ExpectKeepsCalibration(ToyObserved& toy) {
  const CauseSelection before = toy.Calibrated();
  const Taken end = Take(toy, before);
  EXPECT_FALSE(end.taken);
  EXPECT_EQ(end.found.calibrated, before.calibrated);
  EXPECT_EQ(end.found.point, before.point);
}

TEST(TakeSwallowedCauses, KeepsACalibrationThatCostsLessThanTheOneFromTheFile) {
  LostCalibration toy;
  toy.file->anew.cost = kWithout + 1.0;
  ExpectKeepsCalibration(toy);
}

TEST(TakeSwallowedCauses, KeepsACalibrationThatFitsBetterUnderTheObserverOfTheLandscape) {
  LostCalibration toy;
  toy.misfit = [](const EffectSet&, double at_number) { return -at_number; };
  ExpectKeepsCalibration(toy);
}

// Another observer led to it; the present one has its least elsewhere.
TEST(TakeSwallowedCauses, FitsACalibrationUnderThePresentObserverBeforeItIsReplaced) {
  LostCalibration toy;
  toy.file->anew.number = 2.0;
  ASSERT_EQ(toy.NumberAt(Take(toy, toy.Calibrated()).found.calibrated), 2.0);
  toy.ends[kFarNumber] = 1.0;
  ExpectKeepsCalibration(toy);
}

// The other calibration was linearised to be weighed; what is ranked is what was found.
TEST(TakeSwallowedCauses, GoesBackToWhatWasFoundOnceASearchIsToEnd) {
  LostCalibration toy;
  toy.misfit = [](const EffectSet&, double at_number) { return -at_number; };
  toy.stop = true;
  ExpectKeepsCalibration(toy);
}

TEST(TakeSwallowedCauses, KeepsACalibrationWhereNoOtherCanBeFollowed) {
  LostCalibration toy;
  toy.refused = {kNone};
  ExpectKeepsCalibration(toy);
}

TEST(TakeSwallowedCauses, AddsCausesToTheBetterOfTwoWaysWithoutOne) {
  // 30 nat below calibration, but only 20 below the way from the file.
  for (const auto& [anew, taken] : {std::pair{kWithout - 10.0, false}, std::pair{kWithout, true}}) {
    OneSwallowed toy;
    toy.file->anew = {anew, kFarNumber};
    toy.file->with[kOneX].cost = kWithout - 30.0;
    EXPECT_EQ(Take(toy).taken, taken) << anew;
  }
}

}  // namespace
}  // namespace levitas::diagnosis
