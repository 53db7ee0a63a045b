// Causes that make the model fit a record at rest better, worse, or as well as before.

#include <gtest/gtest.h>

#include <utility>

#include "diagnosis/inference/fit_gain.hpp"
#include "tests/unit/diagnosis/rest_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

/// The hum as a cause whose cosine is calibrated to `cosine_m`.
CauseSelection HumOf(const RestLandscape& rest, double cosine_m) {
  CauseSelection found = rest.Calibrated();
  found.causes = {rest.Of(Id::kMainsPickup, kHumPlace)};
  found.point.theta[found.causes.front().terms.front()] = cosine_m;
  return found;
}

TEST(DropUngained, KeepsAHumOfItsSizeAndDropsOneOfTheWrongSign) {
  for (const auto& [cosine_m, left] : {std::pair{kHum, 1U}, std::pair{-kHum, 0U}}) {
    RestLandscape& rest = Humming();
    CauseSelection found = HumOf(rest, cosine_m);
    DropUngained(rest.landscape, Judging{}, found);
    EXPECT_EQ(found.causes.size(), left) << cosine_m;
    EXPECT_EQ(found.point == found.calibrated, left == 0U);
  }
}

// What is dropped leaves the calibrated model: linearised there, and what is left is its run.
TEST(DropUngained, LeavesTheLandscapeAtTheCalibratedModel) {
  RestLandscape& rest = Humming();
  CauseSelection found = HumOf(rest, -kHum);
  const Runs before = found.calibrated_runs;
  rest.landscape.LineariseAt(found.point);
  DropUngained(rest.landscape, Judging{}, found);
  EXPECT_EQ(rest.landscape.view().point, found.calibrated);
  EXPECT_EQ(found.calibrated_runs, rest.landscape.view().runs);
  EXPECT_NE(found.calibrated_runs, before);
}

// At rest an unbalance changes no reading. Four tolerances that calibration had moved its numbers
// by are 16 squares that come back with it; nothing comes back where it had not.
TEST(DropUngained, KeepsACauseThatTakesNumbersBackFromTheCalibration) {
  for (const auto& [tolerances, left] : {std::pair{4.0, 1U}, std::pair{0.0, 0U}}) {
    RestLandscape& rest = NothingWrong();
    CauseSelection found = rest.Calibrated();
    found.causes = {rest.Of(Id::kUnbalance, "z 129.9 mm")};
    const std::size_t term = found.causes.front().terms.front();
    const double tolerance = rest.landscape.terms()[term].tolerance;
    found.point.theta[term] = found.calibrated.theta[term] = tolerances * tolerance;
    DropUngained(rest.landscape, Judging{}, found);
    EXPECT_EQ(found.causes.size(), left) << tolerances;
  }
}

TEST(DropUngained, WithoutCausesChangesNothing) {
  RestLandscape& rest = Humming();
  CauseSelection found = rest.Calibrated();
  found.calibrated.theta[0] = 0.01;
  const Point before = found.point;
  DropUngained(rest.landscape, Judging{}, found);
  EXPECT_EQ(found.point, before);
}

}  // namespace
}  // namespace levitas::diagnosis
