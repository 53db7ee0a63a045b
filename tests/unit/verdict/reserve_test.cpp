// What a run left unused, against closed forms; nothing is said of what was not run.

#include "verdict/reserve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/poles.hpp"
#include "configuration/rig_file.hpp"
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

struct ShippedLoop {
  configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  law::LawConfig law =
      configuration::LoadController(
          configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers)
          .law;
  [[nodiscard]] std::vector<double> ResonantDamping(double speed_rad_per_s) const {
    std::vector<double> damping;
    for (const auto& pole : analysis::ClosedLoopPoles(rig.plant, law, speed_rad_per_s).poles) {
      const bool resonant = pole.frequency_hz != 0.0 && pole.damping_ratio < std::sqrt(0.5);
      if (resonant) damping.push_back(pole.damping_ratio);
    }
    std::ranges::sort(damping);
    return damping;
  }
};

// Each pole twice, for its two planes.
TEST(Modes, OfARotorAtRestAreItsPolesOnce) {
  const ShippedLoop loop;
  const auto poles = loop.ResonantDamping(0.0);
  auto modes = DampingOfModes(loop.rig.plant, loop.law, 0.0);
  ASSERT_EQ(2 * modes.size(), poles.size());
  EXPECT_TRUE(std::ranges::is_sorted(modes, {}, &ModeDamping::at_rest_hz));
  std::ranges::sort(modes, {}, [](const ModeDamping& mode) { return mode.least.damping_ratio; });
  for (std::size_t i = 0; i < modes.size(); ++i) {
    EXPECT_NEAR(modes[i].least.damping_ratio, poles[2 * i], 1e-6);
  }
}

TEST(Modes, AreFollowedToTheSpeedAtWhichTheyAreLeastDamped) {
  const ShippedLoop loop;
  const double top = loop.rig.numbers.max_speed_rad_per_s;
  const auto rest = DampingOfModes(loop.rig.plant, loop.law, 0.0);
  const auto modes = DampingOfModes(loop.rig.plant, loop.law, top);
  ASSERT_EQ(modes.size(), rest.size()) << "one is lost or counted twice on the way";
  const auto at_top = loop.ResonantDamping(top);
  double least = 1.0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    EXPECT_NEAR(modes[i].at_rest_hz, rest[i].at_rest_hz, 1e-6 * rest[i].at_rest_hz);
    EXPECT_LE(modes[i].least.damping_ratio, rest[i].least.damping_ratio);
    // A mode of whirl splits by tens of hertz here, not by the distance to its neighbours.
    EXPECT_NEAR(modes[i].least.frequency_hz, modes[i].at_rest_hz, 0.12 * modes[i].at_rest_hz);
    least = std::min(least, modes[i].least.damping_ratio);
  }
  EXPECT_LE(least, at_top.front() + 1e-9);
}

}  // namespace
}  // namespace levitas::verdict
