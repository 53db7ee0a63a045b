// Small parts of a rig's description: wiring, coils on a voltage, what an effect finds, the point
// about which a rig is linear.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "plant_sim/plant/applied_effects/apply_effects.hpp"
#include "plant_sim/plant/bearing_frame.hpp"
#include "plant_sim/plant/coils_of.hpp"
#include "plant_sim/plant/eigen_index.hpp"
#include "plant_sim/plant/operating_point.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

using effect::Id;

TEST(BearingFrame, IsWhereEveryProbeAndCoilIsWiredStraight) {
  EXPECT_TRUE(IsInBearingFrame(test::QuietFlexibleRotor()));
  for (std::size_t axis = 0; axis < 4; ++axis) {
    PlantConfig probe = test::QuietFlexibleRotor();
    probe.sensor_polarity[axis] = -1.0;
    EXPECT_FALSE(IsInBearingFrame(probe)) << axis;
    EXPECT_TRUE(IsInBearingFrame(InBearingFrame(probe))) << axis;
    PlantConfig coil = test::QuietFlexibleRotor();
    coil.actuator_polarity[axis] = -1.0;
    EXPECT_FALSE(IsInBearingFrame(coil)) << axis;
    EXPECT_TRUE(IsInBearingFrame(InBearingFrame(coil))) << axis;
  }
}

TEST(CoilsOf, ABearingWithCurrentLoopsAreNone) {
  for (const auto& coil : CoilsOf(test::QuietFlexibleRotor().bearings[0])) {
    EXPECT_EQ(coil.time_constant_s, 0.0);
  }
}

TEST(CoilsOf, ABearingOnAVoltageDifferByTheirRatiosAlone) {
  BearingConfig bearing = test::QuietFlexibleRotor().bearings[0];
  VoltageDrive drive;
  drive.steady = 0.9;
  drive.offset_a = 0.1;
  drive.time_constant_s = 0.05;
  drive.decay_m = 2e-3;
  drive.away_steady_ratio = 1.2;
  drive.away_time_constant_ratio = 0.5;
  bearing.amplifier.voltage = drive;
  const auto [towards, away] = CoilsOf(bearing);
  EXPECT_EQ(towards.steady, 0.9);
  EXPECT_EQ(towards.time_constant_s, 0.05);
  EXPECT_DOUBLE_EQ(away.steady, 0.9 * 1.2);
  EXPECT_DOUBLE_EQ(away.time_constant_s, 0.05 * 0.5);
  EXPECT_EQ(away.offset_a, towards.offset_a);
  EXPECT_EQ(away.decay_m, towards.decay_m);
}

TEST(OperatingPoint, IsCentredOnlyWithoutCurrentAndWithoutDisplacement) {
  OperatingPoint point;
  EXPECT_TRUE(point.centred());
  point.displacement_m[3] = 1e-9;
  EXPECT_FALSE(point.centred());
  point = {};
  point.flux_a[0] = -1e-6;
  EXPECT_FALSE(point.centred());
}

TEST(ToVector, KeepsTheOrderOfARow) {
  Eigen::RowVectorXd row(3);
  row << 3.0, 1.0, 2.0;
  EXPECT_EQ(ToVector(row), (std::vector<double>{3.0, 1.0, 2.0}));
}

/// The numbers of a rig with these entries at these strengths.
struct Applied {
  Applied(PlantConfig config, const std::vector<effect::EffectConfig>& entries,
          const std::vector<double>& strengths) {
    config.effects = entries;
    const PlantParameters parameters = Reduce(config);
    StateLayout layout;
    layout.modes = static_cast<std::size_t>(parameters.modes.frequency_rad_per_s.size());
    model = PrepareEffects(parameters, layout);
    now = PrepareRig(parameters);
    ApplyEffects(parameters, MakeEntryShapes(parameters), strengths, now, model);
    own_rad_per_s = parameters.modes.frequency_rad_per_s[parameters.modes.rigid_modes];
  }
  EffectModel model;
  RigNow now;
  double own_rad_per_s{};  ///< of the first bending mode
};

TEST(ApplyEffects, OfStrengthZeroGiveTheRigsOwnNumbers) {
  const PlantConfig rig = test::QuietFlexibleRotor();
  const Applied found(
      rig,
      {test::Entry(Id::kRotorMass, {1.2}), test::Entry(Id::kExtraDelay, {50e-6}),
       test::Entry(Id::kAmplifierBandwidth, {300.0}), test::Entry(Id::kModalFrequency, {90.0})},
      {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(found.now.mass_ratio, 1.0);
  EXPECT_EQ(found.now.delay_samples, rig.delay_samples);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_EQ(found.now.amplifier_bandwidth_hz[axis],
              rig.bearings[axis / 2].amplifier.bandwidth_hz);
  }
  // A frequency goes through Hz and back.
  EXPECT_NEAR(found.now.frequency_rad_per_s[2], found.own_rad_per_s, 1e-12 * found.own_rad_per_s);
}

TEST(ApplyEffects, ChangeTheAxesThatAnEntryNamesAndNoOther) {
  const PlantConfig rig = test::QuietFlexibleRotor();
  const Applied found(rig, {test::Entry(Id::kAmplifierBandwidth, {300.0}, 0b0100)}, {1.0});
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const double own_hz = rig.bearings[axis / 2].amplifier.bandwidth_hz;
    EXPECT_EQ(found.now.amplifier_bandwidth_hz[axis], axis == 2 ? 300.0 : own_hz) << axis;
  }
}

TEST(ApplyEffects, RefuseASecondEntryOfAKindThatActsAtTheSamePlace) {
  PlantConfig rig = test::QuietFlexibleRotor();
  rig.effects = {test::Entry(Id::kRotorMass, {1.2}), test::Entry(Id::kRotorMass, {0.5})};
  EXPECT_THROW((void)MakeEntryShapes(Reduce(rig)), std::invalid_argument);
}

// Whichever gives less decides: the amplifier's own limit, or the supply's.
TEST(ApplyEffects, NeverRaiseALimitOfTheSlewThatTheAmplifierHas) {
  PlantConfig rig = test::QuietFlexibleRotor();
  rig.bearings[1].amplifier.slew_a_per_s = 50.0;
  const Applied found(rig, {test::Entry(Id::kAmplifierSlew, {100.0}, 0b0101)}, {1.0});
  EXPECT_EQ(found.now.slew_a_per_s[0], 100.0);
  EXPECT_EQ(found.now.slew_a_per_s[1], 0.0);  // none
  EXPECT_EQ(found.now.slew_a_per_s[2], 50.0);
  EXPECT_EQ(found.now.slew_a_per_s[3], 50.0);
}

TEST(OwnValues, AreTheRigsNumberWhereItHasOneAndNoneElsewhere) {
  const PlantParameters parameters = Reduce(test::QuietFlexibleRotor());
  EXPECT_EQ(OwnValues(parameters, test::Entry(Id::kSensorBandwidth, {1.0}), 0)[0], 5000.0);
  EXPECT_TRUE(std::isnan(OwnValues(parameters, test::Entry(Id::kExtraDelay, {1.0}), 0)[0]));
  effect::EffectConfig beyond = test::Entry(Id::kModalFrequency, {1.0});
  beyond.mode = 100;
  EXPECT_TRUE(std::isnan(OwnValues(parameters, beyond, 0)[0]));
}

TEST(FlexibleMode, CountsFromTheFirstBendingMode) {
  const PlantParameters parameters = Reduce(test::QuietFlexibleRotor());
  effect::EffectConfig entry = test::Entry(Id::kModalFrequency, {1.0});
  EXPECT_EQ(FlexibleMode(parameters, entry), 2U);  // behind translation and tilt
  entry.mode = 3;
  EXPECT_EQ(FlexibleMode(parameters, entry), 4U);
}

}  // namespace
}  // namespace levitas::plant
