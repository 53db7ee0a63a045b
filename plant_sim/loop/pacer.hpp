#pragma once
// Holds a lockstep run to the clock: when its next period may begin.
//
//   due(n) = t_0 + (n - n_0) T / factor      factor 1: real time, 0.1: ten times slower
//
// Bursts    periods run on while they are at most kBurstNs early, then the rig sleeps until the
//           clock is there: 200 wake-ups a second whatever the sampling rate, so that a small
//           machine keeps up. Nothing of the result depends on it, as in any lockstep run.
// Behind    a run that is late by more than kMostBehindNs does not race to catch up: the clock is
//           set anew where it is (n_0, t_0). A factor beyond the machine's reach is therefore as
//           fast as it can.
// Units     ns of any clock that does not go back. Thread one. Failure none.

#include <cstdint>

namespace levitas::plant_run {

class Pacer {
 public:
  static constexpr std::int64_t kBurstNs = 5'000'000;
  static constexpr std::int64_t kMostBehindNs = 100'000'000;

  /// `factor` above 0, of the clock; `period_ns` of the rig.
  Pacer(double factor, std::int64_t period_ns) noexcept
      : step_ns_(static_cast<double>(period_ns) / factor) {}

  /// Until when to wait before period `cycle`, which counts up; `now_ns` or earlier: not at all.
  [[nodiscard]] std::int64_t Due(std::uint64_t cycle, std::int64_t now_ns) noexcept {
    if (!started_) SetAnew(cycle, now_ns);
    const auto run_ns = static_cast<std::int64_t>(static_cast<double>(cycle - first_) * step_ns_);
    const std::int64_t due_ns = start_ns_ + run_ns;
    if (now_ns - due_ns > kMostBehindNs) SetAnew(cycle, now_ns);
    return due_ns - now_ns > kBurstNs ? due_ns : now_ns;
  }

 private:
  void SetAnew(std::uint64_t cycle, std::int64_t now_ns) noexcept {
    started_ = true;
    first_ = cycle;
    start_ns_ = now_ns;
  }

  double step_ns_;
  bool started_{false};
  std::uint64_t first_{0};
  std::int64_t start_ns_{0};
};

}  // namespace levitas::plant_run
