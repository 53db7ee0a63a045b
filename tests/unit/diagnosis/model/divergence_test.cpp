// A model that loses the rotor, told from one that only errs.

#include "diagnosis/model/divergence.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

/// Measured readings reach 20 um.
Trajectory Predicting(float reading_m, bool settled = true) {
  return NoiseRun(1, 500, [=](std::size_t n, SamplePoint& m) {
    if (n != 400) return;
    m.settled = settled;
    m.innovation_m[1] = m.measured_m[1] - reading_m;
  });
}

TEST(ModelDivergesTest, OfAModelFarFromEverythingThatWasMeasured) {
  const auto clearance_m = static_cast<float>(TheRig().numbers.clearance_m);
  EXPECT_TRUE(ModelDiverges(TheRig(), {Predicting(0.5F * clearance_m)}));
  EXPECT_TRUE(ModelDiverges(TheRig(), {Predicting(-0.5F * clearance_m)}));
  EXPECT_TRUE(ModelDiverges(TheRig(), {Predicting(std::numeric_limits<float>::quiet_NaN())}));
}

TEST(ModelDivergesTest, AnErrorOfTheModelIsNoDivergence) {
  EXPECT_FALSE(ModelDiverges(TheRig(), {Predicting(0.0F)}));
  // Twice what was measured, but small beside the clearance.
  EXPECT_FALSE(ModelDiverges(
      TheRig(), {Predicting(0.2F * static_cast<float>(TheRig().numbers.clearance_m))}));
  // Before the observer has settled.
  EXPECT_FALSE(ModelDiverges(
      TheRig(), {Predicting(static_cast<float>(TheRig().numbers.clearance_m), false)}));
}

// A sensor's offset is part of what is predicted, and the rotor stands where the offset puts it.
TEST(ModelDivergesTest, AnOffsetThatTheModelKnowsIsNoDivergence) {
  const auto run = NoiseRun(1, 500, [](std::size_t, SamplePoint& m) {
    m.reading_m[1] = 0.5F * static_cast<float>(TheRig().numbers.clearance_m);
  });
  EXPECT_FALSE(ModelDiverges(TheRig(), {run}));
}

TEST(ModelDivergesTest, OneRecordOfSeveralIsEnough) {
  const auto clearance_m = static_cast<float>(TheRig().numbers.clearance_m);
  EXPECT_TRUE(ModelDiverges(TheRig(), {Predicting(0.0F), Predicting(0.5F * clearance_m)}));
}

NormalEquations WithSlopes(double rms) {
  NormalEquations sum;
  sum.values = 1000;
  sum.jtj = Eigen::MatrixXd::Identity(3, 3) * 1000.0;
  sum.jtj(1, 1) = rms * rms * 1000.0;
  return sum;
}

TEST(RunsAwayTest, DerivativesThatGrowWithoutBoundOrAreNoNumbers) {
  EXPECT_FALSE(SensitivitiesDiverge(WithSlopes(100.0)));
  EXPECT_TRUE(SensitivitiesDiverge(WithSlopes(1e6)));
  EXPECT_TRUE(SensitivitiesDiverge(WithSlopes(std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(SensitivitiesDiverge(WithSlopes(std::numeric_limits<double>::quiet_NaN())));
}

TEST(LostTest, WhatIsNoNumberOnTheDiagonalOrBesideIt) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  NormalEquations sum = WithSlopes(1e6);
  sum.jte = Eigen::VectorXd::Zero(3);
  EXPECT_FALSE(SensitivitiesAreLost(sum));
  sum.jte[2] = nan;
  EXPECT_TRUE(SensitivitiesAreLost(sum));
  sum.jte[2] = 0.0;
  sum.jtj(0, 2) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(SensitivitiesAreLost(sum));
}

}  // namespace
}  // namespace levitas::diagnosis
