// From rows to what the models are driven with, and the rig file that comes back.

#include "diagnosis/levitator/series.hpp"

#include <gtest/gtest.h>

#include "analysis/records/coil_prediction.hpp"
#include "common/problem.hpp"
#include "diagnosis/levitator/levitator_result.hpp"
#include "diagnosis/levitator/report_values.hpp"
#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

using test::LevitatorFile;

std::vector<analysis::RecordedRow> Rows(std::size_t count) {
  std::vector<analysis::RecordedRow> rows(count);
  for (std::size_t n = 0; n < count; ++n) {
    rows[n].cycle = n;
    rows[n].levitated = true;
    rows[n].coils = 2;
    rows[n].coil_current_a = {1.0, 0.02};
    rows[n].sample.position_m[0] = 1e-3;
    rows[n].sample.command.bias_current_a = 0.6;
    rows[n].sample.command.control_current_a[0] = 0.6;
  }
  return rows;
}

TEST(MakeSeries, BeginsHalfASecondBeforeTheLiftOffEnds) {
  const Series series = MakeSeries("run", LevitatorFile(), Rows(10'000));
  EXPECT_NEAR(series.time_s.front(), 1.5, 1e-9);  // a fifth of 10 s less half a second
  EXPECT_FALSE(series.counts[499]);
  EXPECT_TRUE(series.counts[501]);
  EXPECT_TRUE(series.restart.front());
  EXPECT_TRUE(series.idle[1]);
  EXPECT_FALSE(series.idle[0]);
  EXPECT_NEAR(series.asked_a[0].front(), 1.2, 1e-12);
  EXPECT_NEAR(series.asked_a[1].front(), 0.0, 1e-12);
}

TEST(MakeSeries, StartsAnewBehindMissingRows) {
  auto rows = Rows(10'000);
  rows.erase(rows.begin() + 5000, rows.begin() + 5100);
  const Series series = MakeSeries("run", LevitatorFile(), rows);
  std::size_t restarts = 0;
  for (const bool restart : series.restart) restarts += restart ? 1 : 0;
  EXPECT_EQ(restarts, 2U);
}

// Rows are in the bearing frame: a rig that is wired the other way round has the same series and
// the same currents in its coils.
TEST(MakeSeries, KnowsNothingOfTheWiringOfTheRig) {
  configuration::RigFile reversed = LevitatorFile();
  reversed.plant.sensor_polarity[0] = reversed.plant.actuator_polarity[0] = -1.0;
  const auto rows = Rows(10'000);
  const Series straight = MakeSeries("run", LevitatorFile(), rows);
  const Series wired = MakeSeries("run", reversed, rows);
  EXPECT_EQ(wired.position_m, straight.position_m);
  EXPECT_EQ(wired.asked_a, straight.asked_a);
  EXPECT_EQ(analysis::PredictCoilCurrents(reversed.plant, rows),
            analysis::PredictCoilCurrents(LevitatorFile().plant, rows));
}

TEST(MakeSeries, RefusesWhatIsTooShortOrMeasuredInPart) {
  EXPECT_THROW((void)MakeSeries("run", LevitatorFile(), Rows(900)), BadInput);
  auto rows = Rows(10'000);
  rows[7000].coils = 0;
  EXPECT_THROW((void)MakeSeries("run", LevitatorFile(), rows), BadInput);
}

TEST(Stretch, LiesWhereItsPhaseSays) {
  const Series whole = MakeSeries("run", LevitatorFile(), Rows(10'000));
  const Series last = Stretch(whole, 2.0, 1.0);
  EXPECT_NEAR(last.time_s.back(), whole.time_s.back(), 2e-3);
  EXPECT_NEAR(static_cast<double>(last.size()), 2500.0, 2.0);
  EXPECT_EQ(Stretch(whole, 100.0, 0.5).size(), whole.size());
}

TEST(IsLevitator, IsTrueOfTheLevitatorAlone) {
  EXPECT_TRUE(IsLevitator(LevitatorFile().plant));
  EXPECT_FALSE(IsLevitator(
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs")).plant));
  EXPECT_FALSE(
      IsLevitator(configuration::LoadRig(configuration::FindConfig("one_axis", "rigs")).plant));
}

TEST(CalibratedRigFile, IsReadBackWithTheFoundValuesInItsKeys) {
  const configuration::RigFile rig = LevitatorFile();
  Found found;
  found.extended.theta = Zeros(1);
  found.extended.deviation = Zeros(1);
  found.extended.theta[kDelay] = 1.4;
  found.extended.theta[kForce] = 0.2;
  found.extended.theta[kProfile] = 0.5;
  found.extended.theta[kSensorOffset] = 3e-4;
  found.extended.theta[kLoad] = 0.01;
  found.extended.theta[kDeadBand] = 0.1;
  const configuration::RigFile read =
      configuration::ParseRig(CalibratedRig(rig, Zeros(0), found), "calibrated_rig.yaml");
  EXPECT_NEAR(read.plant.delay_samples, 1.4, 1e-12);
  const auto& bearing = read.plant.bearings[0];
  EXPECT_NEAR(bearing.magnet.exponential->force_n_per_a2, 1.2 * 3.008878, 1e-9);
  EXPECT_NEAR(bearing.amplifier.voltage->decay_m, 2.0 * 4.5626e-3, 1e-12);
  EXPECT_NEAR(bearing.amplifier.voltage->dead_band_a, 0.1, 1e-12);
  EXPECT_NEAR(bearing.amplifier.voltage->offset_a, 0.0243, 1e-12) << "an idle coil keeps its own";
  ASSERT_EQ(read.plant.effects.size(), 2U);
  EXPECT_EQ(read.plant.effects[0].id, effect::Id::kSensorOffset);
  EXPECT_EQ(read.plant.effects[1].id, effect::Id::kStaticLoad);
}

TEST(ReportValues, AreTheKeysAndUnitsOfTheRigFile) {
  const configuration::RigFile rig = LevitatorFile();
  Found found;
  found.extended.theta = Zeros(1);
  found.extended.deviation = Zeros(1);
  found.extended.theta[kSensorOffset] = 60e-6;
  found.extended.deviation[kSensorOffset] = 10e-6;
  found.extended.theta[kDelay] = 1.4;
  found.extended.deviation[kDelay] = 0.1;
  for (const diagnosis::Hypothesis& cause : AllCauses()) {
    if (cause.effect == effect::Id::kExtraDelay) found.causes = {cause};
  }
  ASSERT_EQ(found.causes.size(), 1U);
  const auto parameters = ReportParameters(rig, Zeros(0), found);
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_EQ(parameters[0].name, "delay_samples[ball_x]");
  EXPECT_NEAR(parameters[0].value, rig.plant.delay_samples + 1.4, 1e-12);
  EXPECT_NEAR(parameters[0].high - parameters[0].value, 0.1645, 1e-12);
  bool offset = false;
  for (const diagnosis::CalibratedValue& v : ReportCalibration(rig, Zeros(0), found)) {
    EXPECT_NE(v.effect, "extra_delay") << "a cause is not calibrated";
    if (v.effect != "sensor_offset") continue;
    offset = true;
    EXPECT_EQ(v.key, "offset_um");
    EXPECT_NEAR(v.calibrated, 60.0, 1e-9);
    EXPECT_NEAR(v.deviation, 10.0, 1e-9);
    EXPECT_NEAR(v.tolerance, 30.0, 1e-9);
    EXPECT_NEAR(v.moved, 2.0, 1e-9);
  }
  EXPECT_TRUE(offset);
}

/// A delay as the cause, a weaker magnet and a shifted sensor within their tolerances.
Found DelayFound() {
  Found found;
  found.extended.theta = Zeros(1);
  found.extended.deviation = Zeros(1);
  found.extended.theta[kDelay] = 1.4;
  found.extended.theta[kForce] = -0.03;
  found.extended.theta[kSensorOffset] = 60e-6;
  found.extended.theta[Own(0, kOwnOffset)] = 20e-6;
  for (const diagnosis::Hypothesis& cause : AllCauses()) {
    if (cause.effect == effect::Id::kExtraDelay) found.causes = {cause};
  }
  return found;
}

TEST(ExtendedRigFile, HasTheCausesAndNothingElseThatWasFitted) {
  const configuration::RigFile rig = LevitatorFile();
  configuration::RigFile expected = rig;
  expected.plant.delay_samples += 1.4;
  const configuration::RigFile read =
      configuration::ParseRig(ExtendedRig(rig, Zeros(0), DelayFound()), "extended_rig.yaml");
  EXPECT_EQ(configuration::WriteRig(read), configuration::WriteRig(expected));
}

TEST(ExtendedRigFile, WithoutACauseIsTheRigFileItself) {
  const configuration::RigFile rig = LevitatorFile();
  Found found = DelayFound();
  found.causes.clear();
  const configuration::RigFile read =
      configuration::ParseRig(ExtendedRig(rig, Zeros(0), found), "extended_rig.yaml");
  EXPECT_EQ(configuration::WriteRig(read), configuration::WriteRig(rig));
}

TEST(ExtendedRigFile, KeepsTheEffectsOfTheFileButNotWhatHealthyRecordsHaveShown) {
  configuration::RigFile rig = LevitatorFile();
  rig.plant.effects = configuration::ParseRig(CalibratedRig(rig, Zeros(0), DelayFound()), "r.yaml")
                          .plant.effects;  // a sensor's offset of 80 um
  ASSERT_EQ(rig.plant.effects.size(), 1U);
  Theta healthy = OriginOf(rig);
  healthy[kSpring] += 30.0;
  const configuration::RigFile read =
      configuration::ParseRig(ExtendedRig(rig, healthy, DelayFound()), "extended_rig.yaml");
  ASSERT_EQ(read.plant.effects.size(), 1U);
  EXPECT_EQ(read.plant.effects[0].id, effect::Id::kSensorOffset);
  EXPECT_NEAR(read.plant.effects[0].values[0], 80e-6, 1e-10);
}

TEST(CalibratedRigFile, HasTheCausesTheCalibratedValuesAndWhatHealthyRecordsHaveShown) {
  const configuration::RigFile rig = LevitatorFile();
  Theta healthy = OriginOf(rig);
  healthy[kSpring] += 30.0;
  const configuration::RigFile read =
      configuration::ParseRig(CalibratedRig(rig, healthy, DelayFound()), "calibrated_rig.yaml");
  EXPECT_NEAR(read.plant.delay_samples, rig.plant.delay_samples + 1.4, 1e-9);
  const double nominal = rig.plant.bearings[0].magnet.exponential->force_n_per_a2;
  EXPECT_NEAR(read.plant.bearings[0].magnet.exponential->force_n_per_a2, 0.97 * nominal,
              1e-6 * nominal);
  ASSERT_EQ(read.plant.effects.size(), 2U);
  EXPECT_EQ(read.plant.effects[0].id, effect::Id::kSensorOffset);
  EXPECT_NEAR(read.plant.effects[0].values[0], 80e-6, 1e-10);  // the records' mean besides
  EXPECT_EQ(read.plant.effects[1].id, effect::Id::kCouplingStiffness);
}

TEST(CalibratedRigFile, KeepsTheForceAtTheCentreWhenTheStiffnessAloneIsOther) {
  const configuration::RigFile rig = LevitatorFile();
  Found found;
  found.extended.theta = Zeros(1);
  found.extended.deviation = Zeros(1);
  found.extended.theta[kForceDecay] = 0.25;
  const configuration::RigFile read =
      configuration::ParseRig(CalibratedRig(rig, Zeros(0), found), "calibrated_rig.yaml");
  const auto centre = [](const configuration::RigFile& file) {
    const auto& magnet = file.plant.bearings[0].magnet;
    return magnet.exponential->force_n_per_a2 *
           std::exp(-magnet.gap_m / magnet.exponential->decay_m);
  };
  EXPECT_NEAR(centre(read), centre(rig), 1e-9 * centre(rig));
  EXPECT_NEAR(read.plant.bearings[0].magnet.exponential->decay_m, 5.8231e-3 / 1.25, 1e-12);
}

}  // namespace
}  // namespace levitas::levitator
