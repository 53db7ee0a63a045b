// Free-running coil currents against their closed forms.

#include "diagnosis/levitator/coil_run.hpp"

#include <gtest/gtest.h>

#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

using test::LevitatorFile;
using test::StillSeries;

constexpr double kCloseEnough_a = 1e-9;  // closed forms on both sides: rounding alone

NominalRig Rig() { return NominalOf(LevitatorFile()); }

double Tau(const NominalRig& rig, double gap_m) {
  return rig.time_constant_s * std::exp(-gap_m / rig.inductance_decay_m);
}

/// Current after `seconds` of a coil that starts at `from`.
double Exponential(double from_a, double last_a, double seconds, double tau_s) {
  return last_a + (from_a - last_a) * std::exp(-seconds / tau_s);
}

TEST(CoilRun, FollowsTheLagOfTheRigFile) {
  const NominalRig rig = Rig();
  const CoilRun run = RunCoils(rig, StillSeries(20, 1.5, 1.0), Zeros(1), 0);
  const double expected_a = Exponential(1.0, 1.5 + rig.offset_a, 10e-3, Tau(rig, 10e-3));
  EXPECT_NEAR(run.reading_a[0][10], expected_a, kCloseEnough_a);
}

TEST(CoilRun, HasNoLagOfTheGapWhenItsProfileIsFlat) {
  const NominalRig rig = Rig();
  Theta theta = Zeros(1);
  theta[kProfile] = 1.0;
  const CoilRun near = RunCoils(rig, StillSeries(20, 1.5, 1.0, 5e-3), theta, 0);
  const CoilRun far = RunCoils(rig, StillSeries(20, 1.5, 1.0, -5e-3), theta, 0);
  EXPECT_NEAR(near.reading_a[0][10], far.reading_a[0][10], kCloseEnough_a);
  EXPECT_NEAR(near.reading_a[0][10],
              Exponential(1.0, 1.5 + rig.offset_a, 10e-3, rig.time_constant_s), kCloseEnough_a);
}

TEST(CoilRun, ActsLaterByItsDelayAndByAFractionOfASample) {
  const NominalRig rig = Rig();
  Series series = StillSeries(30, 1.0, 1.0 + rig.offset_a);
  for (std::size_t n = 10; n < series.size(); ++n) series.asked_a[0][n] = 1.5;
  Theta theta = Zeros(1);
  theta[kDelay] = 2.25;
  const CoilRun run = RunCoils(rig, series, theta, 0);
  EXPECT_NEAR(run.reading_a[0][12], 1.0 + rig.offset_a, kCloseEnough_a);
  const double since_s = 20e-3 - 12.25e-3;
  EXPECT_NEAR(run.reading_a[0][20],
              Exponential(1.0 + rig.offset_a, 1.5 + rig.offset_a, since_s, Tau(rig, 10e-3)),
              kCloseEnough_a);
}

TEST(CoilRun, EndsAtSupplyOverResistanceBeyondItsDeadBand) {
  const NominalRig rig = Rig();
  Theta theta = Zeros(1);
  theta[kSupply] = 0.1;
  theta[kResistance] = 0.2;
  theta[kDeadBand] = 0.3;
  const CoilRun run = RunCoils(rig, StillSeries(400, 1.5, 1.0), theta, 0);
  EXPECT_NEAR(run.reading_a[0].back(), (1.1 * (1.5 - 0.3) + rig.offset_a) / 1.2, kCloseEnough_a);
}

TEST(CoilRun, AddsWhatTheDriveAddsToACommandOfThatCoilAlone) {
  const NominalRig rig = Rig();
  Theta theta = Zeros(1);
  theta[kCommandUpper] = 0.04;
  const Series series = StillSeries(400, 1.5, 1.0);
  const CoilRun upper = RunCoils(rig, series, theta, 0);
  EXPECT_NEAR(upper.reading_a[0].back(), 1.54 + rig.offset_a, kCloseEnough_a);
  EXPECT_NEAR(upper.reading_a[1].back(), rig.offset_a, kCloseEnough_a);
  theta[kCommandLower] = 0.1;
  EXPECT_NEAR(RunCoils(rig, series, theta, 0).reading_a[1].back(), 0.1 + rig.offset_a,
              kCloseEnough_a);
}

TEST(CoilRun, LosesCurrentAsItWarms) {
  const NominalRig rig = Rig();
  Theta theta = Zeros(1);
  theta[kHeating] = 0.05;
  const CoilRun run = RunCoils(rig, StillSeries(4000, 1.5, 1.5), theta, 0);
  // The coil follows within 4 ms a resistance that changes by 0.02 % in that time.
  EXPECT_NEAR(run.reading_a[0].back(), (1.5 + rig.offset_a) / (1.0 + 0.05 * 4.0), 5e-4);
}

TEST(CoilRun, ReadsWhatTheProbeMakesOfIt) {
  const NominalRig rig = Rig();
  Theta theta = Zeros(1);
  theta[kProbeGain] = 0.05;
  theta[kProbeOffset] = 0.01;
  const CoilRun run = RunCoils(rig, StillSeries(400, 1.5, 1.0), theta, 0);
  EXPECT_NEAR(run.reading_a[0].back(), 1.05 * (1.5 + rig.offset_a) + 0.01, kCloseEnough_a);
  EXPECT_NEAR(run.current_a[0].back(), 1.5 + rig.offset_a, kCloseEnough_a);
}

TEST(CoilRun, InducesInTheIdleCoilOnlyWithACoupling) {
  const NominalRig rig = Rig();
  Series series = StillSeries(60, 1.0, 1.0 + rig.offset_a);
  for (std::size_t n = 20; n < series.size(); ++n) series.asked_a[0][n] = 0.2;
  Theta theta = Zeros(1);
  const CoilRun alone = RunCoils(rig, series, theta, 0);
  EXPECT_NEAR(alone.reading_a[1][25], rig.offset_a, kCloseEnough_a);
  theta[kMutual] = 0.1;
  const CoilRun coupled = RunCoils(rig, series, theta, 0);
  EXPECT_GT(coupled.reading_a[1][25], rig.offset_a + 0.02);  // a fall of 0.7 A, a tenth of it
}

TEST(TruePosition, UndoesWhatTheSensorDoes) {
  Theta theta = Zeros(2);
  theta[kSensorGain] = 0.05;
  theta[kSensorOffset] = 1e-4;
  theta[Own(1, kOwnOffset)] = 5e-5;
  const double reading_m = 1.05 * 2e-3 + 1e-4 + 5e-5;
  EXPECT_NEAR(TruePosition(reading_m, theta, 1), 2e-3, 1e-12);
  EXPECT_NEAR(TruePosition(reading_m - 5e-5, theta, 0), 2e-3, 1e-12);
}

}  // namespace
}  // namespace levitas::levitator
