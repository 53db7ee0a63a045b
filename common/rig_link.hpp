#pragma once
// The other side of rig_port.hpp: how a simulated rig reaches its controller.
//
// Thread     one thread.
// Blocking   Receive waits at most until the deadline it is given; Send never waits.
// Staleness  Receive returns the newest current frame; overtaken ones are counted.
// Failure    never throws; a broken link reads as kNothing.

#include <cstdint>
#include <string>

#include "common/frames.hpp"
#include "common/torsion_batch.hpp"

namespace levitas::port {

class RigLink {
 public:
  enum class ReceiveResult : std::uint8_t {
    kCurrent,  ///< a new current frame was written to the argument
    kNothing,  ///< none before the deadline
    kGoodbye,  ///< the controller ends; the argument is its last frame
  };
  struct Counters {
    std::uint64_t frames_sent{};
    std::uint64_t send_failures{};
    std::uint64_t currents_read{};
    std::uint64_t currents_skipped{};   ///< overtaken by a newer one before they were read
    std::uint64_t currents_rejected{};  ///< undecodable, wrong axis count
    std::uint64_t currents_refused{};   ///< of a sender that may not speak, or not now
    std::uint64_t currents_lost{};      ///< sent by the controller, never seen here
  };

  virtual ~RigLink() = default;
  virtual bool Send(const SensorFrame& frame) noexcept = 0;
  virtual ReceiveResult Receive(CurrentFrame& frame, std::int64_t deadline_ns) noexcept = 0;
  /// Measured torsion, before the frame of the next cycle. False where the link has no channel for
  /// it.
  virtual bool SendTorsion(const TorsionBatch& /*batch*/) noexcept { return false; }
  [[nodiscard]] virtual Counters counters() const noexcept = 0;
  /// What people should hear at once, each thing once; empty when there is nothing new. Any one
  /// thread beside the loop's.
  [[nodiscard]] virtual std::string TakeNews() { return {}; }
  /// What went wrong on the transport, for people; empty when nothing did. After the loop.
  [[nodiscard]] virtual std::string Trouble() const { return {}; }
};

}  // namespace levitas::port
