#pragma once
// Gathers cycle records into sample_batch_t messages for those who look at full rate.
//
// Rate     bounded by the clock, whatever the loop does: a token bucket earns kCyclesPerSecond.
//          While it lasts every cycle is passed on; when a run is faster than that, stretches of
//          kStretch consecutive cycles are, so that a spectrum still finds uninterrupted samples.
// Thread   one (the recorder's). Allocates one vector per batch.
// Failure  none; a gap in the cycles starts a new batch.

#include <cstdint>
#include <functional>
#include <levitas_msg/sample_batch_t.hpp>
#include <vector>

#include "controller/cycle/cycle_io.hpp"

namespace levitas::transport {

class SampleBatcher {
 public:
  static constexpr std::uint32_t kBatch = 128;                 ///< cycles per message
  static constexpr std::uint32_t kStretch = 4096;              ///< cycles passed on in one piece
  static constexpr std::int64_t kCyclesPerSecond = 40'000;     ///< twice the fastest loop
  static constexpr std::int64_t kBucketCycles = 2 * kStretch;  ///< most that is saved up

  /// `send` takes an encoded sample_batch_t.
  SampleBatcher(std::size_t axes, std::function<void(std::vector<std::uint8_t>)> send);

  /// `now_ns` of a clock that does not go back.
  void Add(const cycle::CycleRecord& record, std::int64_t now_ns);

 private:
  [[nodiscard]] bool StretchAllowed(std::int64_t now_ns) noexcept;
  void Flush();

  std::size_t axes_;
  std::function<void(std::vector<std::uint8_t>)> send_;
  levitas_msg::sample_batch_t batch_{};
  std::uint32_t left_in_stretch_{0};
  std::int64_t tokens_{kBucketCycles};
  std::int64_t earned_until_ns_{0};
  bool started_{false};
};

}  // namespace levitas::transport
