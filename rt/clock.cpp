#include "rt/clock.hpp"

#include <unistd.h>

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

namespace {

bool OnlyProcessor() noexcept {
  static const bool kOnly = sysconf(_SC_NPROCESSORS_ONLN) == 1;
  return kOnly;
}

void Sleep(std::int64_t due_ns) noexcept {
  const timespec until{static_cast<time_t>(due_ns / kNsPerSecond),
                       static_cast<long>(due_ns % kNsPerSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace

void SpinUntil(std::int64_t due_ns) noexcept {
  if (OnlyProcessor()) return Sleep(due_ns);
  while (MonotonicNowNs() < due_ns) {
  }
}

std::int64_t AllowedSpinNs(std::int64_t spin_ns) noexcept { return OnlyProcessor() ? 0 : spin_ns; }

void MonotonicClock::SleepUntil(std::int64_t due_ns) noexcept {
  if (OnlyProcessor()) return Sleep(due_ns);
  const std::int64_t wake_ns = due_ns - margin_.margin_ns();
  if (MonotonicNowNs() < wake_ns) {
    Sleep(wake_ns);
    margin_.Slept(MonotonicNowNs() - wake_ns);
  }
  SpinUntil(due_ns);
}

}  // namespace levitas::rt
