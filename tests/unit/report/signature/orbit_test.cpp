#include "report/signature/orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::signature {
namespace {

constexpr Motion kMotion{.speed_hz = 50.0, .turns = 4, .settle_s = 0.05};
constexpr int kSettling = 500;  // 0.05 s at 10 kHz
constexpr int kRecorded = 800;  // four turns of 20 ms

/// Without magnets and without a push the rotor stays where it is.
plant::PlantParameters Balanced() {
  plant::PlantConfig config = test::QuietFlexibleRotor();
  config.unbalance.clear();
  return plant::Reduce(config);
}

TEST(Turn, RecordsWholeTurnsAfterSettling) {
  int asked = 0;
  const Turning found =
      Turn(Balanced(), kMotion, [&asked](const SensorFrame&, plant::PlantCommand&) { ++asked; });
  EXPECT_EQ(asked, kSettling + kRecorded);
  EXPECT_EQ(found.reading_m.size(), std::size_t{kRecorded});
  EXPECT_EQ(found.current_a.size(), std::size_t{kRecorded});
}

TEST(Turn, HoldsTheCurrentsThatWereCommandedAtTheSameSamples) {
  int sample = 0;
  const Turning found =
      Turn(Balanced(), kMotion, [&sample](const SensorFrame&, plant::PlantCommand& command) {
        command.control_current_a[0] = 1e-6 * sample;
        command.control_current_a[1] = -2e-6 * sample;
        ++sample;
      });
  for (int i = 0; i < kRecorded; ++i) {
    const auto current_a = found.current_a[static_cast<std::size_t>(i)];
    ASSERT_EQ(current_a.real(), 1e-6 * (kSettling + i));
    ASSERT_EQ(current_a.imag(), -2e-6 * (kSettling + i));
  }
}

TEST(Turn, OfABalancedRotorInTheCentreReadsNothing) {
  for (const auto& reading_m : Turn(Balanced(), kMotion, {}).reading_m) {
    EXPECT_EQ(std::abs(reading_m), 0.0);
  }
}

// The rotor turns with the speed that is asked for: what is held by a soft spring circles with it.
TEST(Turn, OfAnUnbalancedRotorThatIsHeldCirclesOncePerTurnForward) {
  const auto held = [](const SensorFrame& frame, plant::PlantCommand& command) {
    static SensorFrame last = frame;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const double rate = (frame.position_m[axis] - last.position_m[axis]) * 1e4;
      command.control_current_a[axis] = -(8000.0 * frame.position_m[axis] + 12.0 * rate);
    }
    last = frame;
  };
  Motion motion = kMotion;
  motion.settle_s = 1.0;
  const Turning found = Turn(plant::Reduce(test::QuietFlexibleRotor()), motion, held);
  // The line once per turn, forward, over all others together.
  const auto line = [&found](int order) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < found.reading_m.size(); ++i) {
      const double angle = 2.0 * std::numbers::pi * order * kMotion.turns * static_cast<double>(i) /
                           static_cast<double>(found.reading_m.size());
      sum += found.reading_m[i] * std::polar(1.0, -angle);
    }
    return std::abs(sum) / static_cast<double>(found.reading_m.size());
  };
  EXPECT_GT(line(1), 0.5e-6);
  for (const int other : {-2, -1, 0, 2, 3}) EXPECT_LT(line(other), 0.05 * line(1)) << other;
}

}  // namespace
}  // namespace levitas::signature
