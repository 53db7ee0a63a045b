#pragma once
// The rig's end of the LCM network: sensor frames out, current frames in. The contract is that of
// common/rig_link.hpp; construction throws Problem.
//
// Sender   one controller at a time is obeyed (partner_lock.hpp), until its goodbye; what a second
//          one sends is refused, counted and named.

#include "common/rig_link.hpp"
#include "transport/frame_codec.hpp"
#include "transport/multicast_socket.hpp"
#include "transport/partner_lock.hpp"
#include "transport/sequence_watch.hpp"
#include "transport/torsion_packet.hpp"

namespace levitas::transport {

class LcmRigLink final : public port::RigLink {
 public:
  LcmRigLink(const LcmNetwork& network, std::size_t axes, std::int64_t spin_ns);

  bool Send(const SensorFrame& frame) noexcept override;
  bool SendTorsion(const TorsionBatch& batch) noexcept override;
  ReceiveResult Receive(CurrentFrame& frame, std::int64_t deadline_ns) noexcept override;
  [[nodiscard]] Counters counters() const noexcept override;
  [[nodiscard]] std::string TakeNews() override;
  [[nodiscard]] std::string Trouble() const override;

 private:
  [[nodiscard]] ReceiveResult Accept(const Received& received, CurrentFrame& frame) noexcept;

  MulticastReceiver receiver_;
  MulticastSender sender_;
  SensorFrameCodec sensor_codec_;
  CurrentFrameCodec current_codec_;
  TorsionPacket torsion_;
  SequenceWatch watch_;
  PartnerLock partner_;
  Counters counters_;
};

}  // namespace levitas::transport
