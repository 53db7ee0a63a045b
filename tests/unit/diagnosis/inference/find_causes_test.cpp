// Which observers, causes and further questions a search goes through, on evidence that is known.

#include "diagnosis/inference/find_causes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnosis/toy_observed.hpp"

namespace levitas::diagnosis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kStage = "screening all causes";

/// One cause of 47 nat.
struct OneCauseToFind : ToyObserved {
  OneCauseToFind() : ToyObserved({10.0, 0.0}, {{role::kX, {1.0, 0.0}}, {role::kY, {0.0, 1.0}}}) {}
};

/// Two causes of 47 and 37.5 nat.
struct TwoCausesToFind : ToyObserved {
  TwoCausesToFind() : ToyObserved({10.0, 9.0}, {{role::kX, {1.0, 0.0}}, {role::kY, {0.0, 1.0}}}) {}
};

SelectionRules QuickRules() {
  SelectionRules rules = ThoroughRules();
  rules.effort.first_cause_only = true;
  return rules;
}

/// What the runs of the calibrated model left.
double LeftOf(const ToyObserved& toy, const Runs& runs) {
  return 1.0 / toy.PlainFilterOf(*runs).filter[0][0];
}

TEST(FindCauses, AddsCausesUntilNoneGainsEnough) {
  TwoCausesToFind toy;
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(Named(found), (EffectSet{role::kX, role::kY}));
  EXPECT_NEAR(found.point.theta[0], 10.0, 1e-9);
  EXPECT_NEAR(found.point.theta[1], 9.0, 1e-9);
  EXPECT_EQ(toy.TimesDid(kStage), 3) << "the third one finds none";
  EXPECT_THAT(toy.observed, IsEmpty());
  EXPECT_EQ(toy.view().point, found.point);
}

TEST(FindCauses, AddsNoMoreThanThereMayBe) {
  for (const std::size_t most : {0U, 1U, 2U}) {
    TwoCausesToFind toy;
    toy.loud = {{}, {role::kX}};
    SelectionRules rules = ThoroughRules();
    rules.most_causes = most;
    CauseSelection found = toy.Calibrated();
    FindCauses(toy, rules, found);
    EXPECT_EQ(found.causes.size(), most);
  }
}

TEST(FindCauses, EndsAtOnceWithWhatThereIsWhenItIsToStop) {
  TwoCausesToFind toy;
  toy.stop = true;
  CauseSelection found = toy.With({role::kX});
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(Named(found), EffectSet{role::kX});
  EXPECT_EQ(toy.view().point, found.point) << "linearised, so that it can be ranked";
  EXPECT_THAT(toy.fits, IsEmpty());
}

TEST(FindCauses, KeepsTheRunsOfTheCalibratedModel) {
  OneCauseToFind toy;
  toy.left = {{{kSlowestObserver, {}}, 7.0}};
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_NEAR(LeftOf(toy, found.calibrated_runs), 7.0, 1e-5);
}

// What the filter holds, 1.04 times what is left behind it, is what whitening anew is for.
TEST(FindCauses, EndsAFirstAnswerWithItsFirstCause) {
  for (const auto& [held, anew] : {std::pair{1.02, false}, std::pair{1.04, true}}) {
    TwoCausesToFind toy;
    toy.left = {{{kSlowestObserver, {}}, held}};
    CauseSelection found = toy.Calibrated();
    FindCauses(toy, QuickRules(), found);
    EXPECT_EQ(Named(found), EffectSet{role::kX});
    EXPECT_EQ(toy.TimesDid(kStage), 1);
    EXPECT_EQ(found.whitened_anew, anew) << held;
    EXPECT_EQ(toy.unfiltered_at.size(), anew ? 1U : 0U);
  }
}

TEST(FindCauses, EndsAFirstAnswerWithoutACauseUnwhitened) {
  ToyObserved toy({1.0}, {{role::kX, {1.0}}});
  toy.left = {{{kSlowestObserver, {}}, 2.0}};
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, QuickRules(), found);
  EXPECT_THAT(found.causes, IsEmpty());
  EXPECT_FALSE(found.whitened_anew);
}

TEST(FindCauses, GoesBackToTheSlowestObserverWithACause) {
  OneCauseToFind toy;
  toy.at_speed = kFastestObserver;
  toy.left = {{{kSlowestObserver, {}}, 3.0}};
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(Named(found), EffectSet{role::kX});
  EXPECT_THAT(toy.observed, ElementsAre(kMiddleObserver, kSlowestObserver));
  EXPECT_NEAR(LeftOf(toy, found.calibrated_runs), 3.0, 1e-5) << "under the observer of the end";
}

TEST(FindCauses, StaysWithTheFastObserverWithoutACause) {
  ToyObserved toy({1.0}, {{role::kX, {1.0}}});
  toy.at_speed = kFastestObserver;
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_THAT(toy.observed, IsEmpty());
}

/// Under the slowest observer something is wrong with the first cause.
void ExpectStopsAboveTheSlowest(ToyObserved& toy) {
  toy.at_speed = kFastestObserver;
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(Named(found), EffectSet{role::kX});
  EXPECT_THAT(toy.observed, ElementsAre(kMiddleObserver, kSlowestObserver, kMiddleObserver));
  EXPECT_NEAR(LeftOf(toy, found.calibrated_runs), 2.0, 1e-5) << "under the observer of the end";
  EXPECT_EQ(toy.view().point, found.point);
}

struct OneCauseByObservers : OneCauseToFind {
  OneCauseByObservers() { left = {{{kMiddleObserver, {}}, 2.0}, {{kSlowestObserver, {}}, 3.0}}; }
};

TEST(FindCauses, SlowsDownNoFurtherThanTheModelFollows) {
  OneCauseByObservers toy;
  toy.loses = {{kSlowestObserver, {role::kX}}};
  ExpectStopsAboveTheSlowest(toy);
}

TEST(FindCauses, SlowsDownNoFurtherThanSensitivitiesStayFinite) {
  OneCauseByObservers toy;
  toy.wild = {{kSlowestObserver, {role::kX}}};
  ExpectStopsAboveTheSlowest(toy);
}

TEST(FindCauses, SlowsDownNoFurtherThanAFitFollows) {
  OneCauseByObservers toy;
  toy.unfollowed = {{kSlowestObserver, {role::kX}}};
  ExpectStopsAboveTheSlowest(toy);
}

TEST(FindCauses, SlowsDownNoFurtherThanTheModelStaysNear) {
  OneCauseByObservers toy;
  toy.left[{kSlowestObserver, {role::kX}}] = 1.6;  // 1 under the faster one
  ExpectStopsAboveTheSlowest(toy);
}

TEST(FindCauses, SlowsDownWhereTheModelStaysNearlyAsNear) {
  OneCauseByObservers toy;
  toy.at_speed = kFastestObserver;
  toy.left[{kSlowestObserver, {role::kX}}] = 1.4;
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(toy.at_speed, kSlowestObserver);
}

// A slow observer sees more of a slow effect.
TEST(FindCauses, FindsTheShapeAgainUnderTheSlowerObserver) {
  ToyObserved toy({10.0}, {{role::kFamily, {1.0}}});
  toy.at_speed = kMiddleObserver;
  toy.shape[role::kFamily] = 20.0;
  toy.sees_shapes = kSlowestObserver;
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(toy.at_speed, kSlowestObserver);
  EXPECT_EQ(toy.PlaceAt(found.point, found.causes.front()), "at its shape");
}

TEST(FindCauses, BeginsAgainWithAFasterObserverWhereACauseLeadsAstray) {
  TwoCausesToFind toy;
  toy.wild = {{kSlowestObserver, {role::kX}}};
  toy.left = {{{kMiddleObserver, {}}, 2.0}};
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  // Once with the first cause, once without any, and both again; never back to the slowest.
  EXPECT_THAT(toy.observed, ElementsAre(kMiddleObserver));
  EXPECT_EQ(Named(found), (EffectSet{role::kX, role::kY}));
  EXPECT_EQ(toy.TimesDid(kStage), 4);
  EXPECT_NEAR(LeftOf(toy, found.calibrated_runs), 2.0, 1e-5) << "under the faster observer";
}

TEST(FindCauses, ForgetsTheCausesWhereItBeginsAgain) {
  OneCauseToFind toy;
  toy.wild = {{kSlowestObserver, {role::kX}}};
  toy.number[{role::kX}] = 2.0;
  toy.refused = {{role::kX}};
  CauseSelection found = toy.With({role::kX});
  SelectionRules rules = ThoroughRules();
  rules.judging.far_beyond = 1e3;  // so that it is not taken again: no fit confirms it
  FindCauses(toy, rules, found);
  EXPECT_THAT(found.causes, IsEmpty());
  EXPECT_EQ(found.point, found.calibrated);
  EXPECT_EQ(toy.at_speed, kMiddleObserver);
}

TEST(FindCauses, HasNoFasterObserverThanTheFastest) {
  OneCauseToFind toy;
  for (const std::size_t speed : {kSlowestObserver, kMiddleObserver, kFastestObserver})
    toy.wild.insert({speed, {}});
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_THAT(toy.observed, ElementsAre(kMiddleObserver, kFastestObserver));
  EXPECT_EQ(Named(found), EffectSet{role::kX});
}

TEST(FindCauses, AsksForSwallowedCausesOnceWhereThereIsNone) {
  ToyObserved toy({1.0}, {{role::kX, {1.0}}});
  toy.number[{}] = kFarNumber;
  toy.file->free[{}] = {100.0, kFarNumber};
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(toy.file->made, 1);
  EXPECT_THAT(found.causes, IsEmpty());
  EXPECT_EQ(toy.TimesDid(kStage), 1);
}

TEST(FindCauses, AsksForSwallowedCausesOnceAfterAFirstCauseThatDoesNotBringNumbersBack) {
  for (const auto& [left_far, asked] : {std::pair{true, 1}, std::pair{false, 0}}) {
    TwoCausesToFind toy;
    for (const EffectSet& set : {EffectSet{}, EffectSet{role::kX}, EffectSet{role::kX, role::kY}}) {
      if (left_far || set.empty()) toy.number[set] = kFarNumber;
    }
    toy.file->free[{}] = {100.0, kFarNumber};
    CauseSelection found = toy.Calibrated();
    FindCauses(toy, ThoroughRules(), found);
    EXPECT_EQ(toy.file->made, asked) << "of three stages";
    EXPECT_EQ(Named(found), (EffectSet{role::kX, role::kY}));
  }
}

TEST(FindCauses, AsksForNoSwallowedCausesForAFirstAnswer) {
  for (const double reading : {1.0, 10.0}) {
    ToyObserved toy({reading}, {{role::kX, {1.0}}});
    toy.number[{}] = toy.number[{role::kX}] = kFarNumber;
    CauseSelection found = toy.Calibrated();
    FindCauses(toy, QuickRules(), found);
    EXPECT_EQ(toy.file->made, 0);
  }
}

/// A cause that the screen does not see, since calibration has swallowed it: 50 nat from the file.
struct OneUnseen : ToyObserved {
  OneUnseen() : ToyObserved({1.0, 1.0}, {{role::kX, {1.0, 0.0}}, {role::kTrueCause, {0.0, 1.0}}}) {
    number[{}] = kFarNumber;
    file->free[{}] = {100.0, kFarNumber};
    file->screened = {{role::kTrueCause, 40.0}};
    file->with[{role::kTrueCause}] = {50.0, 0.0};
    misfit = [](const EffectSet& set, double) { return set.empty() ? 100.0 : 50.0; };
  }
};

TEST(FindCauses, GoesOnWithASwallowedCauseUnderSlowObservers) {
  OneUnseen toy;
  toy.left = {{{kFastestObserver, {}}, 2.0}, {{kSlowestObserver, {}}, 3.0}};
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(Named(found), EffectSet{role::kTrueCause});
  EXPECT_THAT(toy.observed, ElementsAre(kFastestObserver, kMiddleObserver, kSlowestObserver));
  EXPECT_EQ(toy.TimesDid(kStage), 2);
  EXPECT_NEAR(LeftOf(toy, found.calibrated_runs), 3.0, 1e-5);
}

TEST(FindCauses, KeepsTheRunsOfTheObserverUnderWhichASwallowedCauseWasTaken) {
  OneUnseen toy;
  toy.left = {{{kFastestObserver, {}}, 2.0}, {{kSlowestObserver, {}}, 3.0}};
  for (const EffectSet& set : {EffectSet{}, EffectSet{role::kTrueCause}})
    toy.loses.insert({kMiddleObserver, set});
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(toy.at_speed, kFastestObserver);
  EXPECT_NEAR(LeftOf(toy, found.calibrated_runs), 2.0, 1e-5);
}

// The first cause explains much and brings no number back; one from the file does both.
TEST(FindCauses, GoesOnWithASwallowedCauseInThePlaceOfAFirstOne) {
  ToyObserved toy({10.0, 1.0}, {{role::kFirst, {1.0, 0.0}}, {role::kTrueCause, {0.0, 1.0}}});
  toy.number[{}] = toy.number[{role::kFirst}] = kFarNumber;
  toy.file->free[{}] = {100.0, kFarNumber};
  toy.file->screened = {{role::kTrueCause, 40.0}};
  toy.file->with[{role::kTrueCause}] = {50.0, 0.0};
  toy.misfit = [](const EffectSet& set, double) {
    return set == EffectSet{role::kTrueCause} ? 0.0 : 50.0;
  };
  SelectionRules rules = ThoroughRules();
  rules.most_causes = 1;
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, rules, found);
  EXPECT_EQ(Named(found), EffectSet{role::kTrueCause});
  EXPECT_EQ(toy.at_speed, kSlowestObserver) << "a further stage goes back to it";
  EXPECT_EQ(toy.file->made, 1);
}

TEST(FindCauses, LooksForCausesAgainAboutACalibrationThatWasReplaced) {
  ToyObserved toy({1.0}, {{role::kX, {1.0}}});
  toy.number[{}] = kFarNumber;
  toy.file->free[{}] = {100.0, kFarNumber};
  toy.file->anew = {90.0, 0.0};
  toy.misfit = [](const EffectSet&, double at_number) { return at_number; };
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(toy.NumberAt(found.calibrated), 0.0);
  EXPECT_EQ(found.point, found.calibrated);
  EXPECT_EQ(toy.TimesDid(kStage), 2);
  EXPECT_EQ(toy.file->made, 1);
}

TEST(FindCauses, AsksWhetherAFaultIsLoudAtTheFirstStageOnly) {
  TwoCausesToFind toy;
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(toy.TimesDid(kStage), 3);
  EXPECT_EQ(toy.asked_loud, 1);
}

/// Without a filter the readings show the fault; behind one, half a nat.
struct OneLoud : ToyObserved {
  OneLoud() : ToyObserved({1.0}, {{role::kTrueCause, {1.0}}}) {
    loud = {{}};
    unfiltered_readings = {20.0};
    misfit = [](const EffectSet& set, double) { return set.empty() ? 1000.0 : 500.0; };
  }
};

TEST(FindCauses, GoesOnWithALoudFault) {
  OneLoud toy;
  CauseSelection found = toy.Calibrated();
  FindCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(Named(found), EffectSet{role::kTrueCause});
  EXPECT_EQ(toy.TimesDid(kStage), 2);
}

}  // namespace
}  // namespace levitas::diagnosis
