#pragma once
// The controller's port to a rig on the LCM network: sensor frames in, current frames out.
//
// Session  the rig draws a random session number at each start. The controller sees 1 for the first
//          rig it meets, 2 after the next restart and so on: a change is what matters, and two runs
//          from the same seed then give the same records.
// Torsion  batches of the rig that is heard are kept until TakeTorsion, the newest kKeptBatches of
//          them; the datagrams of one sender arrive in order.
// Sender   frames of one rig at a time are taken (partner_lock.hpp); a second one is refused,
//          counted and named. The rest (thread, blocking, staleness,
//          failure) is the contract of common/rig_port.hpp.

#include <array>
#include <optional>
#include <span>

#include "common/rig_port.hpp"
#include "transport/frame_codec.hpp"
#include "transport/multicast_socket.hpp"
#include "transport/partner_lock.hpp"
#include "transport/sequence_watch.hpp"
#include "transport/torsion_packet.hpp"

namespace levitas::transport {

class LcmRigPort final : public port::RigPort {
 public:
  /// Throws Problem when the network cannot be joined.
  LcmRigPort(const LcmNetwork& network, std::size_t axes, std::int64_t spin_ns);

  port::ReadResult Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept override;
  bool Write(const CurrentFrame& frame) noexcept override;
  [[nodiscard]] port::PortCounters counters() const noexcept override;
  [[nodiscard]] bool TakeTorsion(TorsionBatch& batch) noexcept override;
  void SayGoodbye(const CurrentFrame& last) noexcept override;
  [[nodiscard]] std::string TakeNews() override;
  [[nodiscard]] std::string Trouble() const override;

 private:
  /// More than come between two reads of a loop that keeps up.
  static constexpr std::size_t kKeptBatches = 8;

  [[nodiscard]] bool Accept(const Received& received, SensorFrame& frame) noexcept;
  void KeepTorsion(const Received& received, std::span<const std::uint8_t> payload) noexcept;

  MulticastReceiver receiver_;
  MulticastSender sender_;
  SensorFrameCodec sensor_codec_;
  CurrentFrameCodec current_codec_;
  TorsionCodec torsion_codec_;
  /// One more than are kept: what comes is read into the place of none that waits.
  std::array<TorsionBatch, kKeptBatches + 1> torsion_{};
  std::uint64_t torsion_came_{0}, torsion_taken_{0};
  SequenceWatch watch_;
  PartnerLock partner_;
  port::PortCounters counters_;
  std::optional<std::uint32_t> wire_session_;
  std::uint32_t session_{0};
};

}  // namespace levitas::transport
