#include "plant_sim/plant/check_config.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

std::string Refusal(const std::function<void(PlantConfig&)>& spoil) {
  auto config = test::FlexibleRotor();
  spoil(config);
  try {
    CheckConfig(config);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(CheckConfig, AcceptsTheRigsInUse) {
  EXPECT_NO_THROW(CheckConfig(test::FlexibleRotor()));
  EXPECT_NO_THROW(CheckConfig(test::UfuRig()));
  EXPECT_NO_THROW(CheckConfig(test::RigidRotor(2.0)));
}

TEST(CheckConfig, NamesWhatWasFoundAndWhatIsAllowed) {
  EXPECT_EQ(Refusal([](auto& c) { c.bearings[1].magnet.bias_current_a = 3.0; }),
            "bearings[1].magnet.bias_current_a = 3, allowed 0 to 2; correct the rig description");
}

TEST(CheckConfig, RefusesEveryImpossibleNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_NE(Refusal([](auto& c) { c.period_ns = 0; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.delay_samples = -0.5; }), "");
  EXPECT_NE(Refusal([&](auto& c) { c.delay_samples = nan; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.substeps = 0; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.bearings.clear(); }), "");
  EXPECT_NE(Refusal([](auto& c) { c.bearings.resize(5, c.bearings[0]); }), "");
  EXPECT_NE(Refusal([&](auto& c) { c.bearings[0].magnet.gap_m = nan; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.bearings[0].amplifier.bandwidth_hz = 0.0; }), "");
  EXPECT_NE(Refusal([&](auto& c) { c.bearings[0].sensor.bandwidth_hz = infinity; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.bearings[0].sensor.adc_bits = -1; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.bearings[0].sensor.range_m = 0.0; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.bearings[0].touchdown.friction = -0.1; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.bearings[0].touchdown.clearance_m = 1e-3; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.gravity_m_per_s2 = -9.81; }), "");
  EXPECT_NE(Refusal([&](auto& c) { c.unbalance[0].phase_rad = nan; }), "");
  EXPECT_NE(Refusal([](auto& c) { c.drive.coast_down_1_per_s = -1.0; }), "");
}

TEST(CheckConfig, RefusesEveryImpossibleCoilOnAVoltage) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [](const std::function<void(VoltageDrive&)>& spoil) {
    return Refusal([&](PlantConfig& c) {
      c.bearings[0].amplifier.voltage = VoltageDrive{1.0, 0.0, 30e-3, 5e-3, 0.0};
      spoil(*c.bearings[0].amplifier.voltage);
    });
  };
  EXPECT_EQ(refusal([](VoltageDrive&) {}), "");
  EXPECT_EQ(
      refusal([](auto& v) { v.dead_band_a = -0.1; }),
      "bearings[0].amplifier.dead_band_a = -0.1, allowed 0 to 2; correct the rig description");
  EXPECT_NE(refusal([](auto& v) { v.dead_band_a = 3.0; }), "") << "beyond the coil's maximum";
  EXPECT_NE(refusal([](auto& v) { v.curvature = 1.5; }), "");
  EXPECT_NE(refusal([](auto& v) { v.iron_1_per_a2 = -0.1; }), "");
  EXPECT_NE(refusal([&](auto& v) { v.warming_1_per_s = nan; }), "");
  EXPECT_NE(refusal([](auto& v) { v.away_steady_ratio = 0.0; }), "");
  EXPECT_NE(refusal([](auto& v) { v.away_time_constant_ratio = -1.0; }), "");
}

TEST(CheckConfig, RefusesAPolarityThatWasForgotten) {
  EXPECT_EQ(Refusal([](auto& c) { c.actuator_polarity = {}; }),
            "actuator_polarity[0] = 0, allowed +1 or -1");
}

}  // namespace
}  // namespace levitas::plant
