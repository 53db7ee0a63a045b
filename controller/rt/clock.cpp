#include "controller/rt/clock.hpp"

#include <cerrno>
#include <ctime>

namespace levitas::rt {

namespace {
constexpr std::int64_t kNsPerSecond = 1'000'000'000;
}  // namespace

std::int64_t MonotonicNowNs() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerSecond + now.tv_nsec;
}

std::int64_t MonotonicClock::NowNs() noexcept { return MonotonicNowNs(); }

void SpinUntil(std::int64_t due_ns) noexcept {
  while (MonotonicNowNs() < due_ns) {
  }
}

void MonotonicClock::SleepUntil(std::int64_t due_ns) noexcept {
  const std::int64_t wake_ns = due_ns - margin_.margin_ns();
  if (MonotonicNowNs() < wake_ns) {
    const timespec until{static_cast<time_t>(wake_ns / kNsPerSecond),
                         static_cast<long>(wake_ns % kNsPerSecond)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
    margin_.Slept(MonotonicNowNs() - wake_ns);
  }
  SpinUntil(due_ns);
}

}  // namespace levitas::rt
