#include "hil/socketcan/stamp_clock.hpp"

#include <array>
#include <cstdlib>

namespace levitas::socketcan {
namespace {

constexpr std::int64_t kStepNs = 1'000'000;  // what a daemon that slews by 500 ppm needs 2 s for
constexpr std::int64_t kSlackNs = 2'000;     // of an offset and of a stamp

}  // namespace

void StampClock::Read(std::int64_t before_ns, std::int64_t real_ns,
                      std::int64_t after_ns) noexcept {
  const std::int64_t apart_ns = after_ns - before_ns;
  const std::int64_t offset_ns = before_ns + apart_ns / 2 - real_ns;
  last_now_ns_ = now_ns_;
  now_ns_ = after_ns;
  if (!read_) {
    last_now_ns_ = empty_ns_ = before_ns;
    offset_ns_ = last_offset_ns_ = offset_ns;
    read_ = true;
    return;
  }
  const std::int64_t change_ns = std::abs(offset_ns - offset_ns_);
  if (change_ns <= apart_ns / 2) return;
  if (change_ns >= kStepNs + apart_ns) ++steps_;
  last_offset_ns_ = offset_ns_;
  offset_ns_ = offset_ns;
}

std::int64_t StampClock::Monotonic(std::int64_t stamp_ns) const noexcept {
  for (const std::int64_t offset_ns : std::array{offset_ns_, last_offset_ns_}) {
    const std::int64_t at_ns = stamp_ns + offset_ns;
    if (at_ns >= empty_ns_ - kSlackNs && at_ns <= now_ns_ + kSlackNs) return at_ns;
  }
  return now_ns_;
}

}  // namespace levitas::socketcan
