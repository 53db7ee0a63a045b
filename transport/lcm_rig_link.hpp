#pragma once
// The rig's end of the LCM network: sensor frames out, current frames in.
//
// Thread     one thread; after construction no allocation, no exception.
// Staleness  Receive returns the newest current frame; overtaken ones are counted.
// Failure    construction throws Problem; later a broken link reads as kNothing.

#include "common/frames.hpp"
#include "transport/frame_codec.hpp"
#include "transport/multicast_socket.hpp"
#include "transport/sequence_watch.hpp"

namespace levitas::transport {

class LcmRigLink {
 public:
  enum class Answer : std::uint8_t {
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
    std::uint64_t currents_lost{};      ///< sent by the controller, never seen here
  };

  LcmRigLink(const LcmNetwork& network, std::size_t axes, std::int64_t spin_ns);

  bool Send(const SensorFrame& frame) noexcept;
  Answer Receive(CurrentFrame& frame, std::int64_t deadline_ns) noexcept;
  [[nodiscard]] Counters counters() const noexcept;

 private:
  [[nodiscard]] Answer Accept(const Received& received, CurrentFrame& frame) noexcept;

  MulticastReceiver receiver_;
  MulticastSender sender_;
  SensorFrameCodec sensor_codec_;
  CurrentFrameCodec current_codec_;
  SequenceWatch watch_;
  Counters counters_;
};

}  // namespace levitas::transport
