#pragma once
// Counts the messages that were sent but did not arrive in time, from the sequence number of each.
//
// A sender counts every message it sends on a port, so a jump is a loss; a message that arrives
// after a later one stays lost to a reader of the newest. A number up to kReorder behind is such a
// message, or a repetition, and moves nothing. Another sender, or a sender that started again,
// begins a new count and loses nothing by it.

#include <cstdint>

namespace levitas::transport {

class SequenceWatch {
 public:
  static constexpr std::uint32_t kReorder = 64;  ///< more than a network holds back

  void Saw(std::uint64_t sender, std::uint32_t sequence) noexcept {
    if (sender == sender_) {
      const std::uint32_t behind = previous_ - sequence;  // modulo 2^32, as the sender counts
      if (behind <= kReorder) return;
      const std::uint32_t step = sequence - previous_;
      // Half the range or more is a count begun anew, not a loss of 2^31 messages.
      if (step < (1U << 31)) lost_ += step - 1;
    }
    sender_ = sender;
    previous_ = sequence;
  }
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  std::uint64_t sender_{0};
  std::uint32_t previous_{0};
  std::uint64_t lost_{0};
};

}  // namespace levitas::transport
