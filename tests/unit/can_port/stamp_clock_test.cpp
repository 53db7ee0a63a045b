// Frames dated by a wall clock that somebody sets.

#include "hil/socketcan/stamp_clock.hpp"

#include <gtest/gtest.h>

namespace levitas::socketcan {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kPeriodNs = 100'000;
constexpr std::int64_t kWayNs = 30'000;  // from a frame's stamp until it is read
constexpr std::int64_t kApartNs = 50;    // of two readings of CLOCK_MONOTONIC

/// Both clocks of a machine, and a socket that is emptied with every frame.
struct Machine {
  std::int64_t monotonic_ns{5 * kSecondNs};
  std::int64_t ahead_ns{1'700'000'000 * kSecondNs};  ///< CLOCK_REALTIME less CLOCK_MONOTONIC
  StampClock clock;

  [[nodiscard]] std::int64_t Real() const { return monotonic_ns + ahead_ns; }
  void Read() {
    clock.Read(monotonic_ns, Real() + kApartNs / 2, monotonic_ns + kApartNs);
    monotonic_ns += kApartNs;
  }
  /// A frame comes; `between` happens before it is read. How wrong its date is.
  template <class Between>
  std::int64_t Error(const Between& between) {
    monotonic_ns += kPeriodNs;
    const std::int64_t came_ns = monotonic_ns;
    const std::int64_t stamp_ns = Real();
    monotonic_ns += kWayNs;
    between();
    Read();
    const std::int64_t error_ns = clock.Monotonic(stamp_ns) - came_ns;
    clock.Emptied();
    return error_ns;
  }
  std::int64_t Error() {
    return Error([] {});
  }
};

TEST(StampClock, DatesEveryFrameRightWhileNobodySetsTheClock) {
  Machine machine;
  machine.Read();
  for (int frame = 0; frame < 1000; ++frame) ASSERT_LE(std::abs(machine.Error()), kApartNs);
  EXPECT_EQ(machine.clock.steps(), 0U);
}

// Of the frame that waited meanwhile too: the clock is set between its stamp and its reading.
TEST(StampClock, DatesEveryFrameRightWhenTheClockIsSet) {
  for (const std::int64_t step_ns : {-3600 * kSecondNs, -kSecondNs, kSecondNs, 3600 * kSecondNs}) {
    Machine machine;
    machine.Read();
    for (int frame = 0; frame < 10; ++frame) machine.Error();
    const std::int64_t waiting_ns = machine.Error([&] { machine.ahead_ns += step_ns; });
    EXPECT_LE(std::abs(waiting_ns), kApartNs) << step_ns;
    for (int frame = 0; frame < 10; ++frame) {
      ASSERT_LE(std::abs(machine.Error()), kApartNs) << step_ns;
    }
    machine.ahead_ns -= step_ns;
    EXPECT_LE(std::abs(machine.Error()), kApartNs) << step_ns;
    EXPECT_EQ(machine.clock.steps(), 2U);
  }
}

TEST(StampClock, DatesTheFirstFrameRightWhenTheClockIsSetWhileItIsAwaited) {
  Machine machine;
  machine.Read();
  machine.monotonic_ns += 20 * kSecondNs;
  machine.ahead_ns -= kSecondNs;
  EXPECT_LE(std::abs(machine.Error()), kApartNs);
}

// An interrupt between two readings of the clocks makes their difference worthless.
TEST(StampClock, DoesNotTakeAnOffsetThatWasReadSlowly) {
  Machine machine;
  machine.Read();
  machine.Error();
  const std::int64_t slow_ns = 80'000;
  const std::int64_t stamp_ns = machine.Real();
  const std::int64_t came_ns = machine.monotonic_ns;
  machine.clock.Read(machine.monotonic_ns, machine.Real(), machine.monotonic_ns + slow_ns);
  EXPECT_LE(std::abs(machine.clock.Monotonic(stamp_ns) - came_ns), kApartNs);
  EXPECT_EQ(machine.clock.steps(), 0U);
}

// Both set twice before it was read: no offset fits, and it has just come.
TEST(StampClock, TakesNowForAFrameOfWhichNoOffsetMakesSense) {
  Machine machine;
  machine.Read();
  machine.Error();
  const std::int64_t error_ns = machine.Error([&] {
    machine.ahead_ns += kSecondNs;
    machine.Read();
    machine.ahead_ns += kSecondNs;
  });
  EXPECT_GE(error_ns, 0);
  EXPECT_LE(error_ns, kWayNs + 3 * kApartNs);
}

}  // namespace
}  // namespace levitas::socketcan
