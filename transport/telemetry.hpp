#pragma once
// Publishes the controller's state, timing and events for people and tools, away from the loop.
//
// Channels  LEVITAS_STATE about 100 times a second, LEVITAS_TIMING, _HISTOGRAM and _HEADER about
//           once, LEVITAS_EVENT, _ANSWER, _CHALLENGE and _SAMPLES as they come. Best effort: what
//           does not fit into a ring or queue is dropped and counted.
// Thread    own thread for sending. PostState and PostTiming: loop thread, wait-free. PostEvent,
//           PostAnswer, PostChallenge, PostSamples and Announce: any other thread (they lock).
// Failure   construction throws Problem when the network cannot be joined; later never.

#include <cstdint>
#include <memory>
#include <vector>

#include "common/axes.hpp"
#include "common/enums.hpp"
#include "common/histogram.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::transport {

struct StateSample {
  std::uint64_t cycle{};
  std::int64_t time_ns{};
  Mode mode{};
  Fault fault{};
  std::int8_t fault_axis{-1};
  std::uint32_t axes{};
  AxisArray position_m{};
  AxisArray reference_m{};
  AxisArray control_current_a{};
  double bias_current_a{};
  double speed_rad_per_s{};
  std::uint64_t records_lost{};
};

/// As loop_timing_t; durations in nanoseconds.
struct TimingSample {
  std::uint64_t cycle{};
  std::uint64_t skipped_periods{};
  std::uint64_t missing_frames{};
  double wakeup_p50_ns{}, wakeup_p99_ns{}, wakeup_p999_ns{}, wakeup_max_ns{};
  double compute_p50_ns{}, compute_p99_ns{}, compute_max_ns{};
  double latency_p50_ns{}, latency_p99_ns{};
  std::int8_t slowest_stage{};
  Histogram wakeup, compute, latency;  ///< copied whole
};

class Telemetry {
 public:
  explicit Telemetry(const LcmNetwork& network);
  /// Sends what is queued and joins.
  ~Telemetry();
  Telemetry(const Telemetry&) = delete;
  Telemetry& operator=(const Telemetry&) = delete;

  void PostState(const StateSample& sample) noexcept;
  void PostTiming(const TimingSample& sample) noexcept;
  /// `encoded`: an event_t as the recorder encodes it.
  void PostEvent(std::vector<std::uint8_t> encoded);
  /// `encoded`: a command_answer_t.
  void PostAnswer(std::vector<std::uint8_t> encoded);
  /// `encoded`: a challenge_t.
  void PostChallenge(std::vector<std::uint8_t> encoded);
  /// `encoded`: a sample_batch_t.
  void PostSamples(std::vector<std::uint8_t> encoded);
  /// `encoded`: the session_header_t of this run, sent again and again for those who come later.
  void Announce(std::vector<std::uint8_t> encoded);
  /// Samples that found a ring full, events and batches beyond their queue's
  /// length, refused by the kernel.
  [[nodiscard]] std::uint64_t dropped() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::transport
