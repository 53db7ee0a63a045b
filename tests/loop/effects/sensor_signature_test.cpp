// Sensors: what each effect reads, in closed form, and that the rotor does not feel it.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "common/two_pi.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "tests/loop/effects/effect_rig.hpp"

namespace levitas::plant::test {
namespace {

using effect::Id;

const AxisArray kParallelPlaces{20e-6, -30e-6, 20e-6,
                                -30e-6};  // parallel: every plane reads the same
constexpr double kRounding_m = 1e-18;

AxisArray ReadingAt(const effect::EffectConfig& entry, const AxisArray& place_m) {
  Plant plant(QuietWith(entry), 1);
  plant.PlaceAtRest(place_m);
  return plant.SensorOutput();
}

/// True when forces on the rotor are bit for bit the nominal ones.
bool RotorFeelsNothing(const effect::EffectConfig& entry) {
  Plant with(QuietWith(entry), 1);
  Plant without(Quiet(), 1);
  for (Plant* plant : {&with, &without}) {
    plant->PlaceAtRest(kParallelPlaces);
    plant->SetSpeed(200.0, 0.3);
    for (int i = 0; i < 20; ++i) {
      PlantCommand command;
      command.bias_current_a = 1.0;
      command.control_current_a = {0.1, -0.2, 0.05, 0.0};
      plant->Advance(command);
    }
  }
  const std::size_t mechanical = with.layout().sensor;
  return std::equal(with.state().begin(),
                    with.state().begin() + static_cast<std::ptrdiff_t>(mechanical),
                    without.state().begin());
}

TEST(SensorGain, ScalesTheReadingOfItsChannelsAlone) {
  auto entry = Entry(Id::kSensorGain, {1.1});
  entry.axes = 0b0010;
  const AxisArray reading_m = ReadingAt(entry, kParallelPlaces);
  EXPECT_NEAR(reading_m[1], -33e-6, kRounding_m);
  EXPECT_NEAR(reading_m[0], 20e-6, kRounding_m);
  EXPECT_TRUE(RotorFeelsNothing(entry));
}

TEST(SensorOffset, IsReadInTheMagneticCentre) {
  const auto entry = Entry(Id::kSensorOffset, {15e-6});
  EXPECT_EQ(ReadingAt(entry, {})[0], 15e-6);
  EXPECT_NEAR(ReadingAt(entry, kParallelPlaces)[1], -15e-6, kRounding_m);
  EXPECT_TRUE(RotorFeelsNothing(entry));
}

TEST(SensorNonlinearity, AddsSquareAndCubeOfTheDisplacement) {
  const auto entry = Entry(Id::kSensorNonlinearity, {500.0, 5e6});
  const AxisArray reading_m = ReadingAt(entry, kParallelPlaces);
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    const double y = kParallelPlaces[axis];
    EXPECT_NEAR(reading_m[axis], y + 500.0 * y * y + 5e6 * y * y * y, kRounding_m);
  }
  EXPECT_TRUE(RotorFeelsNothing(entry));
}

TEST(SensorBandwidth, SlowsTheReadingAndKeepsItsFinalValue) {
  constexpr double kBandwidth_hz = 800.0;
  Plant plant(QuietWith(Entry(Id::kSensorBandwidth, {kBandwidth_hz})), 1);
  plant.RestInTouchdown();  // no currents, no forces
  const auto& rigid = plant.model().rigid();
  for (std::size_t i = 0; i < 2; ++i) {  // moved after the filters had settled at zero
    plant.mutable_state()[i] = 10e-6 * rigid(static_cast<Eigen::Index>(i), 0);
  }
  PlantCommand off;
  off.amplifiers_enabled = false;
  for (int i = 1; i <= 30; ++i) {
    plant.Advance(off);
    const double expected_m = 10e-6 * (1.0 - std::exp(-kTwoPi * kBandwidth_hz * i * 1e-4));
    EXPECT_NEAR(plant.SensorOutput()[0], expected_m, 1e-17);
  }
}

TEST(SensorPosition, ReadsTheLineOfATiltedRotorAtTheShiftedPlane) {
  constexpr double kShift_m = 0.012;
  const AxisArray tilted{-50e-6, 0.0, 70e-6, 0.0};  // actuators at 129.9 and 399.6 mm
  const double slope = 120e-6 / (0.3996 - 0.1299);
  const AxisArray reading_m = ReadingAt(Entry(Id::kSensorPosition, {kShift_m}), tilted);
  // Sensor of de at 109.9 mm and 12 mm further on. A rigid line is a cubic: interpolation is exact.
  EXPECT_NEAR(reading_m[0], -50e-6 + slope * (0.1099 + kShift_m - 0.1299), 1e-15);
  EXPECT_NEAR(reading_m[2], 70e-6 + slope * 0.020, 1e-15);  // nde is not meant
  EXPECT_TRUE(RotorFeelsNothing(Entry(Id::kSensorPosition, {kShift_m})));
}

/// Complex line of the de orbit x + jy at `order` x rotation, over whole turns of 100 samples.
std::complex<double> OrbitLine(const effect::EffectConfig& entry, int order) {
  Plant plant(QuietWith(entry), 1);
  plant.RestInTouchdown();
  plant.SetSpeed(kTwoPi * 100.0, 0.0);  // 100 samples a turn
  PlantCommand off;
  off.amplifiers_enabled = false;
  off.drive_enabled = true;
  off.speed_set_point_rad_per_s = kTwoPi * 100.0;
  off.acceleration_limit_rad_per_s2 = 1.0;
  for (auto& value : plant.mutable_state()) value = 0.0;
  for (int i = 0; i < 100; ++i) plant.Advance(off);
  std::complex<double> line = 0.0;
  for (int i = 0; i < 100; ++i) {
    const AxisArray reading_m = plant.SensorOutput();
    line += std::complex<double>(reading_m[0], reading_m[1]) *
            std::polar(0.01, -order * plant.angle_rad());
    plant.Advance(off);
  }
  return line;
}

TEST(SensorRunout, IsALineAtItsOrderThroughTheSensorsFilterAndNowhereElse) {
  constexpr double kAmplitude_m = 5e-6;
  constexpr double kPhase_rad = 0.4;
  // Unbalance moves the free rotor too: what is compared is the difference to the nominal rig.
  const auto nominal = Entry(Id::kSensorRunout, {1.0, 0.0, 0.0});
  for (const int order : {1, 2, 3}) {
    const auto entry =
        Entry(Id::kSensorRunout, {static_cast<double>(order), kAmplitude_m, kPhase_rad});
    for (int line = -4; line <= 4; ++line) {
      const std::complex<double> found = OrbitLine(entry, line) - OrbitLine(nominal, line);
      // x: A cos(n a + p), y: A cos(n (a - 90 deg) + p): half of each turns forward, half backward.
      std::complex<double> expected = 0.0;
      const std::complex<double> j(0.0, 1.0);
      if (line == order) {
        expected = 0.5 * kAmplitude_m * std::polar(1.0, kPhase_rad) *
                   (1.0 + j * std::polar(1.0, -order * std::numbers::pi / 2.0));
      } else if (line == -order) {
        expected = 0.5 * kAmplitude_m * std::polar(1.0, -kPhase_rad) *
                   (1.0 + j * std::polar(1.0, order * std::numbers::pi / 2.0));
      }
      // First order, 5 kHz; linear between substeps of 25 us: (n W h)^2/12 = 2e-4 at most.
      const std::complex<double> filter = 1.0 / (1.0 + j * (line * 100.0 / 5000.0));
      EXPECT_LT(std::abs(found - filter * expected), 3e-4 * kAmplitude_m)
          << "order " << order << " line " << line;
    }
    EXPECT_TRUE(RotorFeelsNothing(entry));
  }
}

TEST(MainsPickup, IsACosineOfTimeOnAllItsChannelsAlike) {
  const auto entry = Entry(Id::kMainsPickup, {50.0, 2e-6, 0.5});
  Plant plant(QuietWith(entry), 1);
  PlantCommand off;
  off.amplifiers_enabled = false;
  plant.RestInTouchdown();
  for (int i = 0; i < 400; ++i) {
    for (const std::size_t axis : {std::size_t{0}, std::size_t{3}}) {
      EXPECT_NEAR(plant.SensorOutput()[axis], 2e-6 * std::cos(kTwoPi * 50.0 * i * 1e-4 + 0.5),
                  1e-18);
    }
    plant.Advance(off);
  }
  EXPECT_TRUE(RotorFeelsNothing(entry));
}

TEST(SensorNoise, HasItsRmsAndTheMemoryOfItsCorner) {
  constexpr double kRms_m = 3e-6;
  constexpr int kSamples = 20'000;
  for (const double corner_hz : {0.0, 500.0}) {
    Plant plant(QuietWith(Entry(Id::kSensorNoise, {kRms_m, corner_hz})), 8);
    double square = 0.0;
    double product = 0.0;
    double before_m = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const double noise_m = plant.Sample().position_m[0] - plant.SensorOutput()[0];
      square += noise_m * noise_m;
      product += noise_m * before_m;
      before_m = noise_m;
    }
    const double memory = corner_hz > 0.0 ? std::exp(-kTwoPi * corner_hz * 1e-4) : 0.0;
    // Independent samples: N for white noise, N (1 - a^2)/(1 + a^2) for the variance of coloured.
    const double independent = kSamples * (1.0 - memory * memory) / (1.0 + memory * memory);
    const double tolerance = 4.0 / std::sqrt(2.0 * independent);
    EXPECT_NEAR(std::sqrt(square / kSamples) / kRms_m, 1.0, tolerance);
    EXPECT_NEAR(product / square, memory, 4.0 / std::sqrt(static_cast<double>(kSamples)));
  }
}

}  // namespace
}  // namespace levitas::plant::test
