#pragma once
// Decides when the absence of the other process is said, and when it ends the program.
//
// Policy   one message after 2 s of silence, one when the partner is (back) there, the end after
//          the time-out. Times in nanoseconds of one clock; pure, so tests need not wait.

#include <cstdint>

namespace levitas::transport {

class PartnerWatch {
 public:
  enum class Say : std::uint8_t { kNothing, kMissing, kFound, kGiveUp };
  static constexpr std::int64_t kPatienceNs = 2'000'000'000;

  /// Silence counts from `start_ns` until the partner is first heard.
  PartnerWatch(std::int64_t start_ns, std::int64_t timeout_ns) noexcept
      : heard_ns_(start_ns), timeout_ns_(timeout_ns) {}

  /// `heard` is how many messages of the partner have arrived so far.
  [[nodiscard]] Say Check(std::int64_t now_ns, std::uint64_t heard) noexcept {
    if (heard != heard_) {
      heard_ = heard;
      heard_ns_ = now_ns;
      const bool news = !present_;
      present_ = true;
      said_missing_ = false;
      return news ? Say::kFound : Say::kNothing;
    }
    const std::int64_t silent_ns = now_ns - heard_ns_;
    if (silent_ns >= timeout_ns_) return Say::kGiveUp;
    if (silent_ns < kPatienceNs || said_missing_) return Say::kNothing;
    said_missing_ = true;
    present_ = false;
    return Say::kMissing;
  }
  [[nodiscard]] bool present() const noexcept { return present_; }

 private:
  std::int64_t heard_ns_;
  std::int64_t timeout_ns_;
  std::uint64_t heard_{0};
  bool present_{false};
  bool said_missing_{false};
};

}  // namespace levitas::transport
