#pragma once
// How long before an instant a sleep must end, learned from how late sleeps were.
//
// Estimate  the 99 % quantile of the lateness by stochastic approximation (Robbins and Monro 1951):
//             q <- q + 0.99 d  after a later wake-up than q,   q <- q - 0.01 d  otherwise.
//           It rests where 1 % of the wake-ups are later than q, whatever their distribution.
// Bounds    25 us .. 60 us: below, the usual lateness of a busy machine (docs/timing.md); above,
//           the spin would come near the kernel's limit for real-time threads (95 % of a second).
// Pure      no clock; one instance per sleeping thread.

#include <algorithm>
#include <cstdint>

namespace levitas::rt {

class SpinMargin {
 public:
  static constexpr std::int64_t kLeastNs = 25'000;
  static constexpr std::int64_t kMostNs = 60'000;
  static constexpr std::int64_t kStepUpNs = 990;  // d = 1 us: follows a change within 1000 sleeps
  static constexpr std::int64_t kStepDownNs = 10;

  void Slept(std::int64_t late_ns) noexcept {
    const std::int64_t step_ns = late_ns > margin_ns_ ? kStepUpNs : -kStepDownNs;
    margin_ns_ = std::clamp(margin_ns_ + step_ns, kLeastNs, kMostNs);
  }
  [[nodiscard]] std::int64_t margin_ns() const noexcept { return margin_ns_; }

 private:
  std::int64_t margin_ns_{kLeastNs};
};

}  // namespace levitas::rt
