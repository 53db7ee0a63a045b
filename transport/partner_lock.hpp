#pragma once
// Who is talked to: the sender heard first, as long as it is heard. Another one is refused.
//
// Told apart  by identity: the sender of the seal on a network with a key, the address without one.
// Policy   without a word of the partner for kSilenceNs, or after Release, the next sender takes
//          its place: a rig that starts again has another port. What others sent meanwhile is
//          counted; it is news for people once the partner is heard after it, since only then both
//          live, once per stranger.
// Second   who was heard beside the partner lives beside it and is never its next self: the last
//          kRemembered of them are refused however long the partner is silent (a process that the
//          machine holds up for a second), until Release or somebody else takes its place.
// Thread   Refuses, Heard and Release: one thread; refused, stranger and TakeNews: any one other.
// Failure  none.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "transport/speaker.hpp"

namespace levitas::transport {

class PartnerLock {
 public:
  static constexpr std::int64_t kSilenceNs = 500'000'000;  ///< far above a period or its repetition

  /// True, and counted, when `sender` is not the one that is talked to.
  [[nodiscard]] bool Refuses(const Speaker& sender, std::int64_t now_ns) noexcept {
    if (!partner_ || *partner_ == sender) return false;
    if (now_ns - heard_ns_ > kSilenceNs && !Beside(sender)) return false;
    refused_.store(refused_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    waiting_ = sender;
    return true;
  }
  /// A sound message of a sender that was not refused.
  void Heard(const Speaker& sender, std::int64_t now_ns) noexcept {
    if (!partner_ || !(*partner_ == sender)) {
      partner_ = sender;
      waiting_.reset();
      beside_ = {};
    } else if (waiting_) {
      Remember(*waiting_);
      stranger_.store(waiting_->address, std::memory_order_relaxed);
      waiting_.reset();
    }
    heard_ns_ = now_ns;
    talks_to_.store(sender.address, std::memory_order_relaxed);
  }
  void Release() noexcept {
    partner_.reset();
    beside_ = {};
  }

  [[nodiscard]] std::uint64_t refused() const noexcept {
    return refused_.load(std::memory_order_relaxed);
  }
  /// Address of the latest who spoke beside the partner; 0: nobody.
  [[nodiscard]] std::uint64_t stranger() const noexcept {
    return stranger_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t partner() const noexcept {
    return talks_to_.load(std::memory_order_relaxed);
  }
  /// A stranger that has not been told yet.
  [[nodiscard]] std::optional<std::uint64_t> TakeNews() noexcept {
    const std::uint64_t now = stranger();
    if (now == 0 || now == told_) return std::nullopt;
    told_ = now;
    return now;
  }

 private:
  static constexpr std::size_t kRemembered = 4;

  [[nodiscard]] bool Beside(const Speaker& sender) const noexcept {
    return std::ranges::find(beside_, std::optional(sender)) != beside_.end();
  }
  void Remember(const Speaker& sender) noexcept {
    if (Beside(sender)) return;
    std::rotate(beside_.begin(), beside_.end() - 1, beside_.end());
    beside_.front() = sender;
  }

  std::optional<Speaker> partner_;
  std::array<std::optional<Speaker>, kRemembered> beside_{};  ///< latest first
  std::optional<Speaker> waiting_;  ///< refused since the partner was last heard
  std::int64_t heard_ns_{0};
  std::uint64_t told_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> stranger_{0};
  std::atomic<std::uint64_t> talks_to_{0};
};

}  // namespace levitas::transport
