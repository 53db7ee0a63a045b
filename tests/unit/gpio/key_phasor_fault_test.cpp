// What a key phasor may do wrong, each in a pair: what a speed from the last interval alone would
// have said, and what is said instead.
#include <gtest/gtest.h>

#include <algorithm>

#include "common/random.hpp"
#include "hil/gpio/key_phasor.hpp"
#include "tests/unit/gpio/rotor_marks.hpp"

namespace levitas::gpio {
namespace {

using namespace test;

/// Without any judgement: one turn in the time since the last pulse.
double NaiveSpeed(std::int64_t before_ns, std::int64_t time_ns) {
  return kTurnRad / (static_cast<double>(time_ns - before_ns) * 1e-9);
}

TEST(KeyPhasorFault, AnExtraPulseWouldReadAsTwentyTimesTheSpeedAndChangesNothing) {
  KeyPhasor key_phasor = Running();
  const std::int64_t noise_ns = 9 * kTurnNs + 1'000'000;
  EXPECT_GT(NaiveSpeed(9 * kTurnNs, noise_ns), 19.0 * kSpeed);
  key_phasor.Pulse(noise_ns);
  EXPECT_NEAR(key_phasor.At(noise_ns).speed_rad_per_s, kSpeed, 1e-9 * kSpeed);
  key_phasor.Pulse(10 * kTurnNs);
  const SpeedReading reading = key_phasor.At(10 * kTurnNs);
  EXPECT_EQ(reading.state, SpeedState::kLocked);
  EXPECT_NEAR(reading.speed_rad_per_s, kSpeed, 1e-9 * kSpeed);
  EXPECT_EQ(key_phasor.counters().extra, 1U);
}

TEST(KeyPhasorFault, AMissingPulseWouldReadAsHalfTheSpeedAndChangesNothing) {
  KeyPhasor key_phasor = Running();
  EXPECT_NEAR(NaiveSpeed(9 * kTurnNs, 11 * kTurnNs), kSpeed / 2.0, 1e-9 * kSpeed);
  for (std::int64_t time_ns = 9 * kTurnNs; time_ns < 11 * kTurnNs; time_ns += 100'000) {
    const SpeedReading reading = key_phasor.At(time_ns);
    ASSERT_EQ(reading.state, SpeedState::kLocked);
    ASSERT_NEAR(reading.speed_rad_per_s, kSpeed, 1e-9 * kSpeed);
  }
  key_phasor.Pulse(11 * kTurnNs);
  EXPECT_NEAR(key_phasor.At(11 * kTurnNs).speed_rad_per_s, kSpeed, 1e-9 * kSpeed);
  EXPECT_EQ(key_phasor.counters().missing, 1U);
}

TEST(KeyPhasorFault, ABrokenCableAtSpeedIsUnknownAndNeverAStandstill) {
  KeyPhasor key_phasor = Running();
  std::int64_t unknown_ns = 0;
  for (std::int64_t time_ns = 9 * kTurnNs; time_ns < 100 * kTurnNs; time_ns += 100'000) {
    const SpeedReading reading = key_phasor.At(time_ns);
    ASSERT_NEAR(reading.speed_rad_per_s, kSpeed, 1e-9 * kSpeed);
    if (unknown_ns == 0 && reading.state == SpeedState::kUnknown) unknown_ns = time_ns;
  }
  // Three marks may be missing; the fourth must come within the slowest four turns: four times
  // 20.28 ms at the allowed 420 rad/s^2, jitter included.
  EXPECT_GT(unknown_ns - 9 * kTurnNs, 4 * kTurnNs);
  EXPECT_LT(unknown_ns - 9 * kTurnNs, 4 * kTurnNs + 2'000'000);
}

TEST(KeyPhasorFault, FourPulsesMissingInARowAreNotExplainedAway) {
  KeyPhasor key_phasor = Running();
  key_phasor.Pulse(14 * kTurnNs);
  EXPECT_EQ(key_phasor.counters().jumps, 1U);
  EXPECT_NEAR(key_phasor.At(14 * kTurnNs).speed_rad_per_s, kSpeed, 1e-9 * kSpeed);
}

TEST(KeyPhasorFault, AJumpOfSpeedIsUnknownFirstAndThenMeasuredAnew) {
  KeyPhasor key_phasor = Running();
  constexpr std::int64_t kFasterNs = 14'000'000;
  bool was_unknown = false;
  SpeedReading reading;
  for (int k = 1; k <= 20; ++k) {
    key_phasor.Pulse(9 * kTurnNs + k * kFasterNs);
    reading = key_phasor.At(9 * kTurnNs + k * kFasterNs);
    was_unknown = was_unknown || reading.state == SpeedState::kUnknown;
    if (!was_unknown) {
      EXPECT_NEAR(reading.speed_rad_per_s, kSpeed, 0.05 * kSpeed);
    }
  }
  EXPECT_TRUE(was_unknown);
  EXPECT_EQ(reading.state, SpeedState::kLocked);
  EXPECT_NEAR(reading.speed_rad_per_s, kTurnRad / 14e-3, 1e-9 * kSpeed);
}

TEST(KeyPhasorFault, AScratchThatAddsAPulseToEveryTurnIsNotADoubledSpeed) {
  KeyPhasor key_phasor = Running();
  int turns = 0;
  for (; turns < 20; ++turns) {
    const std::int64_t mark_ns = (10 + turns) * kTurnNs;
    key_phasor.Pulse(mark_ns - kTurnNs * 2 / 5);
    if (key_phasor.At(mark_ns).state == SpeedState::kUnknown) break;
    key_phasor.Pulse(mark_ns);
    ASSERT_NEAR(key_phasor.At(mark_ns).speed_rad_per_s, kSpeed, 1e-6 * kSpeed);
  }
  // Two points for each extra, one back for each good: six points in the fifth turn.
  EXPECT_EQ(turns, 4);
}

TEST(KeyPhasorFault, PulsesOfABouncingContactNeverLock) {
  KeyPhasor key_phasor(Config());
  for (int k = 0; k < 50; ++k) {
    key_phasor.Pulse(k * kTurnNs);
    key_phasor.Pulse(k * kTurnNs + 300'000);
    EXPECT_NE(key_phasor.At(k * kTurnNs + 400'000).state, SpeedState::kLocked);
  }
}

TEST(KeyPhasorFault, TimeThatDoesNotMoveForwardIsNoPulse) {
  KeyPhasor key_phasor = Running();
  key_phasor.Pulse(9 * kTurnNs);
  key_phasor.Pulse(8 * kTurnNs);
  EXPECT_EQ(key_phasor.counters().extra, 2U);
  EXPECT_EQ(key_phasor.At(9 * kTurnNs).state, SpeedState::kLocked);
}

TEST(KeyPhasorFault, JitterWithinItsLimitIsNeverDoubted) {
  Random draw(20261121);
  for (const double acceleration : {-30.0, 0.0, 120.0}) {
    const Rotor rotor{kSpeed, acceleration};
    KeyPhasor key_phasor(Config());
    for (int k = 0; k < 400; ++k) {
      const double early_s = (2.0 * draw.Uniform() - 1.0) * Config().jitter_s;
      const double time_s = rotor.MarkS(k) + early_s;
      if (!(rotor.SpeedAt(time_s) > 100.0)) break;
      key_phasor.Pulse(std::llround(time_s * 1e9));
      if (k < 3) continue;
      const SpeedReading reading = key_phasor.At(std::llround(time_s * 1e9));
      ASSERT_EQ(reading.state, SpeedState::kLocked) << k;
      // Each mean speed is off by at most 2 jitter / T of itself; extrapolating half an interval
      // from two of them makes that at most twice as much.
      const double interval_s = rotor.MarkS(k) - rotor.MarkS(k - 1);
      const double bound = 2.0 * 2.0 * Config().jitter_s / interval_s * rotor.SpeedAt(time_s) +
                           std::abs(acceleration) * Config().jitter_s;
      ASSERT_NEAR(reading.speed_rad_per_s, rotor.SpeedAt(time_s), bound);
    }
    EXPECT_EQ(key_phasor.counters().extra, 0U);
    EXPECT_EQ(key_phasor.counters().missing, 0U);
    EXPECT_EQ(key_phasor.counters().jumps, 0U);
  }
}

TEST(KeyPhasorFault, RareNoiseAndRareLossNeverReachTheSpeed) {
  Random draw(7);
  KeyPhasor key_phasor = Running();
  std::uint64_t extra = 0;
  std::uint64_t missing = 0;
  bool last_missing = false;
  for (int k = 10; k < 5000; ++k) {
    // One turn in twenty has noise in its first nine tenths, one in twenty has no pulse.
    if (draw.Uniform() < 0.05) {
      ++extra;
      key_phasor.Pulse((k - 1) * kTurnNs + 1 +
                       static_cast<std::int64_t>(draw.Uniform() * 0.9 * kTurnNs));
    }
    // In a row they would be judged; that is another test.
    if (!last_missing && k % 3 == 0 && draw.Uniform() < 0.05) {
      last_missing = true;
      ++missing;
      continue;
    }
    last_missing = false;
    key_phasor.Pulse(k * kTurnNs);
    const SpeedReading reading = key_phasor.At(k * kTurnNs);
    if (reading.state != SpeedState::kLocked) continue;
    ASSERT_NEAR(reading.speed_rad_per_s, kSpeed, 1e-6 * kSpeed) << k;
  }
  EXPECT_GT(extra, 200U);
  EXPECT_GT(missing, 50U);
  EXPECT_LE(key_phasor.counters().extra, extra);
}

TEST(KeyPhasorFault, NoSequenceOfPulsesGivesANumberThatIsNone) {
  Random draw(20261122);
  for (int run = 0; run < 200; ++run) {
    KeyPhasorConfig config;
    config.pulses_per_turn = static_cast<std::uint32_t>(draw.Bits() % 4);  // 0 is taken as 1
    config.max_acceleration_rad_per_s2 = draw.Uniform() < 0.2 ? 0.0 : 1000.0 * draw.Uniform();
    config.jitter_s = draw.Uniform() < 0.5 ? 0.0 : 1e-4 * draw.Uniform();
    KeyPhasor key_phasor(config);
    std::int64_t time_ns = 0;
    for (int k = 0; k < 500; ++k) {
      const int decades = static_cast<int>(draw.Bits() % 10);
      time_ns += static_cast<std::int64_t>(draw.Uniform() * std::pow(10.0, decades));
      if (draw.Uniform() < 0.7) key_phasor.Pulse(time_ns);
      const SpeedReading reading = key_phasor.At(time_ns);
      ASSERT_TRUE(std::isfinite(reading.speed_rad_per_s));
      ASSERT_GE(reading.speed_rad_per_s, 0.0);
      ASSERT_GE(reading.angle_rad, 0.0);
      ASSERT_LT(reading.angle_rad, kTurnRad);
    }
  }
}

}  // namespace
}  // namespace levitas::gpio
