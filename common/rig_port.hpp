#pragma once
// What the controller faces: a simulated rig over LCM, a real bus, a test. amb-controller has one
// for each kind of --port; nothing else in the controller changes with it.
//
// Thread     loop thread only.
// Blocking   Read waits at most until the deadline it is given; Write never waits.
// Staleness  Read returns the NEWEST frame; older ones that were queued are counted as skipped.
// Failure    never throws; results are values. A closed or broken port reads as kNothing.

#include <cstdint>
#include <string>

#include "common/frames.hpp"
#include "common/torsion_batch.hpp"

namespace levitas::port {

enum class ReadResult : std::uint8_t {
  kFrame,    ///< a new frame was written to the argument
  kNothing,  ///< no new frame before the deadline
};

struct PortCounters {
  std::uint64_t frames_read{};
  std::uint64_t frames_skipped{};   ///< overtaken by a newer frame before they were read
  std::uint64_t frames_rejected{};  ///< undecodable, wrong axis count
  std::uint64_t frames_refused{};   ///< of a sender that may not speak, or not now
  std::uint64_t frames_lost{};      ///< sent by the rig and never seen here
  std::uint64_t currents_written{};
  std::uint64_t write_failures{};  ///< the transport could not take it
};

class RigPort {
 public:
  virtual ~RigPort() = default;
  /// Waits until CLOCK_MONOTONIC reaches `deadline_ns` at the latest; a deadline in the past polls.
  virtual ReadResult Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept = 0;
  /// False when the frame could not be handed to the transport (counted).
  virtual bool Write(const CurrentFrame& frame) noexcept = 0;
  [[nodiscard]] virtual PortCounters counters() const noexcept = 0;
  /// The next batch of measured torsion that came along with the frames read so far; false when
  /// there is none, as on every port without such a channel.
  [[nodiscard]] virtual bool TakeTorsion(TorsionBatch& /*batch*/) noexcept { return false; }
  /// Tells the rig that this controller ends; `last` should have the amplifiers off.
  virtual void SayGoodbye(const CurrentFrame& /*last*/) noexcept {}
  /// What people should hear at once, each thing once; empty when there is nothing new. Any one
  /// thread beside the loop's.
  [[nodiscard]] virtual std::string TakeNews() { return {}; }
  /// What went wrong on the transport, for people; empty when nothing did. After the loop.
  [[nodiscard]] virtual std::string Trouble() const { return {}; }
};

}  // namespace levitas::port
