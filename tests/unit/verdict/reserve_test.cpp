// What a run left unused, against closed forms; nothing is said of what was not run.

#include "verdict/reserve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/verdict/synthetic_session.hpp"

namespace levitas::verdict {
namespace {

TEST(Reserve, OfCurrentIsTheLargestPeakOverWhatBiasAndAmplifierLeave) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, 400, {.static_a = 0.2, .amplitude_a = 0.1});
  session.Append(Mode::kSpinning, 400, {.speed_rad_per_s = 100.0, .static_a = -0.4});
  RigNumbers rig = TwoBearingRig();
  rig.bias_current_a = 1.0;
  for (const double most_a : {2.0, 1.5}) {  // the amplifier leaves 1 A beside the bias, then 0.5 A
    rig.max_coil_current_a = most_a;
    const auto used = CurrentUse(rig, session.Figures(rig));
    ASSERT_TRUE(used);
    EXPECT_TRUE(used->spinning);
    EXPECT_NEAR(used->limit_a, most_a - 1.0, 1e-12);
    EXPECT_NEAR(used->share, 0.4 / (most_a - 1.0), 1e-12);
  }
}

TEST(Reserve, OfCurrentIsNotKnownWhereNothingWasLevitated) {
  SyntheticSession session;
  session.Append(Mode::kLift, 400, {.static_a = 0.2});
  EXPECT_FALSE(CurrentUse(TwoBearingRig(), session.Figures(TwoBearingRig())));
}

// Two probes of 3 um each and a step of 4 um sqrt(12): sqrt(2 (9 + 16)) um.
TEST(Reserve, OfNoiseAddsTheStepOfTheConverterToThatOfTheProbe) {
  plant::PlantConfig plant;
  plant.bearings.resize(2);
  plant.bearings[0].sensor.noise_rms_m = 3e-6;
  plant.bearings[1].sensor = plant.bearings[0].sensor;
  plant.bearings[1].sensor.adc_bits = 8;
  plant.bearings[1].sensor.range_m = 128.0 * 4e-6 * std::sqrt(12.0);
  const auto noise_m = ProbeNoise(plant);
  ASSERT_EQ(noise_m.size(), 2U);
  EXPECT_NEAR(noise_m[0], 3e-6 * std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(noise_m[1], 5e-6 * std::sqrt(2.0), 1e-15);
}

}  // namespace
}  // namespace levitas::verdict
