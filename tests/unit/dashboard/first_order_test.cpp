#include "dashboard/first_order.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "batches.hpp"

namespace levitas::dashboard {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kTurningRateHz = 10'000.0;

/// x = 5 um cos(theta + 60 deg), y = 3 um cos(theta - 90 deg), each with an offset and a second
/// order; theta(n) as given.
SampleStore Turning(const std::function<double(double s)>& theta, int cycles = 4096) {
  const auto angle = [&](std::int64_t cycle) {
    return theta(static_cast<double>(cycle) / kTurningRateHz);
  };
  auto batch = Batch(0, cycles, [&](std::int64_t cycle, int axis) {
    const double at = angle(cycle);
    const double first = axis == 0 ? 5e-6 * std::cos(at + std::numbers::pi / 3.0)
                                   : 3e-6 * std::cos(at - std::numbers::pi / 2.0);
    return 20e-6 + first + 1e-6 * std::cos(2.0 * at);
  });
  for (std::size_t i = 0; i < batch.angle_rad.size(); ++i) {
    const double at = angle(static_cast<std::int64_t>(i));
    batch.angle_rad[i] = static_cast<float>(at - kTurn * std::floor(at / kTurn));
  }
  SampleStore store(SmallRig());
  EXPECT_TRUE(store.Add(batch));
  return store;
}

TEST(FirstOrder, FindsAmplitudeAndPhaseOfEachAxisBesideOffsetAndHarmonic) {
  const auto orders = FirstOrderOf(Turning([](double s) { return kTurn * 50.0 * s; }));
  ASSERT_TRUE(orders);
  ASSERT_EQ(orders->size(), 2U);
  // Whole turns are whole samples here (200 a turn): what is left is single precision.
  EXPECT_NEAR(std::abs((*orders)[0]), 5e-6, 1e-10);
  EXPECT_NEAR(std::arg((*orders)[0]), std::numbers::pi / 3.0, 1e-4);
  EXPECT_NEAR(std::abs((*orders)[1]), 3e-6, 1e-10);
  EXPECT_NEAR(std::arg((*orders)[1]), -std::numbers::pi / 2.0, 1e-4);
}

// 50 Hz that rise by a tenth meanwhile: without the angle the phase would turn by whole radians.
TEST(FirstOrder, IsNotSmearedByASpeedThatChanges) {
  const auto orders =
      FirstOrderOf(Turning([](double s) { return kTurn * (50.0 * s + 6.0 * s * s); }));
  ASSERT_TRUE(orders);
  // The samples of a turn are no whole number now: one of some 200 is counted twice or not at all,
  // and faster turns weigh less.
  EXPECT_NEAR(std::abs((*orders)[0]), 5e-6, 0.02 * 5e-6);
  EXPECT_NEAR(std::arg((*orders)[0]), std::numbers::pi / 3.0, 0.02);
}

TEST(FirstOrder, FollowsARotorThatTurnsTheOtherWay) {
  const auto orders = FirstOrderOf(Turning([](double s) { return -kTurn * 50.0 * s; }));
  ASSERT_TRUE(orders);
  EXPECT_NEAR(std::arg((*orders)[0]), std::numbers::pi / 3.0, 1e-3);
}

TEST(FirstOrder, NeedsTwoWholeTurns) {
  // 4096 samples are 0.41 s: 4 Hz turn 1.6 times, 6 Hz 2.5 times.
  EXPECT_FALSE(FirstOrderOf(Turning([](double s) { return kTurn * 4.0 * s; })));
  EXPECT_TRUE(FirstOrderOf(Turning([](double s) { return kTurn * 6.0 * s; })));
  EXPECT_FALSE(FirstOrderOf(Turning([](double) { return 1.0; })));
  EXPECT_FALSE(FirstOrderOf(SampleStore(SmallRig())));
}

TEST(FirstOrder, IsNotMadeOfReadingsThatAreNoNumbers) {
  SampleStore store = Turning([](double s) { return kTurn * 50.0 * s; });
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(store.Add(Batch(4096, 1, [=](std::int64_t, int) { return nothing; })));
  EXPECT_FALSE(FirstOrderOf(store));
}

}  // namespace
}  // namespace levitas::dashboard
