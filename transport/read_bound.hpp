#pragma once
// Ends a read while datagrams keep coming: whoever floods a port must not hold the loop.
//
// Limits   past the deadline at most kUselessLate datagrams that brought nothing; and kAll in any
//          case, more than the socket's buffer holds of frames, so that after a pause of the
//          program the newest one is reached in one read.
// Thread   one. Failure: none.

#include <cstdint>

#include "rt/clock.hpp"

namespace levitas::transport {

class ReadBound {
 public:
  static constexpr std::uint32_t kUselessLate = 64;
  static constexpr std::uint32_t kAll = 16'384;

  /// Before each datagram. False: return with what there is.
  [[nodiscard]] bool MayGoOn(std::int64_t deadline_ns) noexcept {
    if (++looked_at_ > kAll) return false;
    if (useless_ < kUselessLate) return true;
    useless_ = 0;  // the clock is looked at once in so many
    return rt::MonotonicNowNs() < deadline_ns;
  }
  /// The datagram brought nothing.
  void Useless() noexcept { ++useless_; }

 private:
  std::uint32_t looked_at_{0};
  std::uint32_t useless_{0};
};

}  // namespace levitas::transport
