#pragma once
// From the kernel's time stamps, which are of CLOCK_REALTIME, to CLOCK_MONOTONIC.
//
// Offset     read anew for every batch of frames: somebody may set the wall clock at any time
//            (date, an NTP daemon, a resumed machine).
// Frames     that waited while it was set bear a stamp of the clock of before. A frame came after
//            the socket was last emptied and before now: of the new offset, the one before, and now
//            itself, the first that says so dates it.
// Precision  an offset is read between two readings of CLOCK_MONOTONIC, and is only as good as
//            these lie close together: one that differs by less than that from the last is not
//            taken.
// Thread     one; no allocation. Failure: none.

#include <cstdint>

namespace levitas::socketcan {

class StampClock {
 public:
  /// After a batch was fetched: CLOCK_REALTIME, read between two readings of CLOCK_MONOTONIC.
  void Read(std::int64_t before_ns, std::int64_t real_ns, std::int64_t after_ns) noexcept;
  /// The batch of the last Read held everything that was there: what follows came after the Read
  /// before it.
  void Emptied() noexcept { empty_ns_ = last_now_ns_; }
  /// CLOCK_MONOTONIC of a stamp of the batch of the last Read.
  [[nodiscard]] std::int64_t Monotonic(std::int64_t stamp_ns) const noexcept;
  /// How often the wall clock was set by a millisecond or more.
  [[nodiscard]] std::uint64_t steps() const noexcept { return steps_; }

 private:
  bool read_{false};
  std::int64_t now_ns_{0};
  std::int64_t last_now_ns_{0};  ///< of the Read before
  std::int64_t empty_ns_{0};     ///< nothing that comes now is older
  std::int64_t offset_ns_{0};
  std::int64_t last_offset_ns_{0};  ///< before the last change
  std::uint64_t steps_{0};
};

}  // namespace levitas::socketcan
